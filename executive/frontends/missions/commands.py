"""What the commands of `humanoid mission` do, from their options to an exit status."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import msgspec

from executive.frontends.composition_root import REALITY
from executive.frontends.missions.options import Beside
from executive.frontends.new_files import put, refuse_taken
from executive.frontends.output import say, write, write_json
from executive.journal import failures
from executive.missions import load
from executive.missions.check import Checked, Options, check
from executive.missions.editor_schema import json_schema
from executive.missions.plan import forecast, lines
from executive.missions.template import template
from executive.trees.parts import errands
from robot.errors import ConfigError, Problem
from robot.exit_status import ExitStatus

SCHEMA = load.FOLDER / "mission.schema.json"

PRINTED = Path("the mission above")
"""The name of a file that was printed, in what is wrong with it."""

FILE_NAME = re.compile(r"\w[\w. -]{0,99}")
"""Of a new mission: a name that every file system and every message can take."""


def said(options: Beside, *, vary_seed: int | None = None, samples: bool = False) -> Options:
    """What was said beside a file.

    Raises:
        ConfigError: a parameter is no NAME=VALUE.
    """
    values: dict[str, str] = {}
    for text in options.params or ():
        name, equals, value = text.partition("=")
        if not equals or not name:
            cure = "for example: --param thing='red cup'"
            raise ConfigError([Problem(f"--param {text!r} is no NAME=VALUE", suggestion=cure)])
        values[name] = value
    return Options(
        params=values,
        world=options.world,
        robot=options.robot,
        vary_seed=vary_seed,
        first=options.first,
        samples=samples,
    )


def check_all(files: list[str], options: Options, *, as_json: bool) -> int:
    """Check files, and say what is wrong in each."""
    found: list[dict[str, Any]] = []
    for name in files:
        path = load.find(name)
        record: dict[str, Any] = {"file": str(path), "problems": []}
        try:
            checked = check(path, REALITY, options)
            record["steps"] = sum(1 for _ in errands(checked.task))
            record["notes"] = [msgspec.to_builtins(note) for note in checked.notes]
        except ConfigError as error:
            record["problems"] = [msgspec.to_builtins(problem) for problem in error.problems]
        found.append(record)
        if not as_json:
            _say_checked(record)
    wrong = any(record["problems"] for record in found)
    if as_json:
        status = "invalid" if wrong else "done"
        write_json({"status": status, "missions": found})
    elif wrong:
        say("\n".join(failures.advice("correct that, then check again")), err=True)
    return ExitStatus.INVALID if wrong else ExitStatus.DONE


def _say_checked(record: dict[str, Any]) -> None:
    problems = [msgspec.convert(problem, Problem) for problem in record["problems"]]
    if not problems:
        count = record["steps"]
        say(f"{record['file']}: all is well, {count} {'step' if count == 1 else 'steps'}")
    for note in record.get("notes", ()):
        say(str(msgspec.convert(note, Problem)), err=True)
    for problem in problems:
        say(str(problem), err=True)


def say_notes(checked: Checked) -> None:
    """Say which words were taken for others."""
    for note in checked.notes:
        say(str(note), err=True)


def plan(name: str, options: Options, *, as_json: bool) -> int:
    """Show a dry run. Raises ConfigError with what is wrong in the file."""
    checked = check(load.find(name), REALITY, options)
    say_notes(checked)
    made = forecast(checked.task, checked.where, done=checked.done)
    if as_json:
        write_json(made)
    else:
        say(checked.mission.record.name)
        say("\n".join(lines(made)))
    return ExitStatus.DONE


def list_shipped() -> int:
    """Name the shipped missions with what they are for."""
    from executive.missions.problems import Problems

    for path in load.shipped():
        mission = load.load(path, Problems())
        about = mission.record.about if mission is not None else "cannot be read"
        say(f"{path.stem:12}  {about}")
    say("Run one: humanoid mission run NAME --fast. Write your own: humanoid mission new NAME")
    return ExitStatus.DONE


def schema_text() -> str:
    """The JSON Schema as text."""
    return msgspec.json.format(msgspec.json.encode(json_schema()), indent=1).decode() + "\n"


def write_schema(output: Path | None) -> int:
    """Print or write the JSON Schema. Raises ConfigError if it cannot be written."""
    return _write(schema_text(), output)


def new(name: str) -> int:
    """Write a mission to begin with. Raises ConfigError if it is there already, or no name."""
    if not FILE_NAME.fullmatch(name):
        cure = "letters, digits, spaces, - and _, as in tidy_up: the file is made in this folder"
        raise ConfigError([Problem(f"{name[:60]!r} is no name of a mission", suggestion=cure)])
    path = Path(name if name.endswith(load.SUFFIX) else f"{name}{load.SUFFIX}")
    refuse_taken(path)
    text = template(path.stem.replace("_", " "), file=str(path), schema=SCHEMA.as_uri())
    return _write(text, path)


def import_file(file: Path, output: Path | None) -> int:
    """Make a mission of a BehaviorTree.CPP or Nav2 file, and check it as `mission check` does.

    What it names may be of another world than the one that missions begin with: it is written
    then all the same, and what is wrong in it is said.

    Raises:
        ConfigError: it cannot be made or written; nothing is.
    """
    from executive.missions import nav2
    from executive.missions.btcpp import importing

    if output is not None:
        refuse_taken(output)
    make = importing.mission_of if file.suffix.casefold() == ".xml" else nav2.mission_of
    text = make(file)
    wrong: list[Problem] = []
    try:
        check(output or PRINTED, REALITY, text=text)
    except ConfigError as error:
        wrong = error.problems
    _write(text, output, word="Written, and not to be run as it is" if wrong else "Done")
    if output is not None:
        for line in text.splitlines():
            if line.startswith("# "):
                say(line.removeprefix("# "), err=True)
    for problem in wrong:
        say(str(problem), err=True)
    if wrong:
        cure = "correct that in the mission, or name its world in it (world: FILE), then check it"
        say("\n".join(failures.advice(cure)), err=True)
    return ExitStatus.INVALID if wrong else ExitStatus.DONE


def export_file(name: str, output: Path | None) -> int:
    """Write a mission as BehaviorTree.CPP XML. Raises ConfigError if the file is wrong."""
    from executive.missions.btcpp import exporting

    return _write(exporting.xml_of(load.find(name), REALITY), output)


def _write(text: str, output: Path | None, *, word: str = "Done") -> int:
    if output is None:
        write(text)
    else:
        put(output, text, word=word)
    return ExitStatus.DONE
