"""What `humanoid people` does."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from rich.table import Table

from executive.frontends.output import say, table_screen, write_json
from executive.frontends.recordings.progress import counted
from robot.errors import ConfigError, Problem
from robot.exit_status import ExitStatus
from robot.perception.people.finder import Found, PeopleFinder, people_of_log
from robot.perception.people.scan_log import read_scans

DIGITS = 4
"""Behind the point: a tenth of a millimetre."""


def find(log: Path, *, causal: bool, as_json: bool) -> int:
    """Find the people of a log; print a line a scan, or who they were.

    Raises:
        ConfigError: the log cannot be used.
    """
    scans = read_scans(log)
    if not scans:
        cure = "docs/perception.md tells how a log of scans looks"
        raise ConfigError([Problem("there is no scan in it", str(log), suggestion=cure)])
    if causal:
        finder = PeopleFinder()
        with counted("Looking", len(scans)) as progress:
            found = [finder.step(scan) for done, scan in enumerate(scans) if not progress(done)]
    else:
        with counted("Looking", 2 * len(scans)) as progress:
            found = people_of_log(scans, progress)
    if as_json:
        for one in found:
            write_json(_line(one))
    else:
        _tell(found)
    return ExitStatus.DONE


def _line(found: Found) -> dict[str, object]:
    return {
        "t": found.t,
        "people": [
            {"id": one.id, **_rounded(x=one.x, y=one.y, vx=one.vx, vy=one.vy, score=one.score)}
            for one in found.people
        ],
        "legs": [
            {"id": one.id, **_rounded(x=one.x, y=one.y, score=one.score)} for one in found.legs
        ],
    }


def _rounded(**numbers: float) -> dict[str, float]:
    return {name: round(number, DIGITS) for name, number in numbers.items()}


def _tell(found: list[Found]) -> None:
    """A table of the people: when, how far, how sure."""
    begin_s = found[0].t
    say(f"{len(found)} scans over {found[-1].t - begin_s:.1f} s")
    numbers = sorted({person.id for one in found for person in one.people})
    if not numbers:
        say("Nobody was seen who walked.")
        return
    table = Table(box=None, pad_edge=False)
    for head in ("person", "from [s]", "to [s]", "scans", "way [m]", "from x, y [m]", "score"):
        table.add_column(head, justify="right")
    for number in numbers:
        seen = [(one.t, p) for one in found for p in one.people if p.id == number]
        places_m = np.array([(person.x, person.y) for _, person in seen])
        way_m = float(np.linalg.norm(np.diff(places_m, axis=0), axis=1).sum())
        table.add_row(
            str(number),
            f"{seen[0][0] - begin_s:.1f}",
            f"{seen[-1][0] - begin_s:.1f}",
            str(len(seen)),
            f"{way_m:.1f}",
            f"{places_m[0, 0]:.2f}, {places_m[0, 1]:.2f}",
            f"{np.mean([person.score for _, person in seen]):.2f}",
        )
    table_screen().print(table)
