"""Faults on purpose, as plans: what is to go wrong, and when.

A plan is one flat entry of a list: the keys of its trigger and the fault with its own keys::

    -{phase: "lifting*", fault: push, target: red_cup, impulse_n_s: [0, 0, -6]}
    -{step: "go to*", after_s: 1.5, fault: stand_in_way, target: anna, duration_s: 6}
    -{at_s: 5, times: 2, fault: silence, topic: lidar, duration_s: 3}

Most faults happen to the world (`robot.reality.faults`), some to this software (`OWN`). In an
evaluation a number may be drawn for each seed: ``towards_deg: {uniform: [-180, 180]}``.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, cast

import msgspec
import numpy as np

from robot import misfits
from robot import quantities as q
from robot.config import nearest
from robot.errors import ConfigError, Problem
from robot.model.description import RobotDescription
from robot.reality import faults
from robot.reality.contract import World

OWN: dict[str, dict[str, Any]] = {
    "fill_disk": {"duration_s": q.Span},
    "slow_planner": {"requests": q.Times},
    "kill_executive": {},
}
"""Faults of this software: name to keys with their types. All of them may be left out."""

TRIGGER = ("at_s", "step", "phase", "after_s", "times")


class FaultPlan(msgspec.Struct, frozen=True, kw_only=True):
    """A fault and its trigger: a time of the run, the beginning of a step or of a phase.

    Attributes:
        fault: as plain data, its name under `fault`.
        at_s: time since the run began (without `step` and `phase`; 0 by default).
        step: pattern (`pick*`) on a step's name or id.
        phase: pattern on what the skill says it is doing.
        after_s: how long after the trigger.
        times: how often at most; a trigger that comes again strikes again.
    """

    fault: dict[str, Any]
    at_s: q.Moment = 0.0
    step: str = ""
    phase: str = ""
    after_s: q.Moment = 0.0
    times: q.Times = 1


def names() -> list[str]:
    """Every fault there is."""
    return sorted([*faults.KINDS, *OWN])


def plan(data: Mapping[str, Any]) -> FaultPlan:
    """A fault with its trigger out of one flat mapping.

    Raises:
        ConfigError: if it cannot be meant, with the nearest valid name.
    """
    when = {key: value for key, value in data.items() if key in TRIGGER}
    fault = {str(key): value for key, value in data.items() if key not in TRIGGER}
    _parse(drawn(fault, np.random.default_rng(0)))
    wrong = list(misfits.misfits({**when, "fault": fault}, FaultPlan))
    if wrong:
        head = f"the trigger of the fault {fault['fault']!r}"
        raise ConfigError([Problem(f"{head}: {one.message}") for one in wrong])
    made = msgspec.convert({**when, "fault": fault}, FaultPlan)
    if "at_s" in when and (made.step or made.phase):
        raise ConfigError("a trigger has either at_s, or step and phase")
    return made


def verify(fault: Mapping[str, Any], world: World, robot: RobotDescription) -> None:
    """Check that what a fault names is there. Raises ConfigError with the nearest name."""
    if fault.get("fault") not in OWN:
        world.verify(faults.parse(drawn(dict(fault), np.random.default_rng(0))), robot)


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
    _parse(fault)
    return fault


def drawn(data: dict[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    """The same with `{uniform: [low, high]}` and `{choice: [...]}` replaced by draws."""
    return {key: _draw(value, rng) for key, value in data.items()}


def _parse(fault: dict[str, Any]) -> None:
    """Check a fault. Raises ConfigError."""
    name = str(fault.get("fault", ""))
    if name not in OWN:
        if name not in faults.KINDS:
            hint = nearest(name, names())
            raise ConfigError([Problem(f"unknown fault {name!r}", suggestion=hint)])
        faults.parse(fault)
        return
    for key, value in fault.items():
        kind = OWN[name].get(key)
        if key != "fault" and kind is None:
            hint = nearest(key, list(OWN[name]))
            raise ConfigError([Problem(f"unknown key {key!r} of {name!r}", suggestion=hint)])
        for wrong in misfits.misfits({key: value}, dict[str, kind]) if kind is not None else ():
            raise ConfigError(f"the fault {name!r}: {wrong.message}")


def _draw(value: Any, rng: np.random.Generator) -> Any:
    if isinstance(value, list):
        return [_draw(item, rng) for item in cast("list[Any]", value)]
    if isinstance(value, dict) and len(cast("dict[str, Any]", value)) == 1:
        ((how, of),) = cast("dict[str, Any]", value).items()
        if how in ("uniform", "choice"):
            return _draw_from(how, of, rng)
    return cast(Any, value)


def _draw_from(how: str, of: Any, rng: np.random.Generator) -> Any:
    try:
        values = msgspec.convert(of, list[float] if how == "uniform" else list[Any])
        if how == "uniform":
            low, high = values
            return round(float(rng.uniform(low, high)), 4)
        return values[int(rng.integers(len(values)))]
    except (msgspec.ValidationError, ValueError):
        raise ConfigError(f"{how} takes a list to draw from, not {of!r}") from None


def _value(text: str) -> Any:
    """A value of the prompt: JSON, or a word."""
    try:
        return msgspec.json.decode(text)
    except msgspec.DecodeError:
        return text
