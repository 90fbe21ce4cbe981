"""The command line of `humanoid map`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from executive.frontends.options import AsJson

app = typer.Typer(no_args_is_help=True, help="Make maps from recordings of a lidar, and use them.")

Log = Annotated[
    Path, typer.Option("--log", "-l", help="The recording: an npz, see docs/localisation.md.")
]


def register(parent: typer.Typer) -> None:
    """Add the commands to the command line."""
    parent.add_typer(app, name="map")


@app.command(no_args_is_help=True)
def build(
    *,
    log: Log,
    trajectory: Annotated[
        Path, typer.Option("--trajectory", "-t", help="The text file to write: t x y theta a row.")
    ],
    out: Annotated[
        Path | None, typer.Option("--out", "-o", help="The map to write (.npz).")
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Find where a lidar was at each sweep of a recording, and draw the building.

    Planar SLAM: sweeps are matched, places seen again are recognised, and all of it is brought
    together. A file of the same name is replaced.

    [bold]Examples[/bold]

      humanoid map build --log hall.npz --trajectory hall.txt

      humanoid map build --log hall.npz --trajectory hall.txt --out hall.map.npz
    """
    from executive.frontends.recordings import maps

    raise typer.Exit(maps.build(log, trajectory, out=out, as_json=as_json))


@app.command(no_args_is_help=True)
def show(
    map_file: Annotated[Path, typer.Argument(metavar="MAP", help="A map of `map build`.")],
    *,
    snapshot: Annotated[
        Path | None, typer.Option("--snapshot", help="Draw it into this file (.png).")
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Say what is in a map, and draw it.

    [bold]Examples[/bold]

      humanoid map show hall.map.npz

      humanoid map show hall.map.npz --snapshot hall.png
    """
    from executive.frontends.recordings import maps

    raise typer.Exit(maps.show(map_file, snapshot=snapshot, as_json=as_json))


@app.command(no_args_is_help=True)
def locate(
    map_file: Annotated[Path, typer.Argument(metavar="MAP", help="A map of `map build`.")],
    *,
    log: Log,
    trajectory: Annotated[
        Path | None,
        typer.Option("--trajectory", "-t", help="The text file to write; nan where it is lost."),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Find where in a map a lidar was, without a word about where it began.

    A place counts when several sweeps along a way agree on it and no other looks like it; until
    then the robot is lost, and says so. Exit status 1 if it is lost at the end.

    [bold]Examples[/bold]

      humanoid map locate hall.map.npz --log visit.npz

      humanoid map locate hall.map.npz --log visit.npz --trajectory visit.txt
    """
    from executive.frontends.recordings import maps

    raise typer.Exit(maps.locate(map_file, log=log, trajectory=trajectory, as_json=as_json))
