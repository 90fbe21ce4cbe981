"""A failure in words: what every command, prompt, voice and dump says of one.

A failure has a code for programs, a cause for people, and maybe a suggestion of its own
(`robot.failures.Failure`); the journal's and the summary's records of one have the same fields.
"""

from __future__ import annotations

from typing import Protocol

from robot.failures import CATALOGUE


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


def in_first_person(what: str, cause: str, *, stopped: bool = False) -> str:
    """What the robot says of something that it did not do, or stopped doing."""
    return f"I {'stopped' if stopped else 'could not do'} {what}: {cause}."


def because(cause: str | None) -> str:
    """What stands behind something that has failed; nothing behind what has not."""
    return f": {cause}" if cause else ""
