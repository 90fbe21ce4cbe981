"""Perception as a process."""

from __future__ import annotations

import sys
from pathlib import Path

from robot.bus import run
from robot.bus.lifeline import Stop, Turn, ask_for_turn, tie_to_parent
from robot.bus.zenoh_bus import ZenohBus
from robot.clock import WallClock
from robot.drivers.wiring import Wiring
from robot.model import description
from robot.perception.album import Album
from robot.perception.node import PerceptionNode
from robot.shots import COLOUR_FILE

PERIOD_S = 0.02


def main(run_file: str, parent_pid: str) -> None:
    """Load, build, run, close."""
    tie_to_parent(int(parent_pid))
    ask_for_turn(Turn.SENSES)
    config, clock = run.load(run_file), WallClock()
    robot = description.load(config.robot)
    with ZenohBus("perception", config.sockets) as bus:
        album = Album(Path(config.folder) / COLOUR_FILE)
        wiring = Wiring(robot=robot, clock=clock, bus=bus)
        node = PerceptionNode(
            wiring,
            looks=config.pictures,
            album=album,
            eyes=config.eyes,
            localisation=config.localisation,
            lidar_map=Path(config.lidar_map) if config.lidar_map else None,
        )
        stop = Stop()
        with node:
            while not stop:
                due_s = clock.now_s() + PERIOD_S
                node.step()
                clock.sleep_until(due_s)


if __name__ == "__main__":
    main(*sys.argv[1:])
