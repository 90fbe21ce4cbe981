"""The command line: `humanoid`. What a command does is in the module that is called like it."""

from __future__ import annotations

import importlib.metadata
import os
import re
import sys
from itertools import pairwise
from pathlib import Path
from typing import Annotated

import typer

from executive.frontends import streams
from executive.frontends.console import cli as consoles
from executive.frontends.dump import cli as dumps
from executive.frontends.exit import before_it_moves, ended_by
from executive.frontends.film import cli as films
from executive.frontends.launching import FrontEnd, here, launch
from executive.frontends.listening.cli import listen
from executive.frontends.missions import cli as missions
from executive.frontends.motors import cli as motors
from executive.frontends.new_files import refuse_inputs
from executive.frontends.options import (
    AsJson,
    Do,
    Eval,
    Model,
    Prompt,
    Robot,
    Seed,
    Walk,
    World,
    WorldIfAny,
    takes,
)
from executive.frontends.output import say, tell_of_mistakes
from executive.frontends.panels import PANEL_OF, Ordered, put_into_panels
from executive.frontends.past_runs import cli as history
from executive.frontends.recordings import cli as recordings
from executive.frontends.recordings import maps_cli, sensors_cli
from executive.frontends.remote import cli as remotes
from executive.frontends.service import cli as services
from executive.frontends.service import quick
from executive.frontends.settings import cli as configs
from executive.frontends.settings.applied import Defaults
from executive.frontends.settings.files import Settings
from executive.frontends.worlds import cli as worlds
from robot import exit_status
from robot.errors import ConfigError, Problem
from robot.exit_status import ExitStatus
from robot.files.ordinary_files import write_ordinary
from robot.printable import is_printable, printable

app = typer.Typer(
    name="humanoid",
    cls=Ordered,
    invoke_without_command=True,
    add_completion=True,
    rich_markup_mode="rich",
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    epilog='Begin with:  humanoid do "pick up the red cup and put it on the shelf" --fast',
)

settings = Settings()
defaults = Defaults(settings)

model_app = typer.Typer(no_args_is_help=True, help="The robot's model, for other tools.")
app.add_typer(model_app, name="model")


def _version(wanted: bool) -> None:
    if wanted:
        say(f"humanoid-executive {importlib.metadata.version('humanoid-executive')}")
        raise typer.Exit


@app.callback(
    help=f"""Type a sentence, and a humanoid does it in physics. Without a command: the prompt.

    {exit_status.in_short()}"""
)
def humanoid(
    context: typer.Context,
    *,
    version: Annotated[  # noqa: ARG001, its callback acts
        bool,
        typer.Option("--version", callback=_version, is_eager=True, help="Show the version."),
    ] = False,
) -> None:
    """What is common to all commands."""
    if context.invoked_subcommand is None:
        repl(**defaults.of("repl"))


@app.command(no_args_is_help=True)
@takes(Do)
def do(options: Do) -> None:
    """Do what a sentence says.

    [bold]Examples[/bold]

      humanoid do "pick up the red cup and put it on the shelf" --fast

      humanoid do "go to the counter, then squat for five seconds"

      humanoid do "bring the bottle to the table" --world my_house.yaml --seed 7

    Ctrl-C finishes the step, stands, and leaves; a second one lets the motors damp at once.
    One that comes before the robot is started ends it at once, with status 1 as well.
    """
    if not options.fast:
        raise typer.Exit(launch(FrontEnd.DO, options, as_json=options.as_json))
    with before_it_moves():
        from executive.frontends.do import in_executive

    raise typer.Exit(here(in_executive, options))


@app.command()
@takes(Prompt)
def repl(options: Prompt) -> None:
    r"""Talk to a robot at a prompt: sentences, commands, and what happens, in one place.

    [bold]Examples[/bold]

      humanoid

      humanoid repl --world my_house.yaml --seed 7

      printf 'go to the table\nwhy\n' | humanoid repl --fast

    `help` at the prompt shows the commands. Ctrl-C stops the robot, Ctrl-D leaves.
    """
    if not options.fast:
        raise typer.Exit(launch(FrontEnd.PROMPT, options))
    from executive.frontends.prompt.cli import in_executive

    raise typer.Exit(here(in_executive, options))


@app.command()
@takes(Walk)
def walk(options: Walk) -> None:
    """Walk at a steady pace, to look at the body alone.

    [bold]Examples[/bold]

      humanoid walk --speed 0.4 --for 60 --fast

      humanoid walk --speed 0 --turn 0.6 --for 20
    """
    from executive.frontends.walk import walk

    raise typer.Exit(walk(options))


@app.command()
def parse(
    context: typer.Context,
    sentence: Annotated[list[str] | None, typer.Argument(help="What was said.")] = None,
    *,
    world: WorldIfAny = None,
    vocabulary: Annotated[
        Path | None, typer.Option("--vocabulary", help="Names from a JSON file, not a world.")
    ] = None,
    file: Annotated[
        Path | None, typer.Option("--file", help="Sentences, one a line; - is standard input.")
    ] = None,
    model: Model = None,
    show_prompt: Annotated[
        bool,
        typer.Option(
            "--show-prompt", help="Print what a language model is asked, a request a line."
        ),
    ] = False,
    as_json: AsJson = False,
) -> None:
    """Show the goals that a sentence becomes, without doing anything.

    [bold]Examples[/bold]

      humanoid parse "bring all the cups to the counter"

      humanoid parse --json --file sentences.txt --vocabulary names.json

      humanoid parse --show-prompt "tidy the kitchen"
    """
    from executive.frontends.parse import parse_all

    if sentence is None and file is None:
        raise typer.BadParameter("give a sentence, or --file")
    if vocabulary is not None and is_given(context, "world") and world is not None:
        raise typer.BadParameter("names come from --world or from --vocabulary, not from both")
    texts = [" ".join(sentence)] if sentence is not None else []
    status = parse_all(
        texts,
        world="kitchen" if world is None else world,
        vocabulary=vocabulary,
        file=file,
        model=model,
        show_prompt=show_prompt,
        as_json=as_json,
    )
    raise typer.Exit(status)


@app.command()
def view(
    *,
    world: World = "kitchen",
    robot: Robot = "juno",
    seed: Seed = 0,
    snapshot: Annotated[
        Path | None,
        typer.Option("--snapshot", help="Render one picture into this file (.png, .jpg)."),
    ] = None,
) -> None:
    """Look at a world with the robot in it.

    [bold]Examples[/bold]

      humanoid view --world kitchen --snapshot kitchen.png

      humanoid view            (MuJoCo's viewer, where there is a display)
    """
    from executive.frontends.view import look

    raise typer.Exit(look(world, robot, seed=seed, snapshot=snapshot))


@app.command()
def doctor(*, robot: Robot = "juno", as_json: AsJson = False) -> None:
    """Say what is there on this machine and what is missing, each with its cure.

    With a robot: whether its description, its model and its body fit each other.
    """
    from executive.frontends.doctor import doctor

    raise typer.Exit(doctor(robot=robot, as_json=as_json))


@model_app.command()
def export(
    *,
    urdf: Annotated[Path, typer.Option("--urdf", help="The file to write.")],
    robot: Robot = "juno",
) -> None:
    """Write a robot as URDF.

    [bold]Example[/bold]

      humanoid model export --urdf juno.urdf
    """
    from robot.model import description
    from robot.model import urdf as writer

    refuse_inputs([urdf], [Path(robot)])
    text = writer.urdf(description.load(robot))
    try:
        write_ordinary(urdf, text.encode())
    except OSError as error:
        raise ConfigError(f"{urdf} cannot be written: {error.strerror}") from None
    say(f"Done: {urdf}")


# After the commands above, so that `--help` lists first what people use first.
services.register(app)
remotes.register(app)
worlds.register(app)
missions.register(app)
maps_cli.register(app)
history.register(app)
dumps.register(app)
recordings.register(app)
consoles.register(app)
films.register(app)
sensors_cli.register(app)
motors.register(app)
configs.register(app, settings)


@app.command(name="eval")
@takes(Eval)
def evaluate(options: Eval) -> None:
    """Run missions with seeds and faults, over and over, and say how often it went right.

    Judged by the simulator's truth. Without missions and faults: the whole campaign of faults.

    [bold]Examples[/bold]

      humanoid eval --seeds 20 --no-recovery

      humanoid eval "put the red cup on the shelf" --seeds 10

      humanoid eval --faults "missed grasp,camera silent" --json

      humanoid eval --homes flat:7,office:8 --seeds 1    (the campaign in homes made from seeds)

      humanoid eval --tasks my_flat.tasks.yaml --seeds 10    (an exam: docs/evaluation.md)

    Exit status 1 where a case is right, or an exam is done, in fewer runs than --require.
    """
    from executive.frontends.evaluation import evaluate

    raise typer.Exit(evaluate(options))


app.command()(listen)
put_into_panels(app)


def is_given(context: typer.Context, name: str) -> bool:
    """Whether an option stands on the command line, and not in a file."""
    return getattr(context.get_parameter_source(name), "name", "") == "COMMANDLINE"


def _checked(word: str) -> str:
    """A word of the command line, if it can be printed: typer repeats what it does not understand.

    A cry to stop is heard all the same, whatever was pasted along with it.
    """
    if is_printable(word):
        return word
    from intents.stopping import is_stop

    if is_stop(word):
        return "stop"
    text = f"the command line holds what cannot be printed: {printable(word)[:60]}"
    raise ConfigError([Problem(text, suggestion="leave it out")])


def _check_values(words: list[str]) -> None:
    """Refuse options whose value is empty: what a variable of the shell leaves that is not set.

    As a path it would be the current folder. Raises ConfigError.
    """
    for before, word in pairwise(["", *words]):
        option = before if not word else word.removesuffix("=") if word.endswith("=") else ""
        if re.fullmatch(r"-[a-z]|--[a-z-]+", option):
            cure = "say what it is to be, or leave it out (is a variable of the shell not set?)"
            raise ConfigError([Problem(f"what follows {option} is empty", suggestion=cure)])


def _whole(status: str | int | None) -> str | int | None:
    """An exit status; another one where output that was all the work did not get to its place."""
    why, product = streams.lost()
    if not why:
        return status
    say(f"Not all of the output could be written: {why}", err=True)
    return status or (int(ExitStatus.INVALID) if product else status)


def _wish_in(ended: SystemExit) -> KeyboardInterrupt | None:
    """The Ctrl-C that typer ends with, which it makes a status of its own without a word."""
    wish = ended.__context__.__cause__ if ended.__context__ is not None else None
    return wish if isinstance(wish, KeyboardInterrupt) else None


def main() -> None:
    """Entry point of `humanoid`: every error ends in a sentence and an exit status."""
    # Python puts the current folder before its own library in what is started as a module or as
    # text (the processes of a run, the workers of an evaluation): a file of a stranger would run.
    os.environ["PYTHONSAFEPATH"] = "1"
    streams.steady()
    streams.sized()
    tell_of_mistakes()
    completes = "_HUMANOID_COMPLETE" in os.environ
    try:
        sys.argv[1:] = map(_checked, sys.argv[1:])
        if not completes and quick.is_cried(sys.argv[1:], list(PANEL_OF)):
            sys.exit(quick.run(["stop", *sys.argv[1:]]))
        _check_values(sys.argv[1:])
        # what is completed needs no defaults, and a file that is wrong is no business of Tab's
        app(prog_name="humanoid", default_map=None if completes else defaults)
    except SystemExit as ended:
        wish = _wish_in(ended)
        if wish is not None and not completes:
            sys.exit(ended_by(wish, as_json="--json" in sys.argv))
        if ended.code == ExitStatus.INVALID and sys.argv[1:2] and sys.argv[1].startswith("-"):
            say(f"Those of the prompt stand behind its name: humanoid repl {sys.argv[1]}", err=True)
        sys.exit(_whole(ended.code))
    except (Exception, KeyboardInterrupt) as error:  # the last words must not be a bare traceback
        if completes:  # a shell's line is no place for words
            sys.exit(ExitStatus.INVALID)
        sys.exit(ended_by(error, as_json="--json" in sys.argv))
