"""A skill as a script: a generator that yields whenever it has to wait for the next tick.

    def script(self) -> Script[None]:
        self.body.phase = "raising the arm"
        yield from move_arm(self.body, "right", plan)     # waits, then goes on

A script that returns has succeeded; one that raises `GaveUp` has failed with a value. Scripts are
run by `executive.skills.scripted.ScriptedSkill`.
"""

from __future__ import annotations

from collections.abc import Generator
from typing import Final, TypeAlias, TypeVar

from robot.failures import Failure, failure

T = TypeVar("T")
Script: TypeAlias = Generator[None, None, T]
"""Yields at every tick it waits for, and returns a T."""


OVER: Final = object()
"""What `next(script, OVER)` gives for a script that is over."""


class GaveUp(Exception):
    """Ends a script with a failure; never leaves the skill."""

    def __init__(self, reason: Failure) -> None:
        """Carry the failure."""
        self.failure = reason
        super().__init__(f"{reason.code}: {reason.cause}")


def give_up(code: str, cause: str, *, suggestion: str = "", **evidence: float | str) -> GaveUp:
    """The exception to raise for a failure of the catalogue."""
    return GaveUp(failure(code, cause, suggestion=suggestion, **evidence))


def side_by_side(*scripts: Script[None]) -> Script[None]:
    """Run scripts in the same ticks until all are over; one that gives up ends them all."""
    try:
        running = list(scripts)
        while running := [script for script in running if next(script, OVER) is not OVER]:
            yield
    finally:
        for script in scripts:
            script.close()
