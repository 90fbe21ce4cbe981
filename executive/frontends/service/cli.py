"""The command lines of `humanoid up`, and of all that reaches a robot that is up."""

from __future__ import annotations

from typing import Annotated, Literal

import typer

from executive.frontends.options import takes
from executive.frontends.service.options import Name, Up

AsJson = Annotated[bool, typer.Option("--json", help="JSON, and nothing else.")]


def register(app: typer.Typer) -> None:
    """Add the commands to the command line."""
    app.command()(takes(Up)(up))
    for command in (status, say, stop, estop, pause, queue, attach, logs, down):
        app.command(no_args_is_help=command is say)(command)


def up(options: Up) -> None:
    """Keep a robot up, which is reached from any terminal of the same user.

    [bold]Examples[/bold]

      humanoid up --detach --world kitchen

      humanoid say --wait "pick up the red cup"

      humanoid stop                  (what you would type first, in any terminal)

      humanoid up --name second --world bench

      humanoid up --ros2             (ROS 2 machines see and command it: docs/ros2.md)

    It is the prompt without a terminal: what is said is one conversation, sentences queue up.
    Ctrl-C, SIGTERM and `humanoid down` bring the robot to a stand and end it.
    """
    from executive.frontends.service import detached, main

    raise typer.Exit(detached.up(options) if options.detach else main.up(options))


def status(name: Name = None, *, as_json: AsJson = False) -> None:
    """Say how a robot that is up is, and what it does.

    [bold]Examples[/bold]

      humanoid status

      humanoid status --json | jq .state
    """
    from executive.frontends.service import commands

    raise typer.Exit(commands.status(name, as_json=as_json))


def say(
    text: Annotated[list[str], typer.Argument(help="A sentence, or a command of the prompt.")],
    *,
    wait: Annotated[
        bool, typer.Option("--wait", help="Until all that comes of it is over.")
    ] = False,
    name: Name = None,
    as_json: AsJson = False,
) -> None:
    """Say something to a robot that is up, as at its prompt.

    [bold]Examples[/bold]

      humanoid say --wait "pick up the red cup and put it on the shelf"

      humanoid say "Which one did you mean?"

      humanoid say now "go to the table"

    Exit status: 0 taken (with --wait: done), 1 failed or stopped, 2 not understood or asked back,
    3 the system broke. A question is answered with the next thing that is said.
    """
    from executive.frontends.service import commands

    raise typer.Exit(commands.say_line(name, " ".join(text), wait=wait, as_json=as_json))


def stop(name: Name = None) -> None:
    """Bring every robot that is up to a stand, and end what it does, as `stop` at the prompt.

    [bold]Examples[/bold]

      humanoid stop

      humanoid stop --name kitchen   (only this one)

    Exit status: 0 each has heard it, 2 none is up, 3 one does not answer.
    """
    from executive.frontends.service import commands

    raise typer.Exit(commands.brake(name, "stop"))


def estop(
    what: Annotated[
        Literal["press", "release", "reset"],
        typer.Argument(help="Press it; let go of it; let the robot move again."),
    ] = "press",
    *,
    name: Name = None,
) -> None:
    """Press the emergency stop of every robot that is up: nothing moves until it is reset.

    [bold]Examples[/bold]

      humanoid estop

      humanoid estop release && humanoid estop reset
    """
    from executive.frontends.service import commands

    if what == "press":
        raise typer.Exit(commands.brake(name, "estop"))
    raise typer.Exit(commands.button(name, what))


def pause(name: Name = None) -> None:
    """Bring a robot to a stand and hold its task there; `humanoid resume` goes on."""
    from executive.frontends.service import commands

    raise typer.Exit(commands.button(name, "pause"))


def queue(name: Name = None, *, as_json: AsJson = False) -> None:
    """List what a robot that is up is to do, in order."""
    from executive.frontends.service import commands

    raise typer.Exit(commands.queue(name, as_json=as_json))


def attach(name: Name = None) -> None:
    r"""Talk to a robot that is up at a prompt: see it at work, answer its questions.

    Ctrl-C stops the robot, Ctrl-D and `quit` leave it as it is.

    [bold]Examples[/bold]

      humanoid attach

      printf 'go to the table\nstatus\n' | humanoid attach
    """
    from executive.frontends.service import place
    from executive.frontends.service.attach import attach as talk

    raise typer.Exit(talk(place.find(name)))


def logs(
    name: Name = None,
    *,
    count: Annotated[
        int, typer.Option("--last", "-n", min=1, max=1_000_000, help="How many lines.")
    ] = 50,
    follow: Annotated[bool, typer.Option("--follow", "-f", help="Go on with what comes.")] = False,
) -> None:
    """Print what was said to a robot that is up and by it, and what it did."""
    from executive.frontends.service import commands

    raise typer.Exit(commands.logs(name, count=count, follow=follow))


def down(name: Name = None) -> None:
    """Bring a robot that is up to a stand, and end it."""
    from executive.frontends.service import commands

    raise typer.Exit(commands.down(name))
