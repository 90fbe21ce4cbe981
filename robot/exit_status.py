"""How a command or a process ends: one table of exit statuses, for every command and every doc."""

from __future__ import annotations

from enum import IntEnum

from robot.failures import CATALOGUE, Failure


class ExitStatus(IntEnum):
    """The exit statuses of `humanoid`, and of the executive's process under it."""

    DONE = 0
    FAILED = 1
    INVALID = 2
    BROKEN = 3
    CRASHED = 70
    """Of an executive that ended by an exception nobody expected (EX_SOFTWARE of sysexits.h): it is
    started again, so that nobody sees this one."""


MEANINGS: dict[ExitStatus, str] = {
    ExitStatus.DONE: "done",
    ExitStatus.FAILED: "failed, or stopped on request: the last lines say why and what to do",
    ExitStatus.INVALID: "not understood or invalid: not possible here, or a file or an option is "
    "wrong; nothing was started",
    ExitStatus.BROKEN: "the system broke: a process died, or this software has a mistake",
}
"""What people see of them."""


def exit_status(reason: Failure | None) -> ExitStatus:
    """Of work that ended with a failure, or (None) without one."""
    if reason is None:
        return ExitStatus.DONE
    is_broken = CATALOGUE[reason.code].spoils == "system"
    return ExitStatus.BROKEN if is_broken else ExitStatus.FAILED


def in_short() -> str:
    """The table in one sentence."""
    heads = (
        f"{status:d} {meaning.split(',')[0].split(':')[0]}" for status, meaning in MEANINGS.items()
    )
    return f"Exit status: {', '.join(heads)}."
