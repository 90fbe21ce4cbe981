"""A shell before a puppet that walks: orders come to something, without a plant."""

from __future__ import annotations

import time
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path

from executive.frontends.composition_root import REALITY
from executive.frontends.prompt.commands import table
from executive.frontends.prompt.robot import Robot
from executive.frontends.prompt.shell import Shell
from executive.meaning import request
from executive.runs import runtimes
from executive.runs.runtimes import Kind, Opened, Setup
from robot.clock import WallClock
from robot.se3 import SE3
from tests.fakes.puppet_prompt import Paced
from tests.fakes.puppet_runtime import PuppetRuntime, SensingPuppet


@contextmanager
def puppet_shell(
    folder: Path, said: list[str], *, world: str = "kitchen", kind: Kind = "live"
) -> Generator[Shell]:
    """A shell whose robot is up; what it says is put into `said`.

    Where `kind` is live, its time goes on by the wall's clock; where it is fast, nobody waits.
    """
    where = request.setting(REALITY, world, robot="juno")
    paced = Paced if kind == "live" else PuppetRuntime
    runtime = paced(SensingPuppet(where.description, {}, where.world_map, X_WN=SE3()))

    @contextmanager
    def opened(_setup: Setup, *, handle: object = None) -> Generator[Opened]:
        yield Opened(runtime, runtime.planner)

    before, runtimes.opened = runtimes.opened, opened  # type: ignore[assignment]
    try:
        setup = Setup(where=where, kind=kind, folder=folder)
        with Robot(setup, wall=WallClock(), time_of_day=time.time) as robot:
            yield Shell(robot, said.append, table=table.commands, folder=folder)
    finally:
        runtimes.opened = before
