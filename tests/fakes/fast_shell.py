"""A prompt of a robot in the fast runtime, and what it says."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from executive.frontends.composition_root import REALITY
from executive.frontends.prompt.commands import table
from executive.frontends.prompt.robot import Robot
from executive.frontends.prompt.shell import Shell
from executive.meaning import request
from executive.runs.runtimes import Setup
from intents.language_model import LanguageModel
from robot.clock import WallClock


@contextmanager
def shell_in(
    folder: Path, world: str = "kitchen", model: LanguageModel | None = None
) -> Iterator[Shell]:
    where = request.setting(REALITY, world, robot="juno")
    robot = Robot(Setup(where=where, folder=folder), wall=WallClock(), time_of_day=lambda: 0.0)
    with robot:
        yield Shell(robot, Said(), table=table.commands, folder=folder, model=model)


class Said(list[str]):
    """What the shell says."""

    __call__ = list[str].append

    @property
    def text(self) -> str:
        return "\n".join(self)
