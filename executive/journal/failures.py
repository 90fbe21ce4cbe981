"""A failure in words: what every command, prompt, voice and dump says of one.

A failure has a code for programs, a cause for people, and maybe a suggestion of its own
(`robot.errors.Failure`); the journal's and the summary's records of one have the same fields.
"""

from __future__ import annotations

from typing import Protocol

from robot.errors import CATALOGUE


class Failed(Protocol):
    """What has failed: a `Failure`, or a record of one."""

    @property
    def code(self) -> str:
        """From the catalogue."""
        ...

    @property
    def cause(self) -> str:
        """A sentence without its end."""
        ...


def named(reason: Failed, *, measured: str = "") -> str:
    """Cause and code, with what was measured: "it slipped (grasp_missed: gap 0.1 m)"."""
    return f"{reason.cause} ({reason.code}{f': {measured}' if measured else ''})"


def verdict(reason: Failed | None) -> str:
    """How something ended; None: well."""
    return f"Failed: {named(reason)}" if reason else "Done."


def suggestion(code: str, own: str = "") -> str:
    """What a person can do about a failure: what it says itself, else what the catalogue does."""
    return own or (CATALOGUE[code].suggestion if code in CATALOGUE else "")


def advice(cure: str, *, end: str = "") -> list[str]:
    """The line that says what to do; none where there is nothing."""
    return [f"What to do: {cure}{end}"] if cure else []


def confessed(cause: str | None) -> str:
    """How a job ended, in the robot's own words; no cause: well."""
    return f"I could not do that: {cause}." if cause else "Done."
