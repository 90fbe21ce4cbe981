"""What a run is made of for people: what was asked, which steps were tried, what else happened."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Literal

import msgspec

from robot.errors import CATALOGUE

Result = Literal["going on", "done", "failed", "stopped"]


class Reason(msgspec.Struct, frozen=True):
    """A failure as a journal has it."""

    code: str
    cause: str
    evidence: dict[str, Any] = {}

    @property
    def suggestion(self) -> str:
        """What a person can usually do about it."""
        return CATALOGUE[self.code].suggestion if self.code in CATALOGUE else ""


class Recovery(msgspec.Struct, frozen=True):
    """What was done about a failure: a remedy and its number, or why nothing ("")."""

    t_s: float
    code: str
    remedy: str
    words: str


@dataclass
class Attempt:
    """One go at a step.

    Attributes:
        step, id: the step's name, and its path in the task (empty in old journals).
        began_s, ended_s: when; None while it goes on.
        phase, phase_s: what it did last, and since when.
        result: how it ended.
        reason: why it failed.
        recoveries: what was done about that, one after the other.
        remedies: the steps of the recoveries before the next go.
    """

    step: str
    id: str
    began_s: float
    phase: str = ""
    phase_s: float = 0.0
    ended_s: float | None = None
    result: Result = "going on"
    reason: Reason | None = None
    recoveries: list[Recovery] = field(default_factory=list[Recovery])
    remedies: list[Attempt] = field(default_factory=list["Attempt"])


class Note(msgspec.Struct, frozen=True):
    """Something that happened to the robot or that a person did, in words."""

    t_s: float
    kind: str
    words: str


@dataclass
class Story:
    """A run, or one job of it.

    Attributes:
        header: what the run was started with.
        text: what was asked for.
        began_s, last_s: time of the first and of the newest event.
        attempts: every go at every step, in order; those of remedies stand with what they remedy.
        notes: health, faults, holds, what people did.
        state: of the job, or how it ended; "" where the journal just ends.
        reason: why it failed.
        missing: how many events were lost.
    """

    header: dict[str, Any] = field(default_factory=dict[str, Any])
    text: str = ""
    began_s: float = 0.0
    last_s: float = 0.0
    attempts: list[Attempt] = field(default_factory=list[Attempt])
    notes: list[Note] = field(default_factory=list[Note])
    state: str = ""
    reason: Reason | None = None
    took_s: float | None = None
    missing: int = 0

    @property
    def idle(self) -> bool:
        """Whether somebody was there and asked for nothing."""
        return bool(self.header.get("attended")) and not self.attempts and not self.state

    @property
    def current(self) -> Attempt | None:
        """The newest go that has not ended."""
        going = [one for one in self.everything() if one.result == "going on"]
        return going[-1] if going else None

    def everything(self) -> list[Attempt]:
        """Every go in order, those of remedies included."""
        found: list[Attempt] = []
        for one in self.attempts:
            found += [one, *one.remedies]
        return found

    def of(self, step: Attempt) -> list[Attempt]:
        """Every go at the same step, in order."""
        return [one for one in self.attempts if same(one, step)]


def base(step_id: str) -> str:
    """The path of a step without the numbers of its recoveries: those of "2.1+1" is "2.1"."""
    return step_id.partition("+")[0]


def same(one: Attempt, other: Attempt) -> bool:
    """Whether two goes are at the same step."""
    return (one.step, base(one.id)) == (other.step, base(other.id))
