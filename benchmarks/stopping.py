"""`python -m benchmarks.stopping`: from a person's "stop" to the command that the body gets.

A live robot walks; "stop" is said at a random moment of its 20 Hz tick, and the time until the
executive sends the command that ends the walking is taken, as often as asked for. With `--socket`
it is said through the socket of a robot that is up, as `humanoid stop` says it once it is loaded.
"""

from __future__ import annotations

import random
import tempfile
import time
from collections.abc import Callable, Generator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from executive.frontends.prompt.commands import table
from executive.frontends.prompt.robot import Robot
from executive.frontends.prompt.shell import Shell
from executive.frontends.service.client import press
from executive.frontends.service.counter import Counter
from executive.frontends.service.place import Running, claimed
from executive.frontends.service.telling import Log
from executive.meaning import request
from executive.runs.runtimes import Setup
from robot.clock import WallClock
from robot.messages import BodyCommand, Stand
from sim.simulation import Simulation

GIVE_UP_S = 5.0


def main(
    times: Annotated[int, typer.Option(help="how often")] = 20,
    *,
    socket: Annotated[bool, typer.Option("--socket", help="from another terminal")] = False,
) -> None:
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
            spans_ms = [1e3 * _once(robot, rng, socket=socket) for _ in range(times)]
    low, middle, high = np.percentile(spans_ms, [0, 50, 100])
    print(f"stop to command, {times} times: {low:.1f} / {middle:.1f} / {high:.1f} ms (min/p50/max)")


def _once(robot: Robot, rng: random.Random, *, socket: bool) -> float:
    """Walk, stop, and wait for the rest; the time from the word to the command [s]."""
    shell = Shell(robot, lambda _text: None, table=table.commands, folder=Path())
    with _stopper(shell, socket=socket) as stop:
        return _timed(robot, shell, rng, stop)


@contextmanager
def _stopper(shell: Shell, *, socket: bool) -> Generator[Callable[[], object]]:
    """What says stop: the prompt, or another terminal."""
    if not socket:
        yield lambda: shell.line("stop")
        return
    told = Running(pid=0, run="", private="", world="empty", robot="juno", runtime="live")
    with (
        claimed("stopping-benchmark") as place,
        Counter(shell, place=place, running=told, log=Log(Path(place.folder))),
    ):
        yield lambda: press(place, "stop", lambda _: None)


def _timed(robot: Robot, shell: Shell, rng: random.Random, stop: Callable[[], object]) -> float:
    """Walk, stop, and wait for the rest; the time from the word to the command [s]."""
    link = robot.session.runtime.link
    send = link.send
    sent_s: list[float] = []

    def watched(command: BodyCommand) -> None:
        if isinstance(command, Stand):
            sent_s.append(time.perf_counter())
        send(command)

    shell.line("walk 0.6 m forward" if rng.random() < 0.5 else "walk 0.6 m back")
    until_s = time.monotonic() + GIVE_UP_S
    while robot.view.mode != "walk" and time.monotonic() < until_s:
        time.sleep(0.01)
    time.sleep(rng.uniform(0.2, 0.4))
    link.send = watched
    said_s = time.perf_counter()
    stop()
    while not sent_s and time.perf_counter() - said_s < GIVE_UP_S:
        time.sleep(0.0005)
    robot.wait()
    link.send = send
    return (sent_s[0] if sent_s else float("inf")) - said_s


if __name__ == "__main__":
    typer.run(main)
