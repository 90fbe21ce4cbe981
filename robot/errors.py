"""Broken promises (a bad file, a dead bus, a torn memory), which are exceptions.

What a robot could not do is no exception but a value: see `robot.failures`::

    RobotError
    ├── ConfigError        a file or a flag says something that cannot be meant
    ├── DescriptionError   a robot description and its MJCF disagree
    ├── BusError           a message could not be sent, decoded or trusted
    ├── DriverError        hardware (or its stand-in) did not answer as agreed
    │   └── DeviceNotAllowed   (a ConfigError, too) a user's configuration does not name a device
    └── ProcessError       a process did not start, or died
"""

from __future__ import annotations

import msgspec


class RobotError(Exception):
    """Root of every exception this project raises on purpose."""


class ConfigError(RobotError):
    """A configuration cannot be used. `problems` holds every one found, best place first."""

    def __init__(self, problems: list[Problem] | str) -> None:
        """Make the error from located problems, or from one sentence."""
        if isinstance(problems, str):
            problems = [Problem(message=problems)]
        self.problems = problems
        super().__init__("\n".join(str(problem) for problem in problems))


class DescriptionError(ConfigError):
    """A robot description and its MJCF disagree (a missing joint, a wrong group)."""


class BusError(RobotError):
    """A message could not be sent, decoded or trusted."""


class DriverError(RobotError):
    """A device did not answer as agreed."""


class DeviceNotAllowed(ConfigError, DriverError):
    """The user's own configuration does not let robots open a device; nothing was opened."""


class ProcessError(RobotError):
    """A process did not start, or died."""


class Problem(msgspec.Struct, frozen=True):
    """One thing wrong in a file: where, what, and the cure."""

    message: str
    file: str | None = None
    line: int | None = None
    column: int | None = None
    suggestion: str | None = None

    def __str__(self) -> str:
        """`file:line:column: message (suggestion)`, leaving out what is not known.

        A message may repeat a name out of a file, and a name may be a megabyte.
        """
        place = ":".join(str(part) for part in (self.file, self.line, self.column) if part)
        text = f"{place}: {shortened(self.message)}" if place else shortened(self.message)
        return f"{text} ({shortened(self.suggestion)})" if self.suggestion else text


MOST_SAID = 1000
"""Characters of a message; our own have at most half as many."""


def shortened(text: str, most: int = MOST_SAID) -> str:
    """A text for people, of which the end is left out where it is too long to be read."""
    return text if len(text) <= most else f"{text[:most]}..."
