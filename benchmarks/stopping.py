"""`python -m benchmarks.stopping`: from a person's "stop" to the command that the body gets.

A live robot walks; "stop" is said at a random moment of its 20 Hz tick, and the time until the
executive sends the command that ends the walking is taken, as often as asked for.
"""

from __future__ import annotations

import random
import tempfile
import time
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from executive.frontends.prompt.commands import table
from executive.frontends.prompt.robot import Robot
from executive.frontends.prompt.shell import Shell
from executive.meaning import request
from executive.runs.runtimes import Setup
from robot.clock import WallClock
from robot.messages import BodyCommand, Stand
from sim.simulation import Simulation

GIVE_UP_S = 5.0


def main(times: Annotated[int, typer.Option(help="how often")] = 20) -> None:
    """Measure, and print one line."""
    rng = random.Random(0)
    where = request.setting(Simulation(), "empty", robot="juno")
    with tempfile.TemporaryDirectory() as folder:
        robot = Robot(
            Setup(where=where, kind="live", folder=Path(folder)),
            wall=WallClock(),
            time_of_day=time.time,
        )
        with robot:
            spans_ms = [1e3 * _once(robot, rng) for _ in range(times)]
    low, middle, high = np.percentile(spans_ms, [0, 50, 100])
    print(f"stop to command, {times} times: {low:.1f} / {middle:.1f} / {high:.1f} ms (min/p50/max)")


def _once(robot: Robot, rng: random.Random) -> float:
    """Walk, stop, and wait for the rest; the time from the word to the command [s]."""
    link = robot.session.runtime.link
    send = link.send
    sent_s: list[float] = []

    def watched(command: BodyCommand) -> None:
        if isinstance(command, Stand):
            sent_s.append(time.perf_counter())
        send(command)

    shell = Shell(robot, lambda _text: None, table=table.commands, folder=Path())
    shell.line("walk 0.6 m forward" if rng.random() < 0.5 else "walk 0.6 m back")
    until_s = time.monotonic() + GIVE_UP_S
    while robot.view.mode != "walk" and time.monotonic() < until_s:
        time.sleep(0.01)
    time.sleep(rng.uniform(0.2, 0.4))
    link.send = watched
    said_s = time.perf_counter()
    shell.line("stop")
    while not sent_s and time.perf_counter() - said_s < GIVE_UP_S:
        time.sleep(0.0005)
    robot.wait()
    link.send = send
    return (sent_s[0] if sent_s else float("inf")) - said_s


if __name__ == "__main__":
    typer.run(main)
