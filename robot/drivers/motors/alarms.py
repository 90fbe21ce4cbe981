"""What is wrong with motors and buses, and what is done about it: the most severe wins."""

from __future__ import annotations

from collections.abc import Callable
from enum import IntEnum
from typing import Literal, NamedTuple

from robot.messages import MotorAlarm


class Level(IntEnum):
    """What is done, from nothing to the most.

    HOLD: every joint keeps its last target. SIT: whoever commands lowers the robot
    (`robot.control.lowering`), so that commands pass. DAMP and OFF no driver takes by itself: the
    owner of the buses does (`robot.owner.reactions`).
    """

    OK = 0
    WARN = 1
    DERATE = 2
    HOLD = 3
    SIT = 4
    DAMP = 5
    OFF = 6


DOES: dict[Level, str] = {
    Level.OK: "nothing; what was lost is bridged",
    Level.WARN: "says so",
    Level.DERATE: "gives less torque; the executive walks slower",
    Level.HOLD: "keeps every joint's last target, whatever is commanded; the task waits",
    Level.SIT: "obeys again, so that the controller squats within 2 to 3 s and stays low; the task "
    "ends",
    Level.DAMP: "gives no stiffness, every joint brakes; whatever stands goes down",
    Level.OFF: "gives no torque",
}
"""What is done at each level, for people."""

NAMES: dict[Level, Literal["WARN", "DERATE", "HOLD", "SIT", "DAMP", "OFF"]] = {
    Level.WARN: "WARN",
    Level.DERATE: "DERATE",
    Level.HOLD: "HOLD",
    Level.SIT: "SIT",
    Level.DAMP: "DAMP",
    Level.OFF: "OFF",
}


class Alarm(NamedTuple):
    """One thing wrong.

    Attributes:
        code: for programs, as in `silent`.
        who: the joint or the bus.
        level: what is done.
        cause, cure: for people.
        is_latched: whether only `reset` ends it.
    """

    code: str
    who: str
    level: Level
    cause: str
    cure: str
    is_latched: bool = False

    def __str__(self) -> str:
        """As a line for people."""
        return f"{self.who}: {self.cause} ({self.cure})"


class Kind(NamedTuple):
    """A row of a table of alarms (`docs/safety.md` is made of them).

    Attributes:
        code: for programs.
        level: what is done.
        when: what it takes, for people.
        within: how long that takes.
        is_latched: whether only `reset` ends it.
    """

    code: str
    level: Level
    when: str
    within: str
    is_latched: bool = False

    def alarm(self, who: str, cause: str, cure: str, *, code: str = "") -> Alarm:
        """One of this kind; by another code where a row stands for several."""
        return Alarm(code or self.code, who, self.level, cause, cure, self.is_latched)


BY_STATUS = ("over_current", "overload")
"""Faults of a motor that end by themselves, and lead to HOLD; one that is not named here: SIT."""


class Alarms:
    """The alarms that are on, by code and by whom they concern."""

    def __init__(self) -> None:
        """None yet."""
        self._on: dict[tuple[str, str], Alarm] = {}

    @property
    def level(self) -> Level:
        """The most severe."""
        return max((alarm.level for alarm in self._on.values()), default=Level.OK)

    @property
    def on(self) -> tuple[Alarm, ...]:
        """All of them, the most severe first."""
        return tuple(sorted(self._on.values(), key=lambda alarm: -alarm.level))

    def messages(self) -> tuple[MotorAlarm, ...]:
        """All of them for whoever commands, the most severe first."""
        if not self._on:
            return ()
        return tuple(
            MotorAlarm(one.code, one.who, NAMES[one.level], one.cause, one.cure)
            for one in self.on
            if one.level in NAMES
        )

    def sound(self, alarm: Alarm) -> None:
        """Begin one; one that is latched stays, whatever comes after it."""
        key = alarm.code, alarm.who
        before = self._on.get(key)
        if before is None or not before.is_latched or alarm.level > before.level:
            self._on[key] = alarm

    def quiet(self, code: str, who: str) -> None:
        """End one, unless it is latched."""
        if self._on and (alarm := self._on.get((code, who))) and not alarm.is_latched:
            del self._on[code, who]

    def reset(self) -> None:
        """End all of them: what is still wrong sounds again."""
        self._on.clear()


class News:
    """Says what is new of alarms, a line each."""

    def __init__(self, alarms: Alarms, tell: Callable[[str], None]) -> None:
        """Nothing was said yet; `tell` hears the lines."""
        self._alarms, self._tell = alarms, tell
        self._told = frozenset[str]()

    def say(self, now_s: float) -> None:
        """Say which began since the last time, or got worse."""
        if not self._alarms.on and not self._told:
            return
        on = {f"{one.code} {one.who} {one.level.name}": one for one in self._alarms.on}
        for key in on.keys() - self._told:
            self._tell(f"{now_s:.3f} s, {on[key].level.name}: {on[key]}")
        self._told = frozenset(on)


def untold(_line: str) -> None:
    """Hear nothing."""
