"""A mission file to a task that can be done here, or to everything that is wrong in it."""

from __future__ import annotations

import gc
from collections.abc import Generator, Iterator, Mapping
from contextlib import contextmanager
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any, cast

import msgspec

from executive.meaning.request import Setting, setting
from executive.missions import fault_plans
from executive.missions.compiling import Compiler
from executive.missions.fault_plans import FaultPlan
from executive.missions.load import Mission, load
from executive.missions.names import Names, NoNames
from executive.missions.problems import Enough, Problems
from executive.missions.schema import ROBOT
from executive.missions.values import Bound
from executive.trees.build import before
from executive.trees.parts import Part, Series, walk
from robot.errors import ConfigError, Problem
from robot.files.config import nearest
from robot.files.misfits import closest
from robot.files.yaml_nodes import Node, parse, text_node
from robot.model import description
from robot.model.body import BodyModel
from robot.reality.contract import Reality


class Options(msgspec.Struct, frozen=True, kw_only=True):
    """What is said beside the file.

    Attributes:
        params: values of parameters, as typed.
        world: in place of the file's.
        robot: in place of the file's.
        vary_seed: shuffles the world.
        first: the path of the step to begin at; empty: at the beginning.
        samples: whether something fitting stands in for parameters without a value.
    """

    params: Mapping[str, str] = {}
    world: str | None = None
    robot: str | None = None
    vary_seed: int | None = None
    first: str = ""
    samples: bool = False


class Checked(msgspec.Struct, frozen=True, kw_only=True, eq=False):
    """A mission that can be done here.

    Attributes:
        mission: the file.
        where: robot and world.
        task: what is done.
        done: what is left out because of `first` (`executive.trees.build`).
        values: of the parameters.
        faults: what goes wrong on purpose.
        files: the mission's own and those that it calls.
        notes: words that are misspelt, and what they were taken for; faults of no step of it.
    """

    mission: Mission
    where: Setting
    task: Part
    done: frozenset[str]
    values: Mapping[str, Bound]
    faults: tuple[FaultPlan, ...]
    files: tuple[Path, ...]
    notes: tuple[Problem, ...] = ()


def check(
    path: Path, reality: Reality, options: Options | None = None, *, text: str | None = None
) -> Checked:
    """Check a mission file whole.

    Args:
        path: of the file.
        reality: that its world is of.
        options: what is said beside the file.
        text: what stands in it, where that is known.

    Raises:
        ConfigError: with every mistake, each with file, line, column and cure.
    """
    problems = Problems()
    checked = None
    try:
        with _collector_at_rest():
            mission = load(path, problems, text=text)
            if mission is not None:
                checked = _check(mission, reality, options or Options(), problems=problems)
    except Enough:
        pass
    except ConfigError as error:
        if len(problems) == 0:
            raise
        raise ConfigError(_merged(problems, error)) from None
    if len(problems) and checked is not None:  # a word taken for another may be the cause
        raise ConfigError([*problems.all, *checked.notes])
    problems.raise_any()
    assert checked is not None
    return checked


@contextmanager
def _collector_at_rest() -> Generator[None]:
    """Many objects and no garbage: looking for it took half of the time."""
    at_work = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if at_work:
            gc.enable()


def _merged(problems: Problems, error: ConfigError) -> list[Problem]:
    found = dict.fromkeys(str(problem) for problem in problems.all)
    return [*problems.all, *(p for p in error.problems if str(p) not in found)]


def _check(
    mission: Mission, reality: Reality, options: Options, *, problems: Problems
) -> Checked | None:
    where = _setting(mission, reality, options, problems=problems)
    if where is None:
        _check_without_world(mission, reality, options, problems=problems)
        return None
    names = Names(where.knowledge)
    compiler = Compiler(names, where.description, problems)
    given = {name: _typed(name, text) for name, text in options.params.items()}
    values = compiler.calls.bound(
        mission, given, where=mission.node.key("parameters"), samples=options.samples
    )
    task = compiler.mission(mission, values)
    if not options.first:  # else nobody knows how much of it is left
        compiler.note_limits(task)
    _check_speed(mission, where, problems)
    plans = _faults(mission, where, problems)
    done = _done(task, options.first, problems)
    return Checked(
        mission=mission,
        where=where,
        task=task,
        done=done,
        values=values,
        faults=plans,
        files=(mission.path, *compiler.calls.files),
        notes=(*names.notes, *_idle_faults(mission, task, plans)),
    )


def _check_without_world(
    mission: Mission, reality: Reality, options: Options, *, problems: Problems
) -> None:
    """Note what is wrong in a mission wherever it is done, where its world or robot is none."""
    robot = mission.beside(mission.record.robot) if options.robot is None else options.robot
    world = next(iter(reality.names()))
    for stand_in in dict.fromkeys((robot, ROBOT)):
        try:
            anywhere = setting(reality, world, robot=stand_in)
        except ConfigError:
            continue
        names = NoNames(anywhere.knowledge)
        compiler = Compiler(names, anywhere.description, problems)
        given = {name: _typed(name, text) for name, text in options.params.items()}
        values = compiler.calls.bound(
            mission, given, where=mission.node.key("parameters"), samples=options.samples
        )
        compiler.mission(mission, values)
        if stand_in == robot:
            _check_speed(mission, anywhere, problems)
        for node in mission.record.faults:
            _check_fault(node, problems)  # pyright: ignore[reportArgumentType]
        return


def _setting(
    mission: Mission, reality: Reality, options: Options, *, problems: Problems
) -> Setting | None:
    """Robot and world; mistakes in them are noted, each where it is named.

    The rest is then looked at for what was most likely meant; None where nothing of a near name
    comes along.
    """
    said, named = options, mission.record
    robot = mission.beside(named.robot) if said.robot is None else said.robot
    world = mission.beside(named.world) if said.world is None else said.world
    try:
        return setting(reality, world, robot=robot, vary_seed=options.vary_seed)
    except ConfigError:
        with _noted(problems, _named(mission, "robot", said=options.robot)):
            BodyModel(description.load(robot))
        with _noted(problems, _named(mission, "world", said=options.world)):
            reality.world(world, vary_seed=options.vary_seed)
        robots, worlds = description.shipped(), reality.names()
        robot = robot if robot in robots else closest(robot, robots)
        world = world if world in worlds else closest(world, worlds)
        return setting(reality, world, robot=robot) if robot and world else None


def _named(mission: Mission, key: str, *, said: str | None) -> Node:
    """Where a robot or a world is named: beside the file, or in it."""
    if said is not None:
        return Node("text", f"--{key}", 0, 0)
    return mission.node.get(key) or mission.node


@contextmanager
def _noted(problems: Problems, at: Node) -> Generator[None]:
    """Note what is refused inside the block; what has no place of its own, at a node."""
    try:
        yield
    except ConfigError as error:
        for problem in error.problems:
            if problem.file is None:
                problems.add(at, problem.message, problem.suggestion or "")
            else:
                place = Node("text", problem.file, problem.line or 1, problem.column or 1)
                problems.add(place, problem.message, problem.suggestion or "")


def _typed(name: str, text: str) -> Node:
    """A value from the command line."""
    file = f"--param {name}"
    if text.startswith("["):
        return parse(text, file)
    return text_node(text, Node("text", file, 0, 0), plain=True)


def _check_speed(mission: Mission, where: Setting, problems: Problems) -> None:
    """Note a limit that the robot cannot keep, or that is none for it."""
    speed_m_s = mission.record.limits.speed_m_s
    walking = where.description.walking
    least, most = walking.following.least_m_s, walking.max_forward_m_s
    if speed_m_s is not None and not least <= speed_m_s <= most:
        limits = mission.node.get("limits")
        node = limits.get("speed_m_s") if limits is not None else None
        text = f"speed_m_s {speed_m_s:g}: {where.robot_name} walks {least:g} to {most:g} m/s"
        problems.add(node or mission.node, text, "a speed in that range, or no limit")


def _faults(mission: Mission, where: Setting, problems: Problems) -> tuple[FaultPlan, ...]:
    """What goes wrong on purpose, each fault checked against the world and the robot."""
    plans = [_fault(node, where, problems) for node in mission.record.faults]  # pyright: ignore[reportArgumentType]
    return tuple(plan for plan in plans if plan is not None)


def _idle_faults(mission: Mission, task: Part, plans: tuple[FaultPlan, ...]) -> Iterator[Problem]:
    """Faults whose step is none of the mission's: they strike at a recovery's, or never."""
    if len(plans) < len(mission.record.faults):
        return
    names = {name for path, part in walk(task) for name in (path, part.name)}
    for node, plan in zip(mission.record.faults, plans, strict=True):
        if plan.step and not any(fnmatchcase(name, plan.step) for name in names):
            text = f"no step of this mission is called {plan.step!r}"
            cure = "it strikes only at a step of a recovery that is; the plan shows all names"
            where = cast("Node", node).get("step") or cast("Node", node)
            yield where.problem(text, cure)


def _fault(node: Node, where: Setting, problems: Problems) -> FaultPlan | None:
    data = _check_fault(node, problems)
    if data is None:
        return None
    plan = fault_plans.plan(data)
    try:
        fault_plans.verify(plan.fault, where.world, where.description)
    except ConfigError as error:
        for problem in error.problems:
            key = next((key for key in data if f"unknown {key} " in problem.message), "")
            problems.add(node.get(key) or node, problem.message, problem.suggestion or "")
        return None
    return plan


def _check_fault(node: Node, problems: Problems) -> dict[str, Any] | None:
    """A fault as plain data; None where it cannot be meant in any world, which is noted."""
    if node.kind != "map":
        cure = 'for example: {phase: "lifting*", fault: remove, target: red cup}'
        problems.add(node, "a fault is a mapping", cure)
        return None
    data = node.plain_data
    wrong = fault_plans.wrong_in(data)
    for key, problem in wrong:
        problems.add(node.get(key) or node, problem.message, problem.suggestion or "")
    return None if wrong else data


def _done(task: Part, first: str, problems: Problems) -> frozenset[str]:
    if not first:
        return frozenset()
    done = before(task, first)
    if done is None:
        paths = (path for path, part in walk(task) if path and not isinstance(part, Series))
        known = [*dict.fromkeys(paths)]  # what is retried or limited has the path of what it holds
        place = Node("text", "--from", 0, 0)
        problems.add(place, f"there is no step {first!r} in this mission", nearest(first, known))
        return frozenset()
    return done
