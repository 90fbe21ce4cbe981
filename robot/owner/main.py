"""The owner of the buses as a process: it commands the motors, and outlives the controller."""

from __future__ import annotations

import gc
import sys
from contextlib import ExitStack

from robot.bus import run
from robot.bus.bus import LocalBus
from robot.bus.lifeline import Stop, Turn, ask_for_real_time, ask_for_turn, tie_to_parent
from robot.clock import WallClock
from robot.drivers.motors.owned.memory import OwnerMemory
from robot.drivers.simulation.shared_plant import SharedPlant
from robot.drivers.wiring import Wiring
from robot.model import description
from robot.model.body import BodyModel
from robot.model.description import RobotDescription
from robot.owner.balancing import OwnController
from robot.owner.owner import BusOwner
from robot.owner.serving import OwnedBody, Serving, squat_of, stop_of

REHEARSES = 50
"""Periods within which sensors have said something."""


def rehearse(robot: RobotDescription, devices: OwnedBody) -> None:
    """Tick a controller once, and forget it: the first tick of a process is a slow one."""
    for _ in range(REHEARSES):
        if (sample := devices.read()) is not None:
            OwnController(robot).command(sample)
            return


def main(run_file: str, parent_pid: str) -> None:
    """Load, build, run, close."""
    tie_to_parent(int(parent_pid))
    ask_for_turn(Turn.BODY)
    config, clock, stop = run.load(run_file), WallClock(), Stop()
    robot = description.load(config.robot).driven_by(config.motors)
    body = BodyModel(robot)
    plant = SharedPlant(robot, config.memory, clock=clock)  # opened by a simulated driver
    emulated = config.memory if config.motors and config.simulated else None
    wiring = Wiring(  # it has nothing to say to anybody but by its memory
        robot=robot, clock=clock, bus=LocalBus(), plant=plant, emulated=emulated
    )
    owner = BusOwner(body, squat_of(body, print), lambda: OwnController(robot))
    with ExitStack() as stack:
        memory = stack.enter_context(OwnerMemory(robot, config.memory, create=True))
        is_pressed = stop_of(config, robot, stack)
        devices = stack.enter_context(OwnedBody(wiring))
        rehearse(robot, devices)
        ask_for_real_time()
        gc.freeze()  # what start-up made stays: the collector need not look at it every period
        serving = Serving(
            owner, devices, memory,
            clock=clock, tell=print, is_simulated=config.simulated, is_pressed=is_pressed,
        )  # fmt: skip
        while not stop or serving.is_lowering:
            serving.period()
        serving.close()


if __name__ == "__main__":
    main(*sys.argv[1:])
