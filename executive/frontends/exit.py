"""How a command ends that could not do its work: a sentence, a cure, an exit status."""

from __future__ import annotations

import errno
import traceback
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from executive.frontends import namesakes
from executive.frontends.output import say, write_json
from executive.journal import failures
from robot.errors import ConfigError, DriverError, Problem, RobotError
from robot.exit_status import ExitStatus

if TYPE_CHECKING:
    from executive.meaning.request import Refused


class NothingMoved(KeyboardInterrupt):
    """Ctrl-C that came before a robot was started."""


@contextmanager
def before_it_moves() -> Generator[None]:
    """Nothing in the block starts a robot: Ctrl-C inside it is told as such."""
    try:
        yield
    except KeyboardInterrupt:
        raise NothingMoved from None


USED_UP = (errno.EAGAIN, errno.ENOMEM, errno.EMFILE, errno.ENFILE, errno.ENOSPC, errno.EDQUOT)
"""What the machine has no more of: processes, memory, open files, room on the disk."""
NO_THREAD = "can't start new thread"
"""CPython's words, for want of an error number."""


def ended_by(error: BaseException, *, as_json: bool) -> int:
    """Say what went wrong and what to do, as JSON where that was asked for; the exit status."""
    if isinstance(error, ConfigError):
        problems = [str(problem) for problem in error.problems]
        cure = _cure(error.problems, as_json=as_json)
        return last_words("Not done:", problems, cure, status=ExitStatus.INVALID, as_json=as_json)
    if isinstance(error, DriverError):
        cure = "see to that device, then try again (docs/hardware.md)"
        return last_words("Broken:", [str(error)], cure, status=ExitStatus.BROKEN, as_json=as_json)
    if isinstance(error, RobotError):
        cure = "try again; humanoid doctor says whether something is missing"
        return last_words("Broken:", [str(error)], cure, status=ExitStatus.BROKEN, as_json=as_json)
    if isinstance(error, KeyboardInterrupt):
        lines = ["nothing was started, and nothing has moved"]
        lines = lines if isinstance(error, NothingMoved) else []
        return last_words(
            "Stopped on request.", lines, "", status=ExitStatus.FAILED, as_json=as_json
        )
    if isinstance(error, FileNotFoundError) and _is_nowhere():
        lines = ["the current folder is not there any more"]
        cure = "change into one that is (cd), then try again"
        return last_words("Not done:", lines, cure, status=ExitStatus.INVALID, as_json=as_json)
    if isinstance(error, OSError) and error.filename is not None:
        # Not what was foreseen, but of the machine and not of this software all the same.
        lines = [f"{error.filename}: {error.strerror}"]
        cure = "see to it that the file is there and yours to use, then try again"
        return last_words("Not done:", lines, cure, status=ExitStatus.INVALID, as_json=as_json)
    if wanting := _used_up(error):
        lines = [wanting]
        cure = "end other programs, or raise the limits of this one (ulimit -a), then try again"
        return last_words("Not done:", lines, cure, status=ExitStatus.INVALID, as_json=as_json)
    if wrong := namesakes.explained(error):
        status = ExitStatus.BROKEN
        return last_words("Broken:", wrong, namesakes.CURE, status=status, as_json=as_json)
    lines = "".join(traceback.format_exception(error)).splitlines()
    cure = "that is a mistake in this software: report the lines above, with the run folder"
    return last_words("Broken:", lines, cure, status=ExitStatus.BROKEN, as_json=as_json)


def _cure(problems: list[Problem], *, as_json: bool) -> str:
    """What to do where each problem does not say so itself, as one outside any file does."""
    own = [one.suggestion for one in problems if one.suggestion and one.file is None]
    if len(own) < len(problems):
        return "correct that, then try again"
    return "; ".join(dict.fromkeys(own)) if as_json else ""  # as text it stands behind each


def _is_nowhere() -> bool:
    """Whether the current folder was removed, which Python and its libraries stumble over."""
    try:
        Path.cwd()
    except FileNotFoundError:
        return True
    return False


def _used_up(error: BaseException) -> str:
    """What the machine has no more of, "" if it is something else."""
    if isinstance(error, MemoryError):
        return "there is no memory left"
    if isinstance(error, RuntimeError) and str(error) == NO_THREAD:
        return "no further thread can be started"
    if isinstance(error, OSError) and error.errno in USED_UP:
        return error.strerror or str(error)
    return ""


def last_words(heading: str, lines: list[str], cure: str, *, status: int, as_json: bool) -> int:
    """Print why nothing comes of it; returns the status."""
    if as_json:
        outcome = "invalid" if status == ExitStatus.INVALID else "failed"
        record = {"status": outcome, "exit_status": status, "reason": lines, "suggestion": cure}
        write_json(record)
        return status
    say("\n".join(["\n  ".join([heading, *lines]), *failures.advice(cure)]), err=True)
    return status


def refuse(refused: Refused, *, as_json: bool) -> int:
    """Say why nothing is done; returns the status."""
    if as_json:
        status = int(ExitStatus.INVALID)
        write_json({"status": "invalid", "exit_status": status, **msgspec.to_builtins(refused)})
        return status
    heading = "Question" if refused.outcome == "question" else "Not done"
    say("\n".join([f"{heading}: {refused.reason}", *failures.advice(refused.suggestion)]))
    return ExitStatus.INVALID
