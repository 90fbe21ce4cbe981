"""The real prompt on a terminal, before a puppet that walks: a program for tests of front ends.

`python -m tests.fakes.puppet_prompt FOLDER TOLD HEARD`: what the robot does is written to the file
descriptor TOLD, a line a change; a line on HEARD lets it walk, whatever the prompt is about.
"""

from __future__ import annotations

import os
import sys
import threading
import time
from collections.abc import Generator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from executive.frontends import speaking, streams
from executive.frontends.composition_root import REALITY
from executive.frontends.prompt import cli
from executive.frontends.prompt.commands import table
from executive.frontends.prompt.robot import Robot
from executive.frontends.prompt.shell import Shell
from executive.frontends.prompt.terminal import Terminal
from executive.meaning import request
from executive.runs import runtimes
from executive.runs.runtimes import Opened, Setup
from robot.clock import WallClock
from robot.se3 import SE3
from tests.fakes.puppet_runtime import PuppetRuntime, SensingPuppet

PACE = 10.0
"""So many times as fast as the wall's clock: a walk begins in a few hundredths of a second."""
ROUND = "walk 1.5 m forward and walk 1.5 m back"
ERRAND = "50 times: " + ROUND
"""Longer than any try."""


@dataclass
class Paced(PuppetRuntime):
    """A puppet that takes its time."""

    def advance(self, duration_s: float) -> None:
        time.sleep(duration_s / PACE)
        super().advance(duration_s)


def main(folder: Path, told: int, heard: int) -> None:
    streams.steady()
    where = request.setting(REALITY, "empty", robot="juno")
    puppet = SensingPuppet(where.description, {}, where.world_map, X_WN=SE3())
    runtime = Paced(puppet)

    @contextmanager
    def opened(_setup: Setup, *, handle: object = None) -> Generator[Opened]:
        yield Opened(runtime, runtime.planner)

    runtimes.opened = opened  # type: ignore[assignment]
    setup = Setup(where=where, kind="live", folder=folder)
    robot = Robot(setup, wall=WallClock(), time_of_day=time.time)
    last = ""

    def tell() -> None:
        nonlocal last
        walking, busy = int(puppet.mode == "walk"), int(robot.busy)
        line = f"{walking} {busy} {len(robot.executive.jobs)}\n"
        if line != last:
            last = line
            os.write(told, line.encode())

    with robot, robot.interrupts.listen():
        errand = request.request(ERRAND, where)
        assert isinstance(errand, request.Understood), errand

        def obey() -> None:
            while os.read(heard, 1):
                robot.executive.resume()  # whatever was pasted before may have paused it
                robot.submit(errand)

        threading.Thread(target=obey, daemon=True).start()
        robot.session.on_tick(tell)
        robot.session.journal.listen(cli.Telling(cli.say))
        shell = Shell(robot, cli.say, table=table.commands, folder=folder)
        shell.speech = speaking.Speech()
        Terminal(shell, history=folder / "history").run()
    os.write(told, b"left\n")


if __name__ == "__main__":
    main(Path(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3]))
