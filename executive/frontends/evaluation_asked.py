"""What an evaluation was asked to run, kept beside its results: `--resume FOLDER` alone goes on."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Annotated

import msgspec

from executive.frontends.options import Eval
from robot.errors import ConfigError, Problem
from robot.files.ordinary_files import read_ordinary, write_ordinary
from robot.files.plain_data import fitted, from_json
from robot.messages import AskedEyes, AskedLocalisation

FILE = "asked.json"
LIMIT = 1_000_000
MOST_WORDS, MOST_LETTERS = 1000, 20_000
"""Of files and sentences, and of all names: a stranger's folder may ask for any number."""
_Words = Annotated[tuple[str, ...], msgspec.Meta(max_length=MOST_WORDS)]


class Asked(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The options that say which runs there are; as of `Eval`, and left out: as it once was."""

    missions: _Words = ()
    tasks: _Words = ()
    faults: Annotated[str, msgspec.Meta(max_length=MOST_LETTERS)] = ""
    homes: Annotated[str, msgspec.Meta(max_length=MOST_LETTERS)] = ""
    world: str = ""
    robot: str = ""
    reality: str = "ideal"
    eyes: AskedEyes = "oracle"
    localisation: AskedLocalisation = "oracle"
    seeds: Annotated[int, msgspec.Meta(ge=1, le=10_000)] = 1
    no_recovery: bool = False


def keep(folder: Path, options: Eval) -> None:
    """Write what is asked for into the folder of the results.

    Raises:
        ConfigError: if it cannot be written.
    """
    asked = Asked(
        missions=tuple(options.missions or ()),
        tasks=tuple(str(path) for path in options.tasks or ()),
        faults=options.faults,
        homes=options.homes,
        world=options.world,
        robot=options.robot,
        reality=options.reality,
        eyes=options.eyes,
        localisation=options.localisation,
        seeds=options.seeds,
        no_recovery=options.no_recovery,
    )
    try:
        write_ordinary(folder / FILE, msgspec.json.format(msgspec.json.encode(asked)) + b"\n")
    except OSError as error:
        text = f"what is asked for cannot be kept: {error.strerror}"
        raise ConfigError([Problem(text, str(folder / FILE), suggestion="make room")]) from None


def as_before(options: Eval) -> Eval:
    """The options, with what was asked for before where they only say to go on.

    More seeds than before are more runs; fewer are as many as before.

    Raises:
        ConfigError: if what was kept cannot be read, or something else is asked for now.
    """
    path = options.resume / FILE if options.resume is not None else None
    if path is None or not path.exists():
        return options
    try:
        text = read_ordinary(path, limit=LIMIT, follow_links=False).decode()
        asked = fitted(from_json(text), Asked, path)
    except ValueError as error:
        cure = "leave --resume out to begin anew"
        text = f"it cannot be read: {error}"
        raise ConfigError([Problem(text, str(path), suggestion=cure)]) from None
    if any(_chosen(options).values()):
        _must_be_as_before(options, asked)
        by = asked.localisation if options.localisation == "auto" else options.localisation
        return replace(options, localisation=by)
    return replace(
        options,
        missions=list(asked.missions) or None,
        tasks=[Path(word) for word in asked.tasks] or None,
        faults=asked.faults,
        homes=asked.homes,
        reality=asked.reality,
        eyes=asked.eyes,
        localisation=asked.localisation,
        world=asked.world,
        robot=options.robot or asked.robot,
        seeds=max(options.seeds, asked.seeds),
        no_recovery=options.no_recovery or asked.no_recovery,
    )


def _chosen(options: Eval | Asked) -> dict[str, tuple[str, ...]]:
    """What is evaluated, by the name of its option."""
    return {
        "missions": tuple(options.missions or ()),
        "--tasks": tuple(str(path) for path in options.tasks or ()),
        "--faults": tuple(filter(None, [options.faults])),
        "--homes": tuple(filter(None, [options.homes])),
        "--world": tuple(filter(None, [options.world])),
    }


def _must_be_as_before(options: Eval, asked: Asked) -> None:
    """Refuse to put results of something else beside those that are there.

    Raises:
        ConfigError: with all that differs.
    """
    now, before = _chosen(options), _chosen(asked)
    problems = [
        Problem(
            f"the results in {options.resume} are of {', '.join(before[name]) or 'none'}, "
            f"not of {', '.join(now[name]) or 'none'}",
            name,
            suggestion=f"humanoid eval --resume {options.resume} goes on; without it, begin anew",
        )
        for name in now
        if sorted(now[name]) != sorted(before[name])
    ]
    if problems:
        raise ConfigError(problems)
