"""Faults on purpose, as plans: what is to go wrong, and when.

A plan is one flat entry of a list: the keys of its trigger and the fault with its own keys::

    -{phase: "lifting*", fault: push, target: red_cup, impulse_n_s: [0, 0, -6]}
    -{step: "go to*", after_s: 1.5, fault: stand_in_way, target: anna, duration_s: 6}
    -{at_s: 5, times: 2, fault: silence, topic: lidar, duration_s: 3}

Most faults happen to the world (`robot.reality.faults`), some to this software (`OWN`). In an
evaluation a number may be drawn for each seed: ``towards_deg: {uniform: [-180, 180]}``.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from typing import Annotated, Any, TypeAlias, cast

import msgspec
import numpy as np
from msgspec import Meta

from robot.errors import ConfigError, Problem
from robot.files import plain_data
from robot.files import quantities as q
from robot.files.misfits import shown
from robot.model.description import RobotDescription
from robot.reality import faults
from robot.reality.contract import World

LONG_S = 1e6
"""Longer than any run, in which it still tells milliseconds apart."""


class FillDisk(faults.FaultRecord, frozen=True, kw_only=True):
    """The journal's file is on a full device for `duration_s`."""

    duration_s: q.Span = math.inf


class SlowPlanner(faults.FaultRecord, frozen=True, kw_only=True):
    """The next requests use up the planner's budget, and fail."""

    requests: q.Times = 1


class KillExecutive(faults.FaultRecord, frozen=True, kw_only=True):
    """The executive dies."""


OWN: dict[str, type[faults.FaultRecord]] = {
    "fill_disk": FillDisk,
    "slow_planner": SlowPlanner,
    "kill_executive": KillExecutive,
}
"""Faults of this software."""

_KINDS = {**faults.KINDS, **OWN}

Pattern: TypeAlias = Annotated[str, Meta(min_length=1)]


class Trigger(msgspec.Struct, frozen=True, kw_only=True):
    """When a fault strikes: at a time of the run, or at the beginning of a step or of a phase.

    Attributes:
        at_s: time since the run began (without `step` and `phase`; 0 by default).
        step: pattern (`pick*`) on a step's name or id.
        phase: pattern on what the skill says it is doing.
        after_s: how long after the trigger.
        times: how often at most; a trigger that comes again strikes again.
    """

    at_s: q.Moment = 0.0
    step: Pattern = ""
    phase: Pattern = ""
    after_s: q.Moment = 0.0
    times: q.Times = 1


class FaultPlan(Trigger, frozen=True, kw_only=True):
    """A trigger, and the fault as plain data, its name under `fault`."""

    fault: dict[str, Any]


TRIGGER = Trigger.__struct_fields__


MAX_CHOICES = 1000
DRAWS = {"uniform": "uniform: [low, high]", "choice": "choice: [one, or, another]"}
"""How a value is drawn, each with how it is written."""


def names() -> list[str]:
    """Every fault there is."""
    return sorted(_KINDS)


def kind(name: str) -> type[faults.FaultRecord]:
    """What the fault of a name takes. Raises KeyError if there is none."""
    return _KINDS[name]


def plan(data: Mapping[str, Any]) -> FaultPlan:
    """A fault with its trigger out of one flat mapping.

    Raises:
        ConfigError: if it cannot be meant, with everything that is wrong in it.
    """
    problems = wrong_in(data)
    if problems:
        raise ConfigError([problem for _, problem in problems])
    when, fault = _parted(data)
    return msgspec.convert({**when, "fault": fault}, FaultPlan)


def wrong_in(data: Mapping[str, Any]) -> list[tuple[str, Problem]]:
    """Everything wrong in a fault with its trigger, each with the key at which it stands."""
    when, fault = _parted(data)
    found = faults.wrong_fields(when, Trigger, "the trigger")
    if "at_s" in when and ("step" in when or "phase" in when):
        text = "a trigger has either at_s, or step and phase"
        found.append(("at_s", Problem(text, suggestion="after_s waits after a step or a phase")))
    try:
        for variant in _variants(fault):
            found += [one for one in faults.wrong_in(variant, _KINDS) if one not in found]
    except ConfigError as error:
        found += [("fault", problem) for problem in error.problems]
    return found


def _parted(data: Mapping[str, Any]) -> tuple[dict[str, Any], dict[str, Any]]:
    """The keys of the trigger, and those of the fault."""
    when = {key: value for key, value in data.items() if key in TRIGGER}
    return when, {str(key): value for key, value in data.items() if key not in TRIGGER}


def verify(fault: Mapping[str, Any], world: World, robot: RobotDescription) -> None:
    """Check that what a fault names is there. Raises ConfigError with the nearest name."""
    if fault.get("fault") not in OWN:
        for variant in _variants(fault):
            world.verify(faults.parse(variant), robot)


def in_words(text: str) -> dict[str, Any]:
    """A fault as typed at a prompt: `shove strength_n_s=8 towards_deg=90`.

    Raises:
        ConfigError: if it cannot be meant.
    """
    name, *rest = text.split()
    fault: dict[str, Any] = {"fault": name}
    for word in rest:
        key, equals, value = word.partition("=")
        if not equals:
            raise ConfigError(f"{word!r} is no key=value")
        fault[key] = _value(value)
    problems = faults.wrong_in(fault, _KINDS)
    if problems:
        raise ConfigError([problem for _, problem in problems])
    return fault


def drawn(data: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """The same with `{uniform: [low, high]}` and `{choice: [...]}` replaced by draws."""

    def draw(how: str, values: list[Any]) -> Any:
        if how == "uniform":
            low, high = (float(value) for value in values)
            return round(float(rng.uniform(low, high)), 4)
        return values[int(rng.integers(len(values)))]

    return {key: _with(key, value, draw) for key, value in data.items()}


def _variants(data: Mapping[str, Any]) -> Iterator[dict[str, Any]]:
    """A fault with both ends of what is drawn evenly, and everything else that may be drawn."""
    counts = [1]

    def count(_how: str, values: list[Any]) -> Any:
        counts.append(len(values))
        return values[0]

    yield {key: _with(key, value, count) for key, value in data.items()}
    for number in range(1, max(counts)):

        def pick(_how: str, values: list[Any], number: int = number) -> Any:
            return values[number % len(values)]

        yield {key: _with(key, value, pick) for key, value in data.items()}


def _with(key: str, value: Any, choose: Callable[[str, list[Any]], Any]) -> Any:
    """A value, with what is to be drawn replaced by what is chosen. Raises ConfigError."""
    if isinstance(value, list):
        return [_with(key, item, choose) for item in cast("list[Any]", value)]
    if isinstance(value, dict) and len(cast("dict[str, Any]", value)) == 1:
        ((how, of),) = cast("dict[str, Any]", value).items()
        if how in DRAWS:
            return choose(how, _values(key, how, cast("object", of)))
    return cast(Any, value)


def _values(key: str, how: str, of: object) -> list[Any]:
    """What is drawn from. Raises ConfigError."""
    values = cast("list[Any]", of) if isinstance(of, list) else []
    numbers: list[float] = [value for value in values if isinstance(value, int | float)]
    fits = (
        len(values) == len(numbers) == 2 and abs(numbers[0]) < LONG_S and abs(numbers[1]) < LONG_S
        if how == "uniform"
        else 0 < len(values) <= MAX_CHOICES
    )
    if not fits:
        text = f"{key}: {how} takes a list to draw from, not {shown(cast('object', of))}"
        raise ConfigError([Problem(text, suggestion=DRAWS[how])])
    return values


def _value(text: str) -> Any:
    """A value of the prompt: JSON, or a word."""
    try:
        return plain_data.from_json(text)
    except ValueError:
        return text
