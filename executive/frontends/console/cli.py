"""The command line of `humanoid console`."""

from __future__ import annotations

from typing import Annotated

import typer

Port = Annotated[
    int,
    typer.Option("--port", min=0, max=65535, help="Of the page's address (0: any that is free)."),
]


def register(app: typer.Typer) -> None:
    """Add the command to the command line."""
    app.command()(console)


def console(
    run: Annotated[
        str | None,
        typer.Argument(help="A run's folder or a part of its name (default: the robot at work)."),
    ] = None,
    *,
    port: Port = 0,
    open_: Annotated[bool, typer.Option("--open", help="Open the page in the browser.")] = False,
) -> None:
    """Watch a robot on a page: in 3-D, with its task tree, what it says, and its health.

    Beside a robot at work, or on a run that is over, which can be looked through. The page is for
    this machine alone, and needs no network.

    [bold]Examples[/bold]

      humanoid console              (beside `humanoid` or `humanoid do` in another terminal)

      humanoid console --open --port 8000

      humanoid console red-cup      (the newest run of that name, to look through)

    Ctrl-C ends it; the robot goes on.
    """
    from executive.frontends.console.command import console

    raise typer.Exit(console(run, port=port, opened=open_))
