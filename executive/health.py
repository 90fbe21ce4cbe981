"""How well the robot is: the ladder of severities, and the report that climbs it."""

from __future__ import annotations

import math
from enum import IntEnum

import msgspec

from robot.failures import Failure


class Level(IntEnum):
    """What has to be done; the most severe finding wins."""

    OK = 0
    WARN = 1
    """tell people"""
    DERATE = 2
    """go on, slower"""
    RETURN = 3
    """go back to where it began, slower, and end the task there"""
    HOLD = 4
    """stop the task, stand, and wait for it to pass"""
    SIT = 5
    """end the task and come to rest"""
    DAMP = 6
    """the motors damp: the body lies; what it does fails by itself, and may be tried again"""


class Finding(msgspec.Struct, frozen=True, kw_only=True):
    """One thing that is not as it should be, how bad it is, and the failure it would be.

    `speed` is the part of its fastest walk that the robot may still use; `beginning` says that it
    only waits for the first word of something that has just been started, which every run does.
    """

    name: str
    level: Level
    failure: Failure
    speed: float = 1.0
    beginning: bool = False


class Health(msgspec.Struct, frozen=True, kw_only=True):
    """All findings of one look at the robot, worst first; none: it is well.

    `ages_s` says how old the newest message of each watched topic is; `speed_m_s` how fast the
    robot may walk as it is; `pressed` that what is not real-time has to make room.
    """

    findings: tuple[Finding, ...] = ()
    ages_s: dict[str, float] = {}
    speed_m_s: float = math.inf
    pressed: bool = False

    @property
    def level(self) -> Level:
        """The level of the worst finding."""
        return self.findings[0].level if self.findings else Level.OK

    def calls_for(self, level: Level) -> bool:
        """Whether a finding asks for just this level."""
        return any(finding.level is level for finding in self.findings)

    @property
    def beginning(self) -> bool:
        """Whether nothing worse is found than that something is only starting."""
        return bool(self.findings) and self.findings[0].beginning

    @property
    def failure(self) -> Failure | None:
        """The failure of the worst finding."""
        return self.findings[0].failure if self.findings else None
