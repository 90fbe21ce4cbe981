"""Options that commands share, each written once; a command takes some of these groups.

    @dataclass(frozen=True, kw_only=True)
    class Do(Place, Seeded, Shown):
        sentence: Annotated[list[str], typer.Argument(help="What to do.")]

    @app.command()
    @takes(Do)
    def do(options: Do) -> None: ...

The fields become the command's options, and the same value crosses to the executive's process.
"""

from __future__ import annotations

import dataclasses
import inspect
import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, TypeVar, get_type_hints

import typer

from executive.frontends import completing
from executive.frontends.dump.cli import Dump, DumpFormat, DumpOn
from robot.messages import AskedEyes, AskedLocalisation
from robot.reality.contract import USUAL

T = TypeVar("T")

_WORLD = typer.Option(
    "--world",
    "-w",
    help="A shipped world by name, or a world file (YAML).",
    autocompletion=completing.worlds,
)
World = Annotated[str, _WORLD]
WorldIfAny = Annotated[str | None, _WORLD]
Robot = Annotated[
    str,
    typer.Option(
        "--robot",
        "-r",
        help="A shipped robot by name, or a robot file (YAML).",
        autocompletion=completing.robots,
    ),
]
MOST_SEED = 2**53 - 1
"""The largest whole number that every reader of JSON takes for the same."""
Seed = Annotated[
    int, typer.Option("--seed", "-s", min=0, max=MOST_SEED, help="Of everything random.")
]
InReality = Annotated[
    str,
    typer.Option(
        "--reality",
        help="How far robot and senses are from their descriptions: ideal, real or harsh "
        "(docs/realities.md).",
    ),
]
Eyes = Annotated[
    AskedEyes,
    typer.Option(
        "--eyes",
        help="Who tells the robot where things are: camera: it finds, measures and names them in "
        "its own pictures; oracle: the simulator; auto: camera where that was tried (Juno in the "
        "kitchen and on the bench), else oracle (docs/perception.md).",
    ),
]
Localisation = Annotated[
    AskedLocalisation,
    typer.Option(
        "--localisation",
        help="Who tells the robot where it is: lidar: it finds itself with its lidar and legs in a "
        "map that it made itself (without one it makes one first); oracle: the simulator; auto: "
        "lidar where it has a map, else oracle (docs/localisation.md).",
    ),
]
Driver = Annotated[
    str,
    typer.Option(
        "--driver",
        help="Of its motors, in place of the one that the robot names: simulated, or can, "
        "dynamixel, ethernet, pwm, with emulated motors behind emulated buses (docs/hardware.md; "
        "not with --fast).",
    ),
]
Model = Annotated[
    Path | None,
    typer.Option(
        "--model",
        envvar="HUMANOID_MODEL",
        help="Language model (an endpoint's TOML file) to ask what the grammar cannot read; "
        "its key is named in ~/.config/humanoid/keys.toml (docs/intents.md).",
    ),
]
View = Annotated[
    bool, typer.Option("--view", help="Show it at work on a page of this machine, in 3-D.")
]
Record = Annotated[
    bool,
    typer.Option(
        "--record", help="Write it to recorded.mcap in the run's folder as it goes on (Foxglove)."
    ),
]
AsJson = Annotated[bool, typer.Option("--json", help="One JSON object, and nothing else.")]


@dataclass(frozen=True, kw_only=True)
class Place:
    """A robot and where it is."""

    world: World = "kitchen"
    robot: Robot = "juno"


@dataclass(frozen=True, kw_only=True)
class Seeded:
    """How time passes, and what is drawn."""

    seed: Seed = 0
    reality: InReality = USUAL
    eyes: Eyes = "auto"
    localisation: Localisation = "auto"
    fast: Annotated[
        bool,
        typer.Option(
            "--fast", help="As fast as the machine goes, and the same every time, in one process."
        ),
    ] = False
    driver: Driver = ""
    camera: Annotated[
        bool,
        typer.Option(
            "--camera",
            help="Render what its camera sees as well, in a process of its own, and keep the "
            "newest picture as seen.png in the run's folder (not with --fast).",
        ),
    ] = False


@dataclass(frozen=True, kw_only=True)
class Shuffled(Seeded):
    """A world that is not always the same."""

    vary: Annotated[
        bool, typer.Option("--vary", help="Shuffle the start and the objects by the seed.")
    ] = False

    @property
    def vary_seed(self) -> int | None:
        """What the world is shuffled by, if it is."""
        return self.seed if self.vary else None


@dataclass(frozen=True, kw_only=True)
class Kept:
    """A run that leaves a folder."""

    run_dir: Annotated[
        Path | None,
        typer.Option("--run-dir", help="Where the journal goes (default: runs/STAMP-WORDS)."),
    ] = None


@dataclass(frozen=True, kw_only=True)
class Reading:
    """How words are read."""

    model: Model = None


@dataclass(frozen=True, kw_only=True)
class Agreeing(Reading):
    """How words are read, and whether a plan is asked about."""

    yes: Annotated[
        bool,
        typer.Option(
            "--yes", help="Do what the language model plans without asking, unless it is risky."
        ),
    ] = False


@dataclass(frozen=True, kw_only=True)
class Shown:
    """How people, programs and files are told what goes on."""

    as_json: AsJson = False
    dump: Dump = None
    dump_on: DumpOn = "end"
    dump_format: DumpFormat = "html"


@dataclass(frozen=True, kw_only=True)
class Viewed:
    """Whether it is shown on a page, and kept for other programs."""

    view: View = False
    record: Record = False


@dataclass(frozen=True, kw_only=True)
class Voiced:
    """Whether the robot speaks."""

    voice: Annotated[
        bool,
        typer.Option("--voice", help="Say aloud what is answered and asked, and how it ended."),
    ] = False
    voice_model: Annotated[
        Path | None,
        typer.Option("--voice-model", help="The same with piper, in this voice (ONNX)."),
    ] = None

    @property
    def aloud(self) -> bool:
        """Whether it is to speak: a voice is named to be heard."""
        return self.voice or self.voice_model is not None


@dataclass(frozen=True, kw_only=True)
class Do(Place, Shuffled, Shown, Viewed, Kept, Agreeing, Voiced):
    """The options of `humanoid do`."""

    sentence: Annotated[list[str], typer.Argument(help="What to do, in plain English.")]

    @property
    def text(self) -> str:
        """The sentence as one text."""
        return " ".join(self.sentence)


@dataclass(frozen=True, kw_only=True)
class Prompt(Place, Shuffled, Viewed, Kept, Agreeing, Voiced):
    """The options of `humanoid repl`, and of `humanoid` without a command."""


@dataclass(frozen=True, kw_only=True)
class Walk(Place, Seeded, Viewed, Kept):
    """The options of `humanoid walk`: to look at the body alone, where nothing is in its way."""

    speed: Annotated[float, typer.Option("--speed", help="Forward, in m/s.")] = 0.4
    left: Annotated[float, typer.Option("--left", help="Sideways, to the left, in m/s.")] = 0.0
    turn: Annotated[float, typer.Option("--turn", help="Turning, to the left, in rad/s.")] = 0.0
    duration: Annotated[float, typer.Option("--for", help="How long, in seconds.")] = 10.0
    world: World = "empty"
    as_json: AsJson = False


@dataclass(frozen=True, kw_only=True)
class Eval:
    """The options of `humanoid eval`."""

    missions: Annotated[
        list[str] | None,
        typer.Argument(help="Sentences or mission files; none: those of the cases themselves."),
    ] = None
    tasks: Annotated[
        list[Path] | None,
        typer.Option("--tasks", "-t", help="A file of tasks in a home; several times: several."),
    ] = None
    seeds: Annotated[
        int, typer.Option("--seeds", "-n", min=1, max=10_000, help="Runs of each case.")
    ] = 3
    faults: Annotated[
        str,
        typer.Option("--faults", "-f", help="Cases by name, or campaign files; commas between."),
    ] = ""
    homes: Annotated[
        str,
        typer.Option(
            "--homes", help="The cases in other homes: flat:7,office:8, or how many (a kind each)."
        ),
    ] = ""
    processes: Annotated[
        int, typer.Option("--processes", "-j", min=1, max=256, help="Runs at the same time.")
    ] = max(1, os.cpu_count() or 1)
    no_recovery: Annotated[
        bool,
        typer.Option("--no-recovery", help="Run everything a second time without recovery."),
    ] = False
    require: Annotated[
        float,
        typer.Option(
            "--require", min=0.0, max=1.0, help="Share of each case, or of all tasks, to be right."
        ),
    ] = 0.95
    resume: Annotated[
        Path | None,
        typer.Option("--resume", help="Folder of the results; what is in it is not run again."),
    ] = None
    ray: Annotated[
        bool, typer.Option("--ray", help="On a Ray cluster, or a local Ray (extra: ray).")
    ] = False
    world: Annotated[
        str, typer.Option("--world", "-w", help="In place of that of the missions given here.")
    ] = ""
    robot: Annotated[
        str, typer.Option("--robot", "-r", help="In place of the missions' own (juno).")
    ] = ""
    reality: InReality = USUAL
    eyes: Eyes = "auto"
    localisation: Localisation = "auto"
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object, and nothing else.")] = (
        False
    )

    @property
    def cases(self) -> tuple[str, ...]:
        """The cases and campaign files that --faults names."""
        return tuple(word.strip() for word in self.faults.split(",") if word.strip())


def takes(kind: type[T]) -> Callable[[Callable[[T], None]], Callable[..., None]]:
    """Make a command of a function that takes one value of `kind`: its fields are the options.

    They are shown in the order of writing, the class's own first, then those of its bases.
    """
    hints = get_type_hints(kind, include_extras=True)
    fields = {field.name: field for field in dataclasses.fields(kind)}  # pyright: ignore[reportArgumentType]
    order = dict.fromkeys(
        name for base in kind.__mro__ for name in vars(base).get("__annotations__", ())
    )
    parameters = [
        inspect.Parameter(
            name,
            inspect.Parameter.KEYWORD_ONLY,
            annotation=hints[name],
            default=inspect.Parameter.empty
            if fields[name].default is dataclasses.MISSING
            else fields[name].default,
        )
        for name in order
    ]

    def decorate(function: Callable[[T], None]) -> Callable[..., None]:
        def command(**given: object) -> None:
            function(kind(**given))

        command.__name__, command.__doc__ = function.__name__, function.__doc__
        command.__signature__ = inspect.Signature(parameters)  # pyright: ignore[reportFunctionMemberAccess]
        return command

    return decorate
