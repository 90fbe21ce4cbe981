"""The command line of `humanoid worlds`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from executive.frontends.options import AsJson, Seed

app = typer.Typer(
    invoke_without_command=True,
    help="List the worlds that come along with what is in them, the things that a world may have, "
    "or make homes from a seed.",
)


def register(parent: typer.Typer) -> None:
    """Add the commands to the command line."""
    parent.add_typer(app, name="worlds")


@app.callback()
def worlds(context: typer.Context, *, as_json: AsJson = False) -> None:
    """What is done without a command."""
    if context.invoked_subcommand is None:
        from executive.frontends.worlds import commands

        raise typer.Exit(commands.list_all(as_json=as_json))


@app.command()
def things(
    *,
    picture: Annotated[
        Path | None,
        typer.Option("--picture", "-p", help="Draw all of them into this file (PNG or JPEG)."),
    ] = None,
    variant: Annotated[
        int, typer.Option("--variant", min=0, max=999_999, help="Which one of each to draw.")
    ] = 0,
    as_json: AsJson = False,
) -> None:
    """List the things with real forms that a world may have: sizes, weights, colours.

    [bold]Examples[/bold]

      humanoid worlds things

      humanoid worlds things --picture things.png

      humanoid worlds things --picture others.png --variant 3
    """
    from executive.frontends.worlds import commands

    raise typer.Exit(commands.things(picture=picture, variant=variant, as_json=as_json))


@app.command(no_args_is_help=True)
def new(
    *,
    kind: Annotated[
        str, typer.Option("--kind", "-k", help="flat, office, ...: humanoid worlds lists them.")
    ],
    seed: Seed = 0,
    rooms: Annotated[
        int | None,
        typer.Option("--rooms", min=2, max=16, help="How many rooms (default: as usual)."),
    ] = None,
    things: Annotated[
        int | None,
        typer.Option("--things", min=9, max=400, help="How many things (default: as usual)."),
    ] = None,
    lived_in: Annotated[
        bool,
        typer.Option(
            "--lived-in",
            help="Chairs drawn up, deep tables, odd boards, things on their side and flat ones, "
            "somebody in a doorway.",
        ),
    ] = False,
    real_things: Annotated[
        bool,
        typer.Option(
            "--real-things",
            help="Cups with handles, bottles with necks, fruit: humanoid worlds things lists them.",
        ),
    ] = False,
    output: Annotated[
        Path | None,
        typer.Option(
            "--out", "--output", "-o", help="The world file to write (default: print it)."
        ),
    ] = None,
    tasks: Annotated[
        Path | None,
        typer.Option("--tasks", "-t", help="Write ten tasks for it into this file (needs --out)."),
    ] = None,
) -> None:
    """Make a home: rooms, doors, furniture, things, people, and what to ask for there.

    The same kind and seed are always the same home. No file is overwritten.

    [bold]Examples[/bold]

      humanoid worlds new --kind flat --seed 7 --out flat7.yaml

      humanoid worlds new -k office -s 3 -o office3.yaml --tasks office3.tasks.yaml

      humanoid worlds new --kind clinic            (print it)

      humanoid worlds new --kind clinic --rooms 12 --things 300 --out large.yaml

      humanoid worlds new --kind flat --seed 7 --lived-in --out mine.yaml --tasks mine.tasks.yaml

      humanoid worlds new --kind flat --seed 7 --real-things --out flat7.yaml
    """
    from executive.frontends.worlds import commands

    raise typer.Exit(
        commands.new(
            kind,
            seed=seed,
            output=output,
            tasks=tasks,
            rooms=rooms,
            things=things,
            lived_in=lived_in,
            real_things=real_things,
        )
    )
