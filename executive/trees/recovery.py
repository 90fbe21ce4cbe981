"""What to do about a failure: one table from its code to a remedy, and how often it may be tried.

A step that can fail is a selector with memory. Its first child is the step, its second the choice
of a remedy, which looks the failure's code up and puts the remedy, the step again and the next
choice behind itself::

    pick the red cup          selector
      x pick the red cup      failed: grasp_missed
      x recover               look again, 1 of 2
      > look again, then retry
        + look for the red cup
        > pick the red cup    attempt 2
        recover

So the tree shows what was tried, and it can only grow as far as the budgets go.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from typing import Literal

import msgspec
from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.behaviours.run_skill import RunSkill
from executive.behaviours.stage import Stage
from executive.skills.parameters import (
    BalanceParams,
    NavigateParams,
    PickParams,
    SearchParams,
    Step,
)
from executive.trees.idioms import Alternatives, in_order
from executive.trees.parts import Errand

PER_STEP, PER_TASK = 4, 12
"""Recoveries of one step, and of one task, whatever their codes."""

Remedy = Literal["none", "retry", "wait", "look_again", "fetch_again", "step_back"]


class Rule(msgspec.Struct, frozen=True, kw_only=True):
    """What to do about a failure, and how often in one step."""

    remedy: Remedy
    times: int = 0


NONE = Rule(remedy="none")

RULES: dict[str, Rule] = {
    # words and goals: a person has to say something else
    "unknown_object": NONE,
    "unknown_place": NONE,
    "ambiguous": NONE,
    "unsupported": NONE,
    "invalid_goal": NONE,
    # planning
    "no_path": Rule(remedy="wait", times=2),
    "start_in_collision": Rule(remedy="step_back", times=1),
    "goal_in_collision": Rule(remedy="wait", times=1),
    "out_of_reach": Rule(remedy="step_back", times=2),
    "no_grasp": Rule(remedy="retry", times=1),
    "no_stance": Rule(remedy="retry", times=1),
    "no_free_spot": NONE,
    "planner_timeout": Rule(remedy="retry", times=2),
    # acting
    "path_blocked": Rule(remedy="wait", times=3),
    "walk_stalled": Rule(remedy="step_back", times=2),
    "grasp_missed": Rule(remedy="look_again", times=2),
    "object_dropped": Rule(remedy="fetch_again", times=2),
    "object_not_seen": Rule(remedy="look_again", times=1),
    "on_the_floor": NONE,
    "not_taken": NONE,
    "person_near": Rule(remedy="wait", times=3),
    "person_not_seen": Rule(remedy="wait", times=1),
    "not_holding": Rule(remedy="fetch_again", times=1),
    "hands_full": NONE,
    "arm_stalled": Rule(remedy="step_back", times=1),
    "place_missed": Rule(remedy="fetch_again", times=1),
    "lost_balance": Rule(remedy="wait", times=1),
    # body and system
    "fallen": NONE,
    "localisation_lost": Rule(remedy="wait", times=2),
    "sensor_silent": Rule(remedy="wait", times=2),
    "overheated": NONE,
    "battery_low": NONE,
    "emergency_stop": NONE,
    "overloaded": Rule(remedy="wait", times=2),
    "controller_lost": NONE,
    "plant_lost": NONE,
    "timeout": Rule(remedy="retry", times=1),
    "given_up": NONE,
    "not_as_expected": NONE,
    "cancelled": NONE,
    "internal": NONE,
}


def _retry(_errand: Errand) -> tuple[Errand, ...]:
    return ()


def _wait(_errand: Errand) -> tuple[Errand, ...]:
    params = BalanceParams(mode="stand", duration_s=3.0)
    return (Errand(name="stand and wait", params=params),)


def _step_back(errand: Errand) -> tuple[Errand, ...]:
    params = NavigateParams(by=Step(forward_m=-0.3))
    return (Errand(name="step back", params=params), *_look_again(errand))


def _look_again(errand: Errand) -> tuple[Errand, ...]:
    if errand.object_id is None or errand.carries:
        return ()
    params = SearchParams(object_id=errand.object_id)
    return (Errand(name=f"look for {errand.object_name}", params=params),)


def _fetch_again(errand: Errand) -> tuple[Errand, ...]:
    if errand.object_id is None or not errand.carries:
        return _look_again(errand)
    search = SearchParams(object_id=errand.object_id)
    pick = PickParams(object_id=errand.object_id)
    return (
        Errand(name=f"look for {errand.object_name}", params=search),
        Errand(name=f"pick up {errand.object_name} again", params=pick),
    )


REMEDIES: dict[Remedy, tuple[str, Callable[[Errand], tuple[Errand, ...]]]] = {
    "retry": ("try again", _retry),
    "wait": ("wait, then try again", _wait),
    "look_again": ("look again, then retry", _look_again),
    "fetch_again": ("fetch it again, then retry", _fetch_again),
    "step_back": ("step back, then retry", _step_back),
}
"""Remedy to its name for people and the steps that come before the next attempt."""


def resilient(errand: Errand, stage: Stage, *, path: str = "") -> Behaviour:
    """A step with its recoveries; `path` is the step's in its task (`executive.trees.parts`)."""
    node = Alternatives(errand.name, run(errand, stage, path=path))
    node.add_child(Recover(errand, stage, Counter(), path=path))
    return node


def run(errand: Errand, stage: Stage, *, attempt: int = 0, path: str = "") -> RunSkill:
    """The leaf of a step."""
    return RunSkill(errand.name, errand.params, stage=stage, attempt=attempt, step_id=path)


class Recover(Behaviour):
    """Chooses a remedy and puts it behind itself; always FAILURE, so that the selector goes on."""

    def __init__(self, errand: Errand, stage: Stage, used: Counter[str], *, path: str = "") -> None:
        """Recover from failures of `errand`; `used` counts by code what its step has used up."""
        super().__init__("recover")
        self._errand = errand
        self._path = path
        self._stage = stage
        self._used = used

    def update(self) -> Status:
        """Look the failure up."""
        reason = self._stage.scope.failure
        code = reason.code if reason else "internal"
        rule = RULES[code]
        refused = self._refusal(code, rule)
        if refused:
            self.feedback_message = refused
            if rule.times:
                self._stage.record("no recovery", step=self._errand.name, code=code, why=refused)
            return Status.FAILURE
        self._used[code] += 1
        self._stage.count_recovery()
        name, steps = REMEDIES[rule.remedy]
        count = f"{self._used[code]} of {rule.times}"
        self.feedback_message = f"{name} ({count})"
        self._stage.record("recovery", step=self._errand.name, code=code, remedy=name, count=count)
        self._put_behind(name, steps(self._errand))
        return Status.FAILURE

    def _refusal(self, code: str, rule: Rule) -> str:
        """Why there is no remedy, or an empty text."""
        if not self._stage.recovers:
            return "recovery is switched off"
        if rule.remedy == "none":
            return f"nothing to be done about {code}"
        if self._used[code] >= rule.times:
            return f"tried {rule.times} times"
        if self._used.total() >= PER_STEP:
            return f"{PER_STEP} recoveries in this step are enough"
        if self._stage.scope.recoveries >= PER_TASK:
            return f"{PER_TASK} recoveries in this task are enough"
        return ""

    def _put_behind(self, name: str, steps: tuple[Errand, ...]) -> None:
        """Put the remedy with the next attempt, and the next choice, behind this node."""
        parent = self.parent
        if not isinstance(parent, Alternatives):
            raise TypeError("a recovery stands among alternatives")
        attempt = self._used.total()
        path = f"{self._path}+{attempt}"
        again = run(self._errand, self._stage, attempt=attempt, path=path)
        first = [
            run(step, self._stage, attempt=attempt, path=f"{path}.{number}")
            for number, step in enumerate(steps, 1)
        ]
        remedy = in_order(name, [*first, again])
        following = Recover(self._errand, self._stage, self._used, path=self._path)
        parent.extend(self, [remedy, following])
