"""Which runtime and planner go together: `fast` in this process, `live` as processes."""

from __future__ import annotations

import tempfile
from collections.abc import Generator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from executive.engine.loop import Runtime
from executive.meaning.request import Setting
from robot.bringup.mailbox import Handle
from robot.planning.worker import Planner

if TYPE_CHECKING:
    from robot.bringup.fast import FastRuntime
    from robot.bringup.live import LiveRuntime
    from robot.planning.process import ProcessPlanner

Kind = Literal["fast", "live"]


@contextmanager
def fast(where: Setting, *, seed: int) -> Generator[tuple[FastRuntime, Planner]]:
    """A `fast` runtime and its planner. Raises RobotError if a part cannot be built."""
    from robot.bringup.fast import FastRuntime
    from robot.planning.inline import InlinePlanner

    with FastRuntime(where.world, where.robot_name, seed=seed) as runtime:
        yield runtime, InlinePlanner(where.description)


def live_parts() -> tuple[type[LiveRuntime], type[ProcessPlanner]]:
    """What a `live` run is opened with; loading it takes a while, which a spare does beforehand."""
    from robot.bringup.live import LiveRuntime
    from robot.planning.process import ProcessPlanner

    return LiveRuntime, ProcessPlanner


@contextmanager
def opened(
    kind: Kind,
    where: Setting,
    *,
    seed: int,
    folder: Path | None,
    handle: Handle | None = None,
) -> Generator[tuple[Runtime, Planner]]:
    """Start a runtime and a planner, and leave nothing behind.

    Args:
        kind: which runtime.
        where: robot and world.
        seed: of everything random.
        folder: of this run, for the processes' logs (None: a temporary one).
        handle: of a live run whose processes the process above looks after.

    Raises:
        RobotError: if a part cannot be built or a process does not start.
    """
    if kind == "fast":
        with fast(where, seed=seed) as parts:
            yield parts
        return
    runtime_type, planner_type = live_parts()
    with ExitStack() as stack:
        logs = folder or Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="humanoid-")))
        planner = stack.enter_context(planner_type(where.description))
        runtime = runtime_type(where.world, where.robot_name, folder=logs, seed=seed, handle=handle)
        yield stack.enter_context(runtime), planner
