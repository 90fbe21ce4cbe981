"""The command line of `humanoid dump`, and the options by which other commands dump as they run."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

RunName = Annotated[
    str | None,
    typer.Argument(help="A run's folder or a part of its name (default: the newest)."),
]
FormatName = Annotated[
    str,
    typer.Option(
        "--format",
        "-f",
        help="html, svg, png, dot, json or text; for other programs: mcap, csv, parquet.",
    ),
]
Dump = Annotated[
    Path | None, typer.Option("--dump", help="Also write pictures of the tree into this folder.")
]
DumpOn = Annotated[
    str, typer.Option("--dump-on", help="When: tick, change, failure, or (only) at the end.")
]
DumpFormat = Annotated[
    str, typer.Option("--dump-format", help="html, svg, png, dot, json, text, with commas.")
]


def register(app: typer.Typer) -> None:
    """Add the command to the command line."""
    app.command()(dump)
    app.command()(record)


def dump(
    run: RunName = None,
    *,
    kind: FormatName = "html",
    at: Annotated[
        float | None,
        typer.Option("--at", help="Show the tree at this time, in seconds, not at the end."),
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="The file to write, - for standard output."),
    ] = None,
    ascii_: Annotated[
        bool | None, typer.Option("--ascii/--unicode", help="Letters of text that may be used.")
    ] = None,
    everything: Annotated[
        bool, typer.Option("--all", help="Also nodes that only hold the tree together.")
    ] = False,
    open_: Annotated[
        bool, typer.Option("--open", help="Open the file when it is written.")
    ] = False,
) -> None:
    """Show a run: as a page to look around in, a picture, text, or data.

    A run that is under way can be dumped as well, as far as it has come.

    [bold]Examples[/bold]

      humanoid dump --open                      (the newest run, in the browser)

      humanoid dump red-cup --format text --at 20

      humanoid dump runs/20261121-120634-look-at-the-red-cup -f svg -o look.svg

      humanoid dump -f mcap -o run.mcap         (to be opened in Foxglove)
    """
    from executive.frontends.dump import command

    wish = command.Asked(
        run=run, kind=kind, t_s=at, output=output, ascii_only=ascii_, everything=everything,
        opened=open_,
    )  # fmt: skip
    raise typer.Exit(command.dump(wish))


def record(
    run: RunName = None,
    *,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="The file to write (default: in the run's folder)."),
    ] = None,
) -> None:
    """Write a run to an MCAP file while it goes on, for Foxglove.

    From any other terminal; it reads the run's files, so it cannot hold the robot up. It ends with
    the run, or with Ctrl-C. The same begins with the run by --record.

    [bold]Examples[/bold]

      humanoid record                           (the newest run)

      humanoid record red-cup -o red-cup.mcap

      humanoid do "wave" --record
    """
    from executive.frontends.dump import record as recording

    raise typer.Exit(recording.record(run, output))
