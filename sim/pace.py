"""The plant at the wall's pace, or behind it while the controller is late.

A controller that is late is waited for, so that a slow machine makes time slow and not the robot
fall; one that stays away is not, and the motors' own watchdog damps.
"""

from __future__ import annotations

from robot.bus import topics
from robot.bus.bus import Bus
from robot.bus.lifeline import Stop
from robot.bus.timing import Lateness
from robot.clock import Clock
from robot.drivers.motors import MotorCommand
from robot.drivers.shared_memory import MotorServer
from sim.plant import Plant

STEPS = 2
PERIOD_S = 0.001 * STEPS
TIMING_PERIODS = 500
START_PATIENCE_S = 30.0
PATIENCE_S = 0.08
MAX_DEBT_S = 0.02
POLL_S = 0.0001


class Pace:
    """Soft lock step of the plant with its controller.

    Time begins with the first command (or after `START_PATIENCE_S`): until then the robot is held
    where it stands. Every period lasts at least its time on the wall. A controller that answered
    the period before is waited for, at most `PATIENCE_S`; one that did not is taken for gone until
    it answers again. Up to `MAX_DEBT_S` of delay is caught up, more is lost: simulated time falls
    behind.
    """

    def __init__(self, motors: MotorServer, clock: Clock, *, period_s: float, stop: Stop) -> None:
        self._stop = stop
        self._motors = motors
        self._clock = clock
        self._period_s = period_s
        self._due_s = clock.now_s()
        self._patience_s = START_PATIENCE_S

    def wait(self, stamp_s: float) -> MotorCommand | None:
        """Sleep out the period that began with a state of `stamp_s`; its command, if it came."""
        clock = self._clock
        self._due_s = max(self._due_s + self._period_s, clock.now_s() - MAX_DEBT_S)
        clock.sleep_until(self._due_s)
        command = self._motors.take()
        give_up_s = clock.now_s() + self._patience_s
        while command is None or command.stamp_s < stamp_s:
            if self._stop or clock.now_s() >= give_up_s:
                break
            clock.sleep_until(clock.now_s() + POLL_S)
            command = self._motors.take() or command
        answered = command is not None and command.stamp_s >= stamp_s - self._period_s
        self._patience_s = PATIENCE_S if answered else 0.0
        return command


def serve(plant: Plant, motors: MotorServer, bus: Bus, *, clock: Clock, stop: Stop) -> None:
    """Run a plant until asked to stop; it goes on whatever becomes of the controller."""
    lateness = Lateness("plant", PERIOD_S)
    pace = Pace(motors, clock, period_s=PERIOD_S, stop=stop)
    periods = 0
    while not stop:
        state = plant.read()
        motors.publish(state)
        for name, message in plant.sense():
            bus.publish(topics.named(name), message)
        command = pace.wait(state.stamp_s)
        lateness.tick(clock.now_s())
        if command is not None:
            plant.write(command)
        plant.step(STEPS)
        if periods % TIMING_PERIODS == 0:
            bus.publish(topics.PLANT_TIMING, lateness.report(plant.time_s, clock.now_s()))
        periods += 1
