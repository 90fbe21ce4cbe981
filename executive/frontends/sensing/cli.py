"""The command line of what looks at recordings: `humanoid people`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def register(parent: typer.Typer) -> None:
    """Add the commands to the command line."""
    parent.command(no_args_is_help=True)(people)


def people(
    *,
    log: Annotated[
        Path, typer.Option("--log", help="Scans of a planar laser (.npz; docs/perception.md).")
    ],
    causal: Annotated[
        bool,
        typer.Option(
            "--causal", help="As a robot would have known it then: nothing that came later helps."
        ),
    ] = False,
    as_json: Annotated[
        bool, typer.Option("--json", help="A JSON line a scan, and nothing else.")
    ] = False,
) -> None:
    """Find the people, and their legs, in the scans of a planar laser.

    With --json a line a scan: t [s], people (id, x, y [m], vx, vy [m/s], score) and legs
    (id of the person, x, y, score), in the laser's frame: x ahead, y to the left.

    [bold]Examples[/bold]

      humanoid people --log corridor.npz

      humanoid people --log corridor.npz --json > people.jsonl
    """
    from executive.frontends.sensing.people import find

    raise typer.Exit(find(log, causal=causal, as_json=as_json))
