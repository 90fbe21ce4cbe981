"""The plant as a process: physics on the wall clock, motors through shared memory, sensors by bus."""

from __future__ import annotations

import gc
import sys

from robot.bus import run
from robot.bus.lifeline import Stop, tie_to_parent
from robot.bus.zenoh_bus import ZenohBus
from robot.clock import WallClock
from robot.drivers.shared_memory import MotorServer
from robot.model import description
from sim import world
from sim.pace import serve
from sim.plant import Plant


def main(run_file: str, parent_pid: str) -> None:
    """Load, build, run, close."""
    tie_to_parent(int(parent_pid))
    config, clock, stop = run.load(run_file), WallClock(), Stop()
    robot = description.load(config.robot)
    place = world.load(config.world)
    if config.variation_seed is not None:
        place = world.variation(place, config.variation_seed)
    plant = Plant(place, robot, seed=config.seed)
    motors = MotorServer.of(robot, config.motors_path)
    gc.freeze()  # what start-up made stays: the collector need not look at it again
    with ZenohBus("plant", config.sockets) as bus:
        serve(plant, motors, bus, clock=clock, stop=stop)


if __name__ == "__main__":
    main(*sys.argv[1:])
