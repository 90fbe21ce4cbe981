"""The plant as a process: physics on the wall clock, motors through shared memory, sensors by bus.

A controller that is late is waited for, so that a slow machine makes time slow and not the robot
fall; one that stays away is not, and the motors' own watchdog damps.
"""

from __future__ import annotations

import gc
import sys

from robot.bus import run, topics
from robot.bus.bus import Bus
from robot.bus.lifeline import Stop, tie_to_parent
from robot.bus.timing import Lateness
from robot.bus.zenoh_bus import ZenohBus
from robot.clock import Clock, WallClock
from robot.drivers.shared_memory import MotorServer
from robot.model import description
from sim import world
from sim.pace import Pace
from sim.plant import Plant

STEPS = 2
PERIOD_S = 0.001 * STEPS
TIMING_PERIODS = 500


def serve(plant: Plant, motors: MotorServer, bus: Bus, *, clock: Clock, stop: Stop) -> None:
    """Run until asked to stop."""
    lateness = Lateness("plant", PERIOD_S)
    pace = Pace(motors, clock, period_s=PERIOD_S)
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


def main(run_file: str, parent_pid: str) -> None:
    """Load, build, run, close."""
    tie_to_parent(int(parent_pid))
    config, clock, stop = run.load(run_file), WallClock(), Stop()
    robot = description.load(config.robot)
    place = world.load(config.world)
    if (shuffle := config.variation_seed) is not None:
        place = world.variation(place, shuffle)
    plant = Plant(place, robot, seed=config.seed)
    motors = MotorServer.of(robot, config.motors_path)
    gc.freeze()
    with ZenohBus("plant", config.sockets) as bus:
        serve(plant, motors, bus, clock=clock, stop=stop)


if __name__ == "__main__":
    main(*sys.argv[1:])
