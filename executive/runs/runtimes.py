"""What a run is set up with, and which runtime and planner go together.

`fast` runs in this process, `live` as processes of their own.
"""

from __future__ import annotations

import tempfile
from collections.abc import Generator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Literal, NamedTuple

import msgspec

from executive.engine.loop import Runtime
from executive.meaning.request import Setting
from robot.bringup.mailbox import Handle
from robot.planning.worker import Planner

Kind = Literal["fast", "live"]


class Setup(msgspec.Struct, frozen=True, kw_only=True):
    """What a run is set up with.

    Attributes:
        where: robot and world.
        kind: which runtime.
        seed: of everything random.
        folder: of the run, for its journal and the processes' logs (None: nothing is kept).
    """

    where: Setting
    kind: Kind = "fast"
    seed: int = 0
    folder: Path | None = None


class Opened(NamedTuple):
    """A robot that is up: its runtime, and what answers the skills' requests for plans."""

    runtime: Runtime
    planner: Planner


@contextmanager
def opened(setup: Setup, *, handle: Handle | None = None) -> Generator[Opened]:
    """Start a runtime and a planner, and leave nothing behind.

    Args:
        setup: of the run.
        handle: of a live run whose processes the process above looks after.

    Raises:
        RobotError: if a part cannot be built or a process does not start.
    """
    where = setup.where
    if setup.kind == "fast":
        from robot.bringup.fast import FastRuntime
        from robot.planning.inline import InlinePlanner

        with FastRuntime(where.world, where.robot_name, seed=setup.seed) as runtime:
            yield Opened(runtime, InlinePlanner(where.description))
        return
    from robot.bringup.live import LiveRuntime
    from robot.planning.process import ProcessPlanner

    with ExitStack() as stack:
        temporary = tempfile.TemporaryDirectory(prefix="humanoid-")
        logs = setup.folder or Path(stack.enter_context(temporary))
        planner = stack.enter_context(ProcessPlanner(where.description))
        runtime = LiveRuntime(
            where.world_name,
            where.robot_name,
            folder=logs,
            seed=setup.seed,
            variation_seed=where.vary_seed,
            handle=handle,
        )
        yield Opened(stack.enter_context(runtime), planner)
