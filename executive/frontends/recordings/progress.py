"""A bar on standard error while a recording is worked on; nothing where that is no terminal."""

from __future__ import annotations

from collections.abc import Callable, Generator
from contextlib import contextmanager

from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

from executive.frontends.output import Screen


@contextmanager
def counted(what: str, total: int) -> Generator[Callable[[int], None]]:
    """A bar of so many steps; it is told how many are done."""
    screen = Screen(err=True)
    columns = (TextColumn("{task.description}"), BarColumn(), TimeRemainingColumn())
    with Progress(*columns, console=screen, transient=True, disable=not screen.is_terminal) as bar:
        task = bar.add_task(what, total=total)
        yield lambda done: bar.update(task, completed=done)
