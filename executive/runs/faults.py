"""Faults on purpose: strikes with what was planned when its time has come."""

from __future__ import annotations

import math
import os
import signal
from collections.abc import Callable
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from executive.journal.journal import FILE as JOURNAL
from executive.journal.journal import Event, Journal
from executive.missions.fault_plans import FaultPlan, drawn
from robot.errors import ConfigError
from robot.failures import Failure, failure
from robot.planning.requests import PlanRequest, PlanResult
from robot.planning.worker import Planner
from robot.reality.faults import Fault, parse

PLANNER_BUDGET_S = 2.0

FULL = "/dev/full"


class Injects(Protocol):
    """A runtime that can suffer faults."""

    def inject(self, fault: Fault) -> None:
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
                self._runtime.inject(parse(fault))

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
