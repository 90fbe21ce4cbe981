"""How what came out of `humanoid eval` is shown and kept, and whether it is enough."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple, TypeAlias

import msgspec
from rich.table import Table

from executive.evaluation import homes_report, marks, report
from executive.frontends.output import say, table_screen
from robot.errors import ConfigError, Problem
from robot.files.ordinary_files import write_ordinary

MAX_WIDTH = 1000
"""Of any table: how wide it would be is asked without a bound of the terminal."""

Found: TypeAlias = report.Report | marks.Marks | homes_report.HomesReport


class _View(NamedTuple):
    """One and the same, for a wide terminal, a narrow one, and a page."""

    table: Table
    narrow: str
    markdown: str


def _view(found: Found) -> _View:
    match found:
        case report.Report():
            return _View(report.table(found), report.narrow(found), report.markdown(found))
        case marks.Marks():
            return _View(marks.table(found), marks.narrow(found), marks.markdown(found))
        case homes_report.HomesReport():
            view = homes_report
            return _View(view.table(found), view.narrow(found), view.markdown(found))


def well(found: Found, share: float) -> bool:
    """Whether so large a part of the runs is right: of an exam in all, else of each case."""
    if isinstance(found, marks.Marks):
        return found.whole.share >= share
    return found.worst >= share and not found.without_code


def show(found: Found) -> None:
    """The report as a table, where the terminal is wide enough for one."""
    view, screen = _view(found), table_screen()
    unbound = screen.options.update(width=MAX_WIDTH)
    if screen.measure(view.table, options=unbound).maximum <= screen.width:
        screen.print(view.table)
    else:
        say(view.narrow)
    if isinstance(found, homes_report.HomesReport):
        for line in homes_report.notes(found):
            say(line)


def save(folder: Path, found: Found) -> None:
    """Keep the table beside the results, for machines and for people. Raises ConfigError."""
    data = msgspec.json.format(msgspec.json.encode(found, order="deterministic"))
    try:
        write_ordinary(folder / "report.json", data + b"\n")
        write_ordinary(folder / "report.md", _view(found).markdown.encode())
    except OSError as error:
        text = f"the report in {folder} cannot be written: {error.strerror}"
        raise ConfigError(
            [Problem(text, suggestion="the records are there: --resume it")]
        ) from None
