"""The controller as a process: motors in, motors out, at the bus's 500 Hz.

Others are spares, one behind the other: they wait, loaded and rehearsed, until the motors are
nobody's.
"""

from __future__ import annotations

import gc
import select
import sys

from robot.bus import run, topics
from robot.bus.bus import Bus
from robot.bus.lifeline import Stop, Turn, ask_for_real_time, ask_for_turn, tie_to_parent
from robot.bus.timing import Lateness
from robot.bus.zenoh_bus import ZenohBus
from robot.clock import Clock, WallClock
from robot.control.loop import BUS_PERIOD_S, NEEDS, ControlLoop
from robot.drivers.body_devices import BodyDevices
from robot.drivers.simulation.shared_plant import SharedPlant
from robot.drivers.wiring import Wiring
from robot.model import description

STATE_TICKS, TIMING_TICKS, PAUSE_S = 10, 250, 0.3
TURN_POLL_S = 0.001
NEXT_POLL_S = 1.0
"""How long a spare behind another one waits before it looks whether it is to stop."""


def serve(
    loop: ControlLoop, body: BodyDevices, bus: Bus, *, clock: Clock, stop: Stop, waited_for: bool
) -> None:
    """Run until asked to stop. After a pause of the process the motors damp until re-armed.

    Args:
        loop: the controller.
        body: what it moves.
        bus: for what is not urgent.
        clock: of the wall.
        stop: when it is asked to.
        waited_for: whether the body's time waits for commands, as a simulation's does.
    """
    commands = bus.subscribe(topics.BODY_COMMAND)
    lateness = Lateness("controller", BUS_PERIOD_S)
    stamp_s, ticks = -1.0, 0
    while not stop:
        sample = body.read()
        if sample.motors.stamp_s == stamp_s:
            continue
        stamp_s = sample.motors.stamp_s
        body_s = stamp_s if waited_for else None
        # The first command enables motors: that takes longer.
        pause_s = lateness.tick(clock.now_s(), body_s=body_s) if ticks else 0.0
        if pause_s > PAUSE_S:
            loop.trip(f"the controller stood still for {pause_s:.2f} s")
        for command in commands.take():
            loop.handle(command)
        body.write(loop.tick(sample))
        if ticks % STATE_TICKS == 0:
            bus.publish(topics.BODY_STATE, loop.state())
            body.relay()
        if ticks % TIMING_TICKS == 0:
            bus.publish(topics.CONTROLLER_TIMING, lateness.report(stamp_s, clock.now_s()))
        ticks += 1
    bus.publish(topics.CONTROLLER_TIMING, lateness.report(stamp_s, clock.now_s()))


def is_next(patience_s: float) -> bool:
    """Whether no other spare is before this one: its standard input has ended then.

    The supervisor so keeps the order in which they take over, and knows which it is.
    """
    return bool(select.select([sys.stdin.fileno()], [], [], patience_s)[0])


def main(run_file: str, parent_pid: str) -> None:
    """Load, build, run, close."""
    tie_to_parent(int(parent_pid))
    ask_for_turn(Turn.BODY)
    config, clock = run.load(run_file), WallClock()
    robot = description.load(config.robot).driven_by(config.motors)
    loop, stop = ControlLoop(robot), Stop()
    with ZenohBus("controller", config.sockets) as bus:
        plant = SharedPlant(robot, config.memory, clock=clock)  # opened by a simulated driver
        emulated = config.memory if config.motors and config.simulated else None
        wiring = Wiring(
            robot=robot, clock=clock, bus=bus, plant=plant, emulated=emulated,
            owner=config.memory if config.owned else None,
        )  # fmt: skip
        with BodyDevices(wiring, needs=NEEDS) as body:
            if not is_next(0.0) or not body.claim():
                ControlLoop(robot).tick(body.read())  # the first tick of a process is a slow one
            states = bus.subscribe(topics.BODY_STATE)  # of the controller that this one replaces
            ask_for_real_time()
            gc.freeze()  # what start-up made stays: the collector need not look at it every period
            while not stop and not is_next(NEXT_POLL_S):
                pass
            while not stop and not body.claim():
                clock.sleep_until(clock.now_s() + TURN_POLL_S)
            loop.recall(states.latest)
            serve(loop, body, bus, clock=clock, stop=stop, waited_for=config.simulated)


if __name__ == "__main__":
    main(*sys.argv[1:])
