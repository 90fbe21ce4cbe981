"""Arming motors again whose owner lets no controller: a person's wish, and its answer."""

from __future__ import annotations

from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path

import msgspec

from robot.bringup import private_folder
from robot.bringup.mailbox import RUN_FILE
from robot.bus import run
from robot.clock import Clock
from robot.drivers.motors.alarms import Level
from robot.drivers.motors.owned.memory import NAME, OwnerMemory, Standing
from robot.errors import ConfigError, DriverError
from robot.model import description

PATIENCE_S = 3.0
"""An owner answers in its next period, where it is not busy enabling motors."""
POLL_S = 0.01


class Rearmed(msgspec.Struct, frozen=True):
    """What became of a wish.

    Attributes:
        robot: whose motors they are.
        before: what their owner did, a name of `Level`.
        refused: why they are not armed; "" if they are.
    """

    robot: str
    before: str
    refused: str


def owned() -> list[Path]:
    """Folders of this user's runs whose motors a process owns."""
    return [path for path in private_folder.there() if (path / NAME).is_file()]


@contextmanager
def opened(folder: Path) -> Generator[tuple[str, OwnerMemory]]:
    """A robot's name and the memory of its motors' owner.

    Raises:
        ConfigError, DriverError: it cannot be opened: that run has just ended, or is of another
            version.
    """
    config = run.load(folder / RUN_FILE)
    robot = description.load(config.robot).driven_by(config.motors)
    with OwnerMemory(robot, folder) as memory:
        yield robot.name, memory


def rearm(folder: Path, clock: Clock) -> Rearmed:
    """Wish that the owner in a folder lets a controller command again.

    Raises:
        ConfigError: as `opened`.
        DriverError: as `opened`, or the owner does not answer.
    """
    with opened(folder) as (name, memory):
        before = memory.standing()
        after = asked(memory, clock)
        return Rearmed(name, before.level.name, after.refused)


def asked(memory: OwnerMemory, clock: Clock) -> Standing:
    """Ask for a reset; returns how the owner is after it. Raises DriverError without an answer."""
    number, until_s = memory.wish_reset(), clock.now_s() + PATIENCE_S
    while (standing := memory.standing()).answered < number:
        if clock.now_s() > until_s:
            raise DriverError("the owner of the buses does not answer: is it still there?")
        clock.sleep_until(clock.now_s() + POLL_S)
    return standing


def newest() -> Path:
    """The folder of the only run whose motors are owned, or of one that acts alone.

    Raises:
        ConfigError: if there is none.
    """
    folders = owned()
    for folder in folders:
        with opened(folder) as (_, memory):
            if memory.standing().level >= Level.SIT:
                return folder
    if not folders:
        raise ConfigError("no robot of yours runs whose motors a process owns (bus_owner)")
    return folders[0]
