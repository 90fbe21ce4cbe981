"""Faults on purpose: what goes wrong, and when; for missions, the prompt, and evaluations.

A plan is one flat entry of a list: the keys of its trigger and the fault with its own keys::

    -{phase: "lifting*", fault: push, target: red_cup, impulse_n_s: [0, 0, -6]}
    -{step: "go to*", after_s: 1.5, fault: stand_in_way, target: anna, duration_s: 6}
    -{at_s: 5, times: 2, fault: silence, topic: lidar, duration_s: 3}

Most faults happen to the simulated world (`sim.faults`), some to this software (`OWN`). In an
evaluation a number may be drawn for each seed: ``towards_deg: {uniform: [-180, 180]}``.
"""

from __future__ import annotations

import math
import os
import signal
from collections.abc import Callable, Mapping
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any, Protocol, cast, runtime_checkable

import msgspec
import numpy as np

from executive.journal import FILE as JOURNAL
from executive.journal import Event, Journal
from robot.bringup import entry
from robot.config import nearest
from robot.errors import ConfigError, Failure, Problem, failure
from robot.planning.requests import PlanRequest, PlanResult
from robot.planning.worker import Planner

PARSE, VERIFY, KINDS = "sim.faults:parse", "sim.faults:verify", "sim.faults:KINDS"
OWN: dict[str, dict[str, type]] = {
    "fill_disk": {"duration_s": float},
    "slow_planner": {"requests": int},
    "kill_executive": {},
}
"""Faults of this software: name to keys. All of them may be left out."""
TRIGGER = ("at_s", "step", "phase", "after_s", "times")
PLANNER_BUDGET_S = 2.0
FULL = "/dev/full"


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
    at_s: float = 0.0
    step: str = ""
    phase: str = ""
    after_s: float = 0.0
    times: int = 1


def names() -> list[str]:
    """Every fault there is."""
    return sorted([*entry.attribute(KINDS), *OWN])


def plan(data: Mapping[str, Any]) -> FaultPlan:
    """A fault with its trigger out of one flat mapping.

    Raises:
        ConfigError: if it cannot be meant, with the nearest valid name.
    """
    when = {key: value for key, value in data.items() if key in TRIGGER}
    fault = {str(key): value for key, value in data.items() if key not in TRIGGER}
    _parse(drawn(fault, np.random.default_rng(0)))
    try:
        made = msgspec.convert({**when, "fault": fault}, FaultPlan)
    except msgspec.ValidationError as error:
        raise ConfigError(f"the trigger of the fault {fault['fault']!r}: {error}") from None
    if made.times < 1 or made.after_s < 0.0 or made.at_s < 0.0:
        raise ConfigError("a trigger has times from 1, and at_s and after_s from 0")
    if "at_s" in when and (made.step or made.phase):
        raise ConfigError("a trigger has either at_s, or step and phase")
    return made


def verify(fault: Mapping[str, Any], world: Any, robot: Any) -> None:
    """Check that what a fault names is there. Raises ConfigError with the nearest name."""
    if fault.get("fault") not in OWN:
        entry.attribute(VERIFY)(drawn(dict(fault), np.random.default_rng(0)), world, robot)


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


@runtime_checkable
class Injects(Protocol):
    """A runtime that can suffer faults."""

    def inject(self, fault: Mapping[str, Any]) -> None:
        """Make a fault happen now."""
        ...


class Injector:
    """Strikes when the time has come; call `tick` after every tick of the executive.

    Attributes:
        struck: what has happened so far.
    """

    def __init__(
        self,
        plans: tuple[FaultPlan, ...],
        runtime: Injects,
        journal: Journal,
        *,
        begin_s: float,
        seed: int = 0,
        planner: SlowPlanner | None = None,
        kill: Callable[[], None] | None = None,
    ) -> None:
        """Listen to the journal.

        Args:
            plans: what is to happen.
            runtime: of the run.
            journal: of the run; every fault is written into it.
            begin_s: when the run began, by the runtime's clock.
            seed: of what is drawn.
            planner: the run's planner, if it is to be slow.
            kill: ends the executive; by default a signal that no process survives.
        """
        self.struck: list[dict[str, Any]] = []
        self._runtime, self._journal, self._planner = runtime, journal, planner
        self._kill = kill or _suicide
        self._rng = np.random.default_rng([seed, 0xFA17])
        self._left = [plan.times for plan in plans]
        self._plans = plans
        self._due: list[tuple[float, dict[str, Any]]] = []
        self._undo: list[tuple[float, Callable[[], None]]] = []
        for index, one in enumerate(plans):
            if not one.step and not one.phase:
                self._arm(index, begin_s + one.at_s)
        journal.listen(self._heard)

    def tick(self, now_s: float) -> None:
        """Let happen what is due. Raises ConfigError if a fault names what is not there."""
        due = [fault for due_s, fault in self._due if due_s <= now_s]
        self._due = [(due_s, fault) for due_s, fault in self._due if due_s > now_s]
        for fault in due:
            self.strike(fault, now_s)
        over = [undo for until_s, undo in self._undo if until_s <= now_s]
        self._undo = [(until_s, undo) for until_s, undo in self._undo if until_s > now_s]
        for undo in over:
            undo()

    def strike(self, fault: dict[str, Any], now_s: float) -> None:
        """Let a fault happen now. Raises ConfigError as `tick` does."""
        self._journal.write(now_s, "fault", **fault)
        self.struck.append(fault)
        match fault["fault"]:
            case "fill_disk":
                self._fill_disk(now_s + float(fault.get("duration_s", math.inf)))
            case "slow_planner" if self._planner is not None:
                self._planner.slow = int(fault.get("requests", 1))
            case "slow_planner":
                raise ConfigError("the planner of this run cannot be made slow")
            case "kill_executive":
                self._kill()
            case _:
                self._runtime.inject(fault)

    def close(self) -> None:
        """Undo what lasts; safe to call twice."""
        for _, undo in self._undo:
            undo()
        self._undo.clear()

    def _heard(self, event: Event) -> None:
        if event.event not in ("step", "phase"):
            return
        for index, one in enumerate(self._plans):
            if self._left[index] and _strikes(one, event):
                self._arm(index, event.t_s + one.after_s)

    def _arm(self, index: int, due_s: float) -> None:
        self._left[index] -= 1
        self._due.append((due_s, drawn(self._plans[index].fault, self._rng)))

    def _fill_disk(self, until_s: float) -> None:
        """Put the journal's open file on a device that is always full (Linux)."""
        full = os.open(FULL, os.O_WRONLY)
        for number in [number for number, path in _open_files() if path.name == JOURNAL]:
            self._undo.append((until_s, _restoring(os.dup(number), number)))
            os.dup2(full, number)
        os.close(full)


class SlowPlanner:
    """A planner that can be made to use up its budget on the next `slow` requests."""

    def __init__(self, planner: Planner) -> None:
        """Pass on to `planner` what is not to fail."""
        self.slow = 0
        self._planner = planner
        self._late: dict[int, float] = {}
        self._last = 0

    def submit(self, request: PlanRequest, *, now_s: float) -> int:
        """Pass on, or let the budget run out."""
        if not self.slow:
            return self._planner.submit(request, now_s=now_s)
        self.slow -= 1
        self._last -= 1
        self._late[self._last] = now_s + PLANNER_BUDGET_S
        return self._last

    def poll(self, ticket: int, *, now_s: float) -> PlanResult | None:
        """Pass on, or fail when the budget has run out."""
        if ticket not in self._late:
            return self._planner.poll(ticket, now_s=now_s)
        if now_s < self._late[ticket]:
            return None
        del self._late[ticket]
        return _over_budget()

    def cancel(self, ticket: int) -> None:
        """Pass on."""
        if self._late.pop(ticket, None) is None:
            self._planner.cancel(ticket)


def _over_budget() -> Failure:
    text = f"the planner has used up its {PLANNER_BUDGET_S:g} s"
    return failure("planner_timeout", text, budget_s=PLANNER_BUDGET_S)


def _strikes(plan: FaultPlan, event: Event) -> bool:
    """Whether an event is a plan's trigger."""
    if (event.event == "phase") != bool(plan.phase):
        return False
    named = (str(event.data.get("step", "")), str(event.data.get("id", "")))
    if plan.step and not any(fnmatchcase(name, plan.step) for name in named):
        return False
    return not plan.phase or fnmatchcase(str(event.data["phase"]), plan.phase)


def _parse(fault: dict[str, Any]) -> None:
    """Check a fault. Raises ConfigError."""
    name = str(fault.get("fault", ""))
    if name not in OWN:
        if name not in entry.attribute(KINDS):
            hint = nearest(name, names())
            raise ConfigError([Problem(f"unknown fault {name!r}", suggestion=hint)])
        entry.attribute(PARSE)(fault)
        return
    for key, value in fault.items():
        kind = OWN[name].get(key)
        if key != "fault" and kind is None:
            hint = nearest(key, list(OWN[name]))
            raise ConfigError([Problem(f"unknown key {key!r} of {name!r}", suggestion=hint)])
        if kind is not None and not isinstance(value, int | kind):
            raise ConfigError(f"{key} of {name!r} is a number, not {value!r}")


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


def _open_files() -> list[tuple[int, Path]]:
    """Number and path of every file that this process has open (Linux)."""
    found: list[tuple[int, Path]] = []
    for link in Path("/proc/self/fd").iterdir():
        try:
            found.append((int(link.name), link.readlink()))
        except OSError:
            continue  # the listing's own
    return found


def _restoring(saved: int, number: int) -> Callable[[], None]:
    def undo() -> None:
        os.dup2(saved, number)
        os.close(saved)

    return undo


def _suicide() -> None:
    os.kill(os.getpid(), signal.SIGKILL)
