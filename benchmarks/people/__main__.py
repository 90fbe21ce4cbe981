"""`python -m benchmarks.people FOLDER`: how well people are found in labelled recordings."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.markdown import Markdown

from benchmarks import machine
from benchmarks.markdown import table
from benchmarks.people.scoring import read_labels, score
from robot.perception.people.finder import PeopleFinder, people_of_log
from robot.perception.people.scan_log import read_scans

HEAD = ("recording", "scans", "labels", "known then", "recall", "precision", "outside", "ms")


def main(
    folder: Annotated[Path, typer.Argument(help="of recordings (.npz) with legs_xy")],
) -> None:
    """Score every labelled recording, as a whole and as a robot would have known it then."""
    rows: list[list[str]] = []
    for path in sorted(folder.glob("*.npz")):
        try:
            labels = read_labels(path)
        except KeyError:
            continue
        scans = read_scans(path)
        for causal in (False, True):
            begun_s = time.perf_counter()
            if causal:
                finder = PeopleFinder()
                found = [finder.step(scan) for scan in scans]
            else:
                found = people_of_log(scans)
            took_ms = 1000.0 * (time.perf_counter() - begun_s) / len(scans)
            got = score(found, labels)
            rows.append(
                [
                    path.stem, str(got.scans), str(got.labels), "yes" if causal else "",
                    f"{got.recall:.3f}", f"{got.precision:.3f}", f"{got.outside / got.scans:.2f}",
                    f"{took_ms:.1f}",
                ]
            )  # fmt: skip
    console = Console(width=120)
    console.print(Markdown(table(HEAD, rows)))
    console.print(
        "known then: only what came before helps; outside: legs a scan beyond the labelled "
        f"sector, unlabelled people among them\n{machine.describe()}"
    )


if __name__ == "__main__":
    typer.run(main)
