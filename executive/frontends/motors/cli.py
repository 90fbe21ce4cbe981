"""The command line of `humanoid motors`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from executive.frontends.options import AsJson, Robot

app = typer.Typer(
    no_args_is_help=True,
    help="Look at real CAN motors, or at emulated ones. No command here enables or moves anything.",
)


def register(parent: typer.Typer) -> None:
    """Add the commands to the command line."""
    parent.add_typer(app, name="motors")


Map = Annotated[
    Path | None,
    typer.Option("--map", "-m", help="The joint map (default: can.yaml beside the robot)."),
]
Emulated = Annotated[
    bool, typer.Option("--emulated", help="Start emulated motors, as the map has them.")
]
Fail = Annotated[
    list[str] | None,
    typer.Option(
        "--fail", metavar="JOINT=FLAW", help="What is wrong with an emulated motor (often)."
    ),
]
Span = typer.Option("--for", min=0.1, max=3600.0, metavar="SECONDS")


@app.command()
def scan(
    *,
    channel: Annotated[
        list[str] | None,
        typer.Option("--channel", "-c", help="A CAN interface, can0 (often); instead of a map."),
    ] = None,
    interface: Annotated[
        str, typer.Option("--interface", help="Of python-can, for --channel.")
    ] = "socketcan",
    up_to: Annotated[
        int, typer.Option("--up-to", min=1, max=0x7FE, help="The largest identifier asked for.")
    ] = 127,
    robot: Robot = "juno",
    map_file: Map = None,
    emulated: Emulated = False,
    fail: Fail = None,
    as_json: AsJson = False,
) -> None:
    """List the motors on CAN buses: who answers to which identifier, and as what.

    [bold]Examples[/bold]

      humanoid motors scan --channel can0 --channel can1

      humanoid motors scan --map my_arm/can.yaml

      humanoid motors scan --emulated --fail left_knee=twin

    Damiao's motors are found. Exit status 1 where nobody answers, or two answer as one.
    """
    from executive.frontends.motors import commands

    asked = commands.Asked(robot, map_file, emulated, tuple(fail or ()), as_json)
    if channel:
        status = commands.scan_channels(channel, interface, up_to=up_to, as_json=as_json)
    else:
        status = commands.scan(asked, up_to=up_to)
    raise typer.Exit(status)


@app.command()
def read(
    *,
    robot: Robot = "juno",
    map_file: Map = None,
    emulated: Emulated = False,
    fail: Fail = None,
    as_json: AsJson = False,
) -> None:
    """Say once what every motor of a joint map measures, at its joint.

    [bold]Examples[/bold]

      humanoid motors read --map my_arm/can.yaml

      humanoid motors read --emulated --json
    """
    from executive.frontends.motors import commands

    asked = commands.Asked(robot, map_file, emulated, tuple(fail or ()), as_json)
    raise typer.Exit(commands.read(asked))


@app.command()
def check(
    *,
    for_s: Annotated[float, Span] = 2.0,
    robot: Robot = "juno",
    map_file: Map = None,
    emulated: Emulated = False,
    fail: Fail = None,
    as_json: AsJson = False,
) -> None:
    """Compare every motor with the joint map, and say what disagrees, with its cure.

    Identifiers, twins, ranges, mode, faults, sign and offset; how full each bus gets; then, for a
    while, whether replies are in time and reported speeds are those of the positions: turn the
    joints by hand meanwhile. Real motors are asked, not enabled.

    [bold]Examples[/bold]

      humanoid motors check --map my_arm/can.yaml --for 10

      humanoid motors check --emulated --fail left_knee=wrong_range

    Exit status 1 where something disagrees that keeps motors from being enabled.
    """
    from executive.frontends.motors import commands

    asked = commands.Asked(robot, map_file, emulated, tuple(fail or ()), as_json)
    raise typer.Exit(commands.check(asked, for_s=for_s))


@app.command()
def watch(
    *,
    for_s: Annotated[float, Span] = 3600.0,
    every_s: Annotated[
        float, typer.Option("--every", min=0.02, max=60.0, help="Seconds between two tables.")
    ] = 0.2,
    robot: Robot = "juno",
    map_file: Map = None,
    emulated: Emulated = False,
    fail: Fail = None,
    as_json: AsJson = False,
) -> None:
    """Show what every joint measures as a live table, and what is wrong below it.

    [bold]Examples[/bold]

      humanoid motors watch --map my_arm/can.yaml

      humanoid motors watch --emulated --for 5 --every 1 --json

    Ctrl-C ends it. With --json, or where no terminal is, a record or a table after the other.
    """
    from executive.frontends.motors import commands

    asked = commands.Asked(robot, map_file, emulated, tuple(fail or ()), as_json)
    raise typer.Exit(commands.watch(asked, for_s=for_s, every_s=every_s))
