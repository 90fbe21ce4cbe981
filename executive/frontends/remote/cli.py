"""The command lines of `humanoid remote`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from executive.frontends.remote.invitation import Role
from executive.frontends.service.options import Name

app = typer.Typer(
    no_args_is_help=True,
    help="Reach a robot that is up from another machine: by invitation, encrypted, by role.",
)
Guest = Annotated[str, typer.Argument(metavar="NAME", help="Whom it is for.")]


def register(parent: typer.Typer) -> None:
    """Add the commands to the command line."""
    parent.add_typer(app, name="remote")


@app.command(no_args_is_help=True)
def invite(
    name: Guest,
    *,
    role: Annotated[
        Role, typer.Option("--role", help="What they may do; everybody may stop the robot.")
    ] = "watch",
    at: Annotated[
        str, typer.Option("--at", help="Where this machine is reached from theirs: HOST[:PORT].")
    ],
    out: Annotated[
        Path | None, typer.Option("--out", help="The file; else NAME.invitation.")
    ] = None,
    days: Annotated[int, typer.Option("--days", min=1, max=3650, help="How long it is good.")] = 30,
) -> None:
    """Make an invitation: a file by which somebody on another machine reaches robots of this one.

    [bold]Examples[/bold]

      humanoid remote invite anna --role command --at robot.local

      humanoid remote invite hall-screen --role watch --at 192.168.1.7:7450 --days 365
    """
    from executive.frontends.remote import commands

    raise typer.Exit(commands.invite(name, role, at=at, out=out, days=days))


@app.command("list")
def list_guests(
    *, as_json: Annotated[bool, typer.Option("--json", help="JSON, and nothing else.")] = False
) -> None:
    """List who was invited, as what, and until when."""
    from executive.frontends.remote import commands

    raise typer.Exit(commands.list_guests(as_json=as_json))


@app.command(no_args_is_help=True)
def revoke(name: Guest) -> None:
    """Take an invitation back; who is in by it is let go."""
    from executive.frontends.remote import commands

    raise typer.Exit(commands.revoke(name))


@app.command("open")
def open_gate(
    name: Name = None,
    *,
    listen: Annotated[
        str, typer.Option("--listen", help="Where to listen: HOST[:PORT]; 0.0.0.0 is everywhere.")
    ] = "127.0.0.1",
) -> None:
    """Let those in who are invited, to a robot that is up here, until Ctrl-C.

    [bold]Examples[/bold]

      humanoid up --detach && humanoid remote open --listen 0.0.0.0

    Who commands and loses the link stops the robot: it stands within half a second.
    """
    from executive.frontends.remote import commands

    raise typer.Exit(commands.open_gate(name, listen=listen))


@app.command(no_args_is_help=True)
def join(
    invitation: Annotated[Path, typer.Argument(help="The file of `humanoid remote invite`.")],
    *,
    name: Annotated[
        str | None, typer.Option("--name", help="What the robot is called here.")
    ] = None,
) -> None:
    """Have a robot of another machine here, as if it were up on this one, until Ctrl-C.

    [bold]Examples[/bold]

      humanoid remote join anna.invitation --name kitchen

      humanoid say --name kitchen "go to the table"        (in another terminal)

      humanoid stop
    """
    from executive.frontends.remote import commands

    raise typer.Exit(commands.join(invitation, name))
