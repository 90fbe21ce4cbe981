"""What the shell completes: names that there are. Whatever cannot be found out is left out.

A shell takes what it is offered as if it had been typed: bash runs `$(...)` in it with the line,
zsh while it completes. So only names are offered that mean the same quoted and not, in every shell.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Callable, Iterable
from functools import wraps
from pathlib import Path

from robot.printable import is_printable

Find = Callable[[], Iterable[str]]

_MARKS = frozenset("_.+@%/-")
_FIRST = frozenset("_./")
"""Before a hyphen it would be an option, before `@` and `%` a list or a job to some shells."""
_WRITTEN = frozenset(("Lu", "Ll", "Lt", "Lm", "Lo", "Mn", "Mc", "Nd"))
"""Letters of any script with their accents, and digits: categories of Unicode."""


def completes(find: Find) -> Callable[[str], list[str]]:
    """A completion: those of the harmless names that begin as it is typed; a mistake: none."""

    @wraps(find)
    def complete(incomplete: str) -> list[str]:
        try:
            return [one for one in find() if one.startswith(incomplete) and is_harmless(one)]
        except Exception:  # a shell's line is no place for it
            return []

    complete.__annotations__ = {"incomplete": str}
    del complete.__wrapped__  # typer asks for the parameters
    return complete


def is_harmless(name: str) -> bool:
    """Whether no shell sees more in a name than a name, wherever it puts it."""
    return (
        is_printable(name)
        and all(one in _MARKS or unicodedata.category(one) in _WRITTEN for one in name)
        and (name[:1] in _FIRST or unicodedata.category(name[:1] or " ") in _WRITTEN)
    )


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
