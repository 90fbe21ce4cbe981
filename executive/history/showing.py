"""`humanoid why` and `humanoid history`: what they print."""

from __future__ import annotations

import re
from collections.abc import Iterable

import msgspec
import typer
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from executive import journal
from executive.history import past
from executive.history.past import Past
from executive.history.why import why as explain

PIPE_WIDTH = 160
_STYLES = {"done": "green", "failed": "red", "under way": "yellow"}


def why(run: str | None, *, as_json: bool) -> int:
    """Say why a run (by default the newest) ended as it did; returns the exit status."""
    folder = past.find(run)
    told = explain(journal.read(folder), live=journal.is_written(folder))
    if as_json:
        record = {"folder": str(folder), **msgspec.to_builtins(told)}
        typer.echo(msgspec.json.encode(record))
    else:
        typer.echo(told.text)
        typer.echo(f"({folder})")
    return 0


def history(*, count: int, as_json: bool) -> int:
    """List the newest runs, the newest last; returns the exit status."""
    known = past.runs()
    shown = [past.look(folder) for folder in known[-count:]]
    if as_json:
        typer.echo(msgspec.json.encode(shown))
        return 0
    if not shown:
        typer.echo(f'There is no run in {past.BASE}/ yet. Begin with: humanoid do "squat" --fast')
        return 0
    console = Console(highlight=False)
    if not console.is_terminal:
        console.width = PIPE_WIDTH
    console.print(_table(shown))
    if len(known) > len(shown):
        typer.echo(f"{len(known) - len(shown)} older ones: humanoid history --all")
    return 0


def _table(shown: Iterable[Past]) -> Table:
    table = Table(box=None, pad_edge=False, header_style="bold")
    table.add_column("run", no_wrap=True, min_width=15)
    table.add_column("took", no_wrap=True, min_width=5, justify="right")
    table.add_column("", no_wrap=True, min_width=4, style="dim")
    table.add_column("how it ended", no_wrap=True, min_width=15)
    table.add_column("what", overflow="ellipsis", no_wrap=True)
    for one in shown:
        name = one.folder.rpartition("/")[2]
        stamp = re.match(r"\d{8}-\d{6}", name)
        table.add_row(
            stamp[0] if stamp else name,
            f"{one.took_s:.0f} s",
            one.runtime,
            f"[{_STYLES.get(one.ending, 'dim')}]{one.code or one.ending}[/]",
            escape(one.text),
        )
    return table
