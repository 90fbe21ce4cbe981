"""The command line of `humanoid mission`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from executive.frontends.launching import FrontEnd, here, launch
from executive.frontends.missions.options import Check, File, Plan, Run
from executive.frontends.options import takes

Output = Annotated[
    Path | None, typer.Option("--output", "-o", help="The file to write (default: print it).")
]


app = typer.Typer(
    no_args_is_help=True, help="Missions: files that say what to do, and what should be so then."
)


def register(parent: typer.Typer) -> None:
    """Add the commands to the command line."""
    parent.add_typer(app, name="mission")


@app.command(no_args_is_help=True)
@takes(Check)
def check(options: Check) -> None:
    """Find everything that is wrong in missions, by line and column, before anything moves.

    [bold]Example[/bold]

      humanoid mission check missions/*.yaml
    """
    from executive.frontends.missions import commands

    said = commands.said(options, samples=True)
    raise typer.Exit(commands.check_all(options.files, said, as_json=options.as_json))


@app.command(no_args_is_help=True)
@takes(Plan)
def plan(options: Plan) -> None:
    """Show the steps with their paths, about how long they take, and what will not work.

    [bold]Example[/bold]

      humanoid mission plan bring --param thing="blue cup"
    """
    from executive.frontends.missions import commands

    said = commands.said(options)
    raise typer.Exit(commands.plan(options.file, said, as_json=options.as_json))


@app.command(no_args_is_help=True)
@takes(Run)
def run(options: Run) -> None:
    """Check a mission, run it, and compare the world with what it expects.

    Exit status: 0 done and as expected, 1 failed, 2 the file is wrong, 3 the system broke.

    [bold]Examples[/bold]

      humanoid mission run bring --fast

      humanoid mission run tidy.yaml --from 3 --param place=shelf --seed 7
    """
    if not options.fast:
        raise typer.Exit(launch(FrontEnd.MISSION, options, as_json=options.as_json))
    from executive.frontends.missions.run import in_executive

    raise typer.Exit(here(in_executive, options))


@app.command(name="list")
def list_() -> None:
    """List the shipped missions."""
    from executive.frontends.missions import commands

    raise typer.Exit(commands.list_shipped())


@app.command()
def schema(
    *,
    output: Output = None,
) -> None:
    """Print the JSON Schema of mission files, for editors."""
    from executive.frontends.missions import commands

    raise typer.Exit(commands.write_schema(output))


@app.command(no_args_is_help=True)
def new(
    name: Annotated[str, typer.Argument(help="Of the mission; the file is NAME.yaml.")],
) -> None:
    """Write a small mission with comments, to begin with."""
    from executive.frontends.missions import commands

    raise typer.Exit(commands.new(name))


@app.command(name="import", no_args_is_help=True)
def import_(
    file: Annotated[Path, typer.Argument(help="BehaviorTree.CPP XML, or Nav2 waypoints.")],
    *,
    output: Output = None,
) -> None:
    """Make a mission of another program's file; what has no equivalent is refused by name.

    No file is overwritten. Exit status 2: nothing was made, or what was made names what the kitchen
    has not: name its world in it.

    [bold]Example[/bold]

      humanoid mission import tree.xml -o tree.yaml
    """
    from executive.frontends.missions import commands

    raise typer.Exit(commands.import_file(file, output))


@app.command(no_args_is_help=True)
def export(
    file: File,
    *,
    xml: Annotated[  # noqa: ARG001, there is one format
        bool, typer.Option("--xml", help="BehaviorTree.CPP v4 XML (the one format there is).")
    ] = True,
    output: Output = None,
) -> None:
    """Write a mission as BehaviorTree.CPP v4 XML with a TreeNodesModel (Groot2 shows it)."""
    from executive.frontends.missions import commands

    raise typer.Exit(commands.export_file(file, output))
