"""`python -m benchmarks.speech`: one table of how well speech is heard (needs espeak-ng)."""

from __future__ import annotations

import shutil
import sys
from collections.abc import Iterable
from typing import Annotated

import numpy as np
import typer
from rich.console import Console
from rich.markdown import Markdown

from benchmarks import machine
from benchmarks.markdown import table
from benchmarks.speech.hearing import ASKED_FACTOR, Result, Row, factor, measured, share

_VERDICTS = {True: "yes", False: "NO", None: ""}


def main(
    *,
    each: Annotated[int, typer.Option("--share", help="take one in so many; 1 is all")] = 3,
    misses: Annotated[int, typer.Option(help="takes that went wrong, to show of each row")] = 0,
    only: Annotated[str, typer.Option(help="commands, others or stops")] = "",
) -> None:
    """Measure: goals right, other speech rejected, cries to stop heard, time taken."""
    if not shutil.which("espeak-ng"):
        sys.exit("espeak-ng is not installed: sudo apt install espeak-ng")
    console, rows = Console(width=120), list[Row]()
    for row in measured(each, only=only):
        rows.append(row)
        console.print(_cells(row), _by_voice(row.results))
        for one in [one for one in row.results if not one.good][:misses]:
            said = f"{one.take.voice} {one.take.speed_wpm} {one.take.line.text}"
            console.print(f"  {said}: {one.heard}", highlight=False, markup=False)
    head = ("what", "of", "all", "held out", "asked", "reached")
    cells = [_cells(row) for row in rows]
    took = factor(rows)
    verdict = _VERDICTS[took < ASKED_FACTOR]
    cells.append(["real-time factor", "", f"{took:.3f}", "", f"< {ASKED_FACTOR:g}", verdict])
    console.print(Markdown(table(head, cells)))
    console.print(f"{machine.describe()}; one in {each} of all takes")


def _cells(row: Row) -> list[str]:
    """A line as text: all, those held out, what was asked."""
    held_out = [one for one in row.results if one.take.held_out]
    asked = f">= {100 * row.asked:g} %" if row.asked else ""
    return [
        row.what, str(len(row.results)), _percent(row.results), _percent(held_out), asked,
        _VERDICTS[row.reached],
    ]  # fmt: skip


def _percent(results: list[Result]) -> str:
    return f"{100 * share(results):.1f} %" if results else ""


def _by_voice(results: Iterable[Result]) -> str:
    found: dict[str, list[bool]] = {}
    for one in results:
        found.setdefault(one.take.voice, []).append(one.good)
    return ", ".join(f"{voice} {100 * np.mean(good):.1f} %" for voice, good in found.items())


if __name__ == "__main__":
    typer.run(main)
