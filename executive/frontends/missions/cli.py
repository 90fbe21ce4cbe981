"""The command line of `humanoid mission`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from executive.frontends.dump import cli as dumps
from executive.frontends.options import AsJson, Seed

File = Annotated[str, typer.Argument(help="A mission file, or the name of a shipped mission.")]
Params = Annotated[
    list[str] | None, typer.Option("--param", "-p", help="A parameter's value: NAME=VALUE.")
]
From = Annotated[str, typer.Option("--from", help="Begin at this step (see mission plan).")]
World = Annotated[str, typer.Option("--world", "-w", help="In place of the mission's world.")]
Robot = Annotated[str, typer.Option("--robot", "-r", help="In place of the mission's robot.")]

app = typer.Typer(
    no_args_is_help=True, help="Missions: files that say what to do, and what should be so then."
)


def register(parent: typer.Typer) -> None:
    """Add the commands to the command line."""
    parent.add_typer(app, name="mission")


@app.command(no_args_is_help=True)
def check(
    files: Annotated[list[str], typer.Argument(help="Mission files, or names of shipped ones.")],
    *,
    params: Params = None,
    first: From = "",
    world: World = "",
    robot: Robot = "",
    as_json: AsJson = False,
) -> None:
    """Find everything that is wrong in missions, by line and column, before anything moves.

    [bold]Example[/bold]

      humanoid mission check missions/*.yaml
    """
    from executive.frontends.missions import commands

    said = commands.said(params, first=first, world=world, robot=robot, samples=True)
    raise typer.Exit(commands.check_all(files, said, as_json=as_json))


@app.command(no_args_is_help=True)
def plan(
    file: File,
    *,
    params: Params = None,
    first: From = "",
    world: World = "",
    robot: Robot = "",
    as_json: AsJson = False,
) -> None:
    """Show the steps with their paths, about how long they take, and what will not work.

    [bold]Example[/bold]

      humanoid mission plan bring --param thing="blue cup"
    """
    from executive.frontends.missions import commands

    said = commands.said(params, first=first, world=world, robot=robot)
    raise typer.Exit(commands.plan(file, said, as_json=as_json))


@app.command(no_args_is_help=True)
def run(
    file: File,
    *,
    params: Params = None,
    first: From = "",
    world: World = "",
    robot: Robot = "",
    seed: Seed = 0,
    fast: Annotated[
        bool,
        typer.Option("--fast", help="As fast as the machine goes, and the same every time."),
    ] = False,
    vary: Annotated[
        bool, typer.Option("--vary", help="Shuffle the start and the objects by the seed.")
    ] = False,
    run_dir: Annotated[
        Path | None,
        typer.Option("--run-dir", help="Where the journal goes (default: runs/STAMP-NAME)."),
    ] = None,
    as_json: AsJson = False,
    dump: dumps.Dump = None,
    dump_on: dumps.DumpOn = "end",
    dump_format: dumps.DumpFormat = "html",
) -> None:
    """Check a mission, run it, and compare the world with what it expects.

    Exit status: 0 done and as expected, 1 failed, 2 the file is wrong, 3 the system broke.

    [bold]Examples[/bold]

      humanoid mission run bring --fast

      humanoid mission run tidy.yaml --from 3 --param place=shelf --seed 7
    """
    from executive.frontends.missions import commands

    said = commands.said(
        params, first=first, world=world, robot=robot, vary_seed=seed if vary else None
    )
    how = commands.how(
        seed=seed,
        fast=fast,
        vary=vary,
        folder=run_dir,
        as_json=as_json,
        dump=dump,
        dump_on=dump_on,
        dump_format=dump_format,
    )
    raise typer.Exit(commands.run(file, said, how))


@app.command(name="list")
def list_() -> None:
    """List the shipped missions."""
    from executive.frontends.missions import commands

    raise typer.Exit(commands.list_shipped())


@app.command()
def schema(
    *,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="The file to write (default: print it).")
    ] = None,
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
    file: Annotated[Path, typer.Argument(help="BehaviorTree.CPP v4 XML, or Nav2 waypoints.")],
    *,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="The file to write (default: print it).")
    ] = None,
) -> None:
    """Make a mission of another program's file; what has no equivalent is refused by name.

    [bold]Example[/bold]

      humanoid mission import tree.xml -o tree.yaml
    """
    from executive.frontends.missions import commands

    raise typer.Exit(commands.import_file(file, output))


@app.command(no_args_is_help=True)
def export(
    file: File,
    *,
    xml: Annotated[bool, typer.Option("--xml", help="BehaviorTree.CPP v4 XML.")] = True,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="The file to write (default: print it).")
    ] = None,
) -> None:
    """Write a mission as BehaviorTree.CPP v4 XML with a TreeNodesModel (Groot2 shows it)."""
    from executive.frontends.missions import commands

    raise typer.Exit(commands.export_file(file, output, xml=xml))
