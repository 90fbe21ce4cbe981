"""The plant as a process: the physical world of a live run."""

from __future__ import annotations

import gc
import sys
from contextlib import ExitStack
from pathlib import Path

from robot.bus import run
from robot.bus.lifeline import Stop, Turn, ask_for_real_time, ask_for_turn, tie_to_parent
from robot.bus.zenoh_bus import ZenohBus
from robot.clock import WallClock
from robot.drivers.simulation.shared_plant import PlantServer
from robot.model import description
from robot.reality.trail import FILE as TRAIL_FILE
from sim.live import LivePlant
from sim.plant_buses import PlantBuses, maps
from sim.scene_memory import SceneMemory
from sim.simulation import Simulation


def main(run_file: str, parent_pid: str) -> None:
    """Load, build, run, close."""
    tie_to_parent(int(parent_pid))
    ask_for_turn(Turn.BODY)
    config, stop = run.load(run_file), Stop()
    world = (
        Simulation()
        .under(config.reality, eyes=config.eyes, localisation=config.localisation)
        .world(config.world, vary_seed=config.variation_seed)
    )
    robot = description.load(config.robot).driven_by(config.motors)
    plant = world.plant(robot, seed=config.seed)
    with ExitStack() as stack:
        stack.enter_context(plant.leave_trail(Path(config.folder) / TRAIL_FILE))
        bus = stack.enter_context(ZenohBus("plant", config.sockets))
        body = stack.enter_context(PlantServer(robot, config.memory))
        scene = SceneMemory(plant.model, config.memory, create=True) if config.pictures else None
        if scene is not None:
            stack.enter_context(scene)
        clock = WallClock()
        buses = None
        found = maps(robot, config.motors)
        if any(joints is not None for joints in found):
            buses = PlantBuses(
                plant, found.can, config.memory, clock=clock, tell=print, servos=found.servos,
                boards=found.boards, pulses=found.pulses,
            )  # fmt: skip
            stack.enter_context(buses)
        ask_for_real_time()
        gc.freeze()  # what start-up made stays: the collector need not look at it every period
        live = LivePlant(plant, body, bus, clock=clock, scene=scene, buses=buses)
        live.run(lambda: bool(stop))


if __name__ == "__main__":
    main(*sys.argv[1:])
