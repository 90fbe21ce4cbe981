"""The camera of a simulated robot as a process: pictures take long, and the plant must not wait."""

from __future__ import annotations

import os
import sys
from pathlib import Path

from robot.bus import run
from robot.bus.lifeline import Stop, Turn, ask_for_turn, tie_to_parent
from robot.bus.zenoh_bus import ZenohBus
from robot.clock import WallClock
from robot.model import description
from sim.photographer import Photographer
from sim.scene_memory import NAME, SceneMemory
from sim.simulation import Simulation

PERIOD_S = 0.01
ALBUM = "seen.png"
NICENESS = 10
"""Whoever keeps the robot up comes first, where none of them is granted a turn before others. A
real camera takes no processor's time from anybody."""


def main(run_file: str, parent_pid: str) -> None:
    """Load, build, run, close."""
    tie_to_parent(int(parent_pid))
    if not ask_for_turn(Turn.PICTURES):
        os.nice(NICENESS)
    config, clock, stop = run.load(run_file), WallClock(), Stop()
    world = (
        Simulation()
        .under(config.reality, eyes=config.eyes, localisation=config.localisation)
        .world(config.world, vary_seed=config.variation_seed)
    )
    plant = world.plant(description.load(config.robot), seed=config.seed)
    while not (stop or (config.memory / NAME).exists()):
        clock.sleep_until(clock.now_s() + PERIOD_S)
    if stop:
        return
    with (
        SceneMemory(plant.model, config.memory, create=False) as scene,
        plant.camera() as camera,
        ZenohBus("camera", config.sockets) as bus,
    ):
        photographer = Photographer(
            scene, plant.data, camera, bus=bus, clock=clock, album=Path(config.folder) / ALBUM
        )
        while not stop:
            due_s = clock.now_s() + PERIOD_S
            photographer.step()
            clock.sleep_until(due_s)


if __name__ == "__main__":
    main(*sys.argv[1:])
