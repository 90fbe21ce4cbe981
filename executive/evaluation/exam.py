"""Tasks out of a YAML file: sentences as people type them in a home, and what is true then.

    world: flat.yaml
    tasks:
      - {kind: fetch, say: "bring the red mug to the kitchen counter", person_s: 25,
         truth: [{object: red_mug, on: counter}]}

Anybody can write an exam for any world. Nothing of a task is checked by whether it is understood:
that is what is asked.
"""

from __future__ import annotations

from itertools import islice
from pathlib import Path
from typing import Annotated, Any

import msgspec
from msgspec import Meta

from executive.evaluation.campaign import LIMIT_S, REFUSED, Case, Settings
from robot.errors import ConfigError, Problem
from robot.failures import CATALOGUE
from robot.files import config, yaml_nodes
from robot.files.misfits import shown
from robot.messages import WorldMap
from robot.reality import truth

LONG_S = 900.0
LONG = ("all", "two")
"""Kinds that are several errands in one."""

_Time = Annotated[float, Meta(gt=0.0, le=3600.0)]


class Task(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """One sentence, and how it is judged.

    Attributes:
        kind: by which the table sums up.
        say: what is typed.
        truth: what has to be so in the simulator at the end (`robot.reality.truth`).
        person_s: what a calm person would need.
        or_code: a failure that counts as well, if the truth holds; `REFUSED`: the sentence is
            refused or asked back, for whatever reason, and nothing moves.
        limit_s: of robot time.
        expect: conditions of a mission that the robot should believe then; for people, not judged.
        fair: why a judgement is as it is.
    """

    kind: Annotated[str, Meta(min_length=1, max_length=40)]
    say: str
    truth: Annotated[tuple[dict[str, Any], ...], Meta(min_length=1)]
    person_s: _Time | None = None
    or_code: str = ""
    limit_s: _Time | None = None
    expect: tuple[Any, ...] = ()
    fair: str = ""


class Exam(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A file of tasks for one world: a shipped one by name, or a file beside this one."""

    world: str
    tasks: Annotated[tuple[Task, ...], Meta(min_length=1, max_length=10_000)]


def load(path: Path, settings: Settings) -> tuple[Case, ...]:
    """Read an exam, and check every name in it before anything is run.

    Raises:
        ConfigError: with file, line and the nearest valid name.
    """
    node = yaml_nodes.read(path)
    exam = config.convert(node, Exam)
    world = exam.world
    if config.names_file(world):
        world = str(path.parent / world)
    world_map = settings.of(world).world_map
    wrong = (
        (index, problem)
        for index, task in enumerate(exam.tasks)
        for problem in _problems(task, world_map)
    )
    problems = [
        config.place(node, f"$.tasks[{index}]").problem(one.message, one.suggestion or "")
        for index, one in islice(wrong, config.MOST_PROBLEMS)
    ]
    if next(wrong, None):
        problems.append(Problem("and more that is wrong", str(path)))
    if problems:
        raise ConfigError(problems)
    return tuple(
        _case(task, world, name=f"{path.name.removesuffix('.tasks.yaml')} {number}: {task.say}")
        for number, task in enumerate(exam.tasks, start=1)
    )


def _problems(task: Task, world_map: WorldMap) -> list[Problem]:
    found: list[Problem] = []
    if task.or_code and task.or_code not in (REFUSED, *CATALOGUE):
        hint = config.nearest(task.or_code, list(CATALOGUE))
        found.append(Problem(f"unknown failure code {shown(task.or_code)}", suggestion=hint))
    try:
        truth.read(task.truth, world_map)
    except ConfigError as error:
        found += error.problems
    return found


def _case(task: Task, world: str, *, name: str) -> Case:
    return Case(
        name=name,
        mission=task.say,
        world=world,
        expect=(task.or_code,) if task.or_code else (),
        truth=task.truth,
        limit_s=task.limit_s or (LONG_S if task.kind in LONG else LIMIT_S),
        kind=task.kind,
        person_s=task.person_s or 0.0,
    )
