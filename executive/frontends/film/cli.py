"""The command line of `humanoid film`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

LAST_S = 1e9
"""Beyond, a time is none (`executive.journal.journal.MOST_S`)."""


def register(app: typer.Typer) -> None:
    """Add the command to the command line."""
    app.command()(film)


def film(
    run: Annotated[
        str | None,
        typer.Argument(help="A run's folder or a part of its name (default: the newest)."),
    ] = None,
    *,
    output: Annotated[
        Path | None,
        typer.Option(
            "--output", "-o", help="A .gif, .webm or .mp4 (default: in the run's folder)."
        ),
    ] = None,
    gif: Annotated[
        bool,
        typer.Option("--gif", help="As a .gif, for READMEs."),
    ] = False,
    speed: Annotated[
        float, typer.Option("--speed", min=0.1, max=100.0, help="So many times as fast as it was.")
    ] = 2.0,
    begin: Annotated[
        float | None,
        typer.Option(
            "--from", min=0.0, max=LAST_S, help="Begin at this time of the run, in seconds."
        ),
    ] = None,
    end: Annotated[
        float | None, typer.Option("--to", min=0.0, max=LAST_S, help="End at this time.")
    ] = None,
    width: Annotated[
        int | None,
        typer.Option(
            "--width",
            min=160,
            max=1920,
            help="Of the film, in pixels (default: 800; 480 where there is no EGL).",
        ),
    ] = None,
) -> None:
    """Make a film of a run: the robot at work, the task tree beside it, what it says below.

    A .gif can always be made; .webm and .mp4 take the extra `film` (PyAV), and are a tenth of its
    size. Pictures are rendered through EGL where it is installed, else by rays: slower, no shadows.

    [bold]Examples[/bold]

      humanoid film                         (the newest run)

      humanoid film red-cup -o cup.webm

      humanoid film red-cup --gif --speed 6

      humanoid film red-cup -o cup.gif --speed 6 --width 480 --from 10 --to 40
    """
    from executive.frontends.film import command

    asked = command.Asked(
        run=run, output=output, gif=gif, speed=speed, begin_s=begin, end_s=end, width=width
    )
    raise typer.Exit(command.film(asked))
