"""What a run is set up with, and which runtime and planner go together.

`fast` runs in this process, `live` as processes of their own.
"""

from __future__ import annotations

import tempfile
from collections.abc import Generator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Literal, NamedTuple

import msgspec

from executive.engine.loop import Runtime
from executive.meaning.request import Setting
from executive.runs import lidar_maps
from robot.bringup.mailbox import Handle
from robot.errors import ConfigError, Problem
from robot.planning.worker import Planner
from robot.reality.trail import FILE as TRAIL_FILE

if TYPE_CHECKING:
    from robot.bringup.fast import FastRuntime
    from robot.bringup.live import LiveRuntime
    from robot.planning.process import ProcessPlanner

Kind = Literal["fast", "live"]


class Setup(msgspec.Struct, frozen=True, kw_only=True):
    """What a run is set up with.

    Attributes:
        where: robot and world.
        kind: which runtime.
        seed: of everything random.
        folder: of the run, for its journal and the processes' logs (None: nothing is kept).
        pictures: whether what the robot's camera sees is rendered, in a live run.
        driver: of the motors, in a live run; "" is the one that the robot's description names.
    """

    where: Setting
    kind: Kind = "fast"
    seed: int = 0
    folder: Path | None = None
    pictures: bool = False
    driver: str = ""


class Opened(NamedTuple):
    """A robot that is up: its runtime, and what answers the skills' requests for plans."""

    runtime: Runtime
    planner: Planner


@contextmanager
def fast(setup: Setup) -> Generator[tuple[FastRuntime, Planner]]:
    """A `fast` runtime and its planner. Raises RobotError if a part cannot be built."""
    from robot.bringup.fast import FastRuntime
    from robot.planning.inline import InlinePlanner

    where = setup.where
    map_file = lidar_maps.needed(where)
    trail = None if setup.folder is None else setup.folder / TRAIL_FILE
    with FastRuntime(
        where.world, where.robot_name, seed=setup.seed, lidar_map=map_file, trail=trail
    ) as runtime:
        yield runtime, InlinePlanner(where.description)


def live_parts() -> tuple[type[LiveRuntime], type[ProcessPlanner]]:
    """What a `live` run is opened with; loading it takes a while, which a spare does beforehand."""
    from robot.bringup.live import LiveRuntime
    from robot.planning.process import ProcessPlanner

    return LiveRuntime, ProcessPlanner


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
    if setup.kind == "fast" and setup.pictures:
        cure = "leave out --camera or --fast; humanoid sensors snap takes a picture at any time"
        raise ConfigError([Problem("pictures are rendered in live runs only", suggestion=cure)])
    if setup.kind == "fast":
        with fast(setup) as (runtime, planner):
            yield Opened(runtime, planner)
        return
    runtime_type, planner_type = live_parts()
    with ExitStack() as stack:
        temporary = tempfile.TemporaryDirectory(prefix="humanoid-")
        logs = setup.folder or Path(stack.enter_context(temporary))
        planner = stack.enter_context(planner_type(where.description))
        live = runtime_type(
            where.world,
            where.robot_name,
            folder=logs,
            seed=setup.seed,
            pictures=setup.pictures,
            handle=handle,
            motors=setup.driver,
            lidar_map=lidar_maps.needed(where),
        )
        yield Opened(stack.enter_context(live), planner)
