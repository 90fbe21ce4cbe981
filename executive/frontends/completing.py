"""What the shell completes: names that there are. Whatever cannot be found out is left out."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import wraps
from pathlib import Path

from robot.printable import is_printable

Find = Callable[[], Iterable[str]]


def completes(find: Find) -> Callable[[str], list[str]]:
    """A completion: those of the names that begin as it is typed; a mistake offers nothing."""

    @wraps(find)
    def complete(incomplete: str) -> list[str]:
        try:
            return [one for one in find() if one.startswith(incomplete) and is_printable(one)]
        except Exception:  # a shell's line is no place for it
            return []

    complete.__annotations__ = {"incomplete": str}
    del complete.__wrapped__  # typer asks for the parameters
    return complete


@completes
def worlds() -> Iterable[str]:
    """Shipped worlds, and files of this folder."""
    from executive.frontends.composition_root import REALITY

    return [*REALITY.names(), *_files()]


@completes
def robots() -> Iterable[str]:
    """Shipped robots, and files of this folder."""
    from robot.model import description

    return [*description.shipped(), *_files()]


@completes
def runs() -> Iterable[str]:
    """Runs of this folder, the newest first."""
    from executive.journal import past_runs

    return [folder.name for folder in reversed(past_runs.runs())]


def _files() -> list[str]:
    return sorted(path.name for path in Path().glob("*.y*ml"))
