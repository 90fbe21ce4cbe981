"""What to do about a failure: one table from its code to remedies, and how often each may be tried.

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

So the tree shows what was tried. Remedies of a code are tried in their order, local before global,
a person's help last, and the tree can only grow as far as the budgets go: every remedy has its
number of times in a step, a step has `PER_STEP` whatever their codes. A job has `PER_TASK` to
spend, and each step that is done at the first try gives one back: a long mission that gets on does
not run out of them, one that does not get on ends.
"""

from __future__ import annotations

from collections import Counter

import msgspec
from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.behaviours.ask import AskForHelp
from executive.behaviours.run_skill import RunSkill
from executive.behaviours.stage import Stage
from executive.trees.idioms import Alternatives, in_order
from executive.trees.parts import Errand
from executive.trees.remedies import ASKING, HELP, REMEDIES, Remedy, is_idle, question
from robot.failures import Failure, failure

PER_STEP, PER_TASK = 6, 14
"""Recoveries of one step, and those that one task may spend, whatever their codes."""


class Rule(msgspec.Struct, frozen=True):
    """Remedies in the order in which they are tried, each with how often in one step."""

    tries: tuple[tuple[Remedy, int], ...] = ()

    @property
    def times(self) -> int:
        """How often something is done in one step."""
        return sum(times for _, times in self.tries)

    def next(self, reason: Failure, used: Counter[tuple[str, Remedy]]) -> tuple[Remedy, int] | None:
        """The remedy whose turn it is, and how often it may be tried; None when all are used up."""
        for remedy, times in self.tries:
            if used[reason.code, remedy] < times and not is_idle(remedy, reason):
                return remedy, times
        return None


def _first(**tries: int) -> Rule:
    """A rule out of remedies in their order: `_first(wait=2, ask=1)`."""
    return Rule(tuple((name, times) for name, times in tries.items()))  # pyright: ignore[reportArgumentType]


NONE = Rule()

RULES: dict[str, Rule] = {
    # words and goals: a person has to say something else
    "unknown_object": NONE,
    "unknown_place": NONE,
    "ambiguous": NONE,
    "unsupported": NONE,
    "invalid_goal": NONE,
    # planning
    "no_path": _first(wait=3, step_back=1, ask=1),
    "start_in_collision": _first(step_back=1, ask=1),
    "goal_in_collision": _first(look_again=1, wait=1, ask=1),
    "out_of_reach": _first(look_again=1, step_back=1, ask=1),
    "no_grasp": _first(look_again=1, ask=1),
    "no_stance": _first(retry=1, wait=1, ask=1),
    "no_free_spot": _first(wait=1, ask=1),
    "planner_timeout": _first(retry=2),
    # acting
    "path_blocked": _first(wait=3, step_back=1, ask=1),
    "walk_stalled": _first(retry=1, step_back=1, ask=1),
    "grasp_missed": _first(look_again=2, step_back=1, ask=1),
    "wrong_object": _first(look_again=2, ask=1),
    "object_dropped": _first(fetch_again=2, ask=1),
    "object_not_seen": _first(look_again=1, ask=1),
    "place_not_seen": _first(wait=1, ask=1),
    "not_made_out": _first(ask=1),
    "on_the_floor": _first(ask=1),
    "not_taken": _first(ask=1),
    "no_answer": NONE,  # they were asked twice
    "person_near": _first(wait=2, step_back=1, ask=1),
    "person_not_seen": _first(wait=1, ask=1),
    "not_holding": _first(fetch_again=1),
    "hands_full": _first(ask=1),
    "arm_stalled": _first(retry=1, step_back=1, ask=1),
    "place_missed": _first(fetch_again=1, ask=1),
    "lost_balance": _first(wait=1, get_up=1),
    # body and system
    "fallen": _first(get_up=1),
    "localisation_lost": _first(wait=2, ask=1),
    "camera_unplugged": NONE,  # nothing is done by pictures yet
    "camera_late": NONE,
    "camera_frozen": NONE,
    "camera_black": NONE,
    "sensor_silent": _first(wait=2, ask=1),
    "overheated": NONE,
    "motor_fault": NONE,
    "imu_fault": NONE,
    "battery_low": NONE,
    "emergency_stop": NONE,
    "overloaded": _first(wait=2),
    "controller_lost": _first(wait=1),
    "plant_lost": NONE,
    "timeout": _first(retry=1),
    "given_up": NONE,
    "not_as_expected": NONE,
    "cancelled": NONE,
    "internal": NONE,
}


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

    def __init__(
        self, errand: Errand, stage: Stage, used: Counter[tuple[str, Remedy]], *, path: str = ""
    ) -> None:
        """Recover from failures of `errand`; `used` counts by code what its step has used up."""
        super().__init__("recover")
        self._errand = errand
        self._path = path
        self._stage = stage
        self._used = used

    def update(self) -> Status:
        """Look the failure up."""
        reason = self._stage.scope.failure or failure("internal", "it failed without a reason")
        code = reason.code
        turn = RULES[code].next(reason, self._used)
        refused = self._refusal(code, turn is None)
        if turn is None or refused:
            self.feedback_message = refused
            if RULES[code].times:
                self._stage.record("no recovery", step=self._errand.name, code=code, why=refused)
            return Status.FAILURE
        remedy, times = turn
        self._used[code, remedy] += 1
        self._stage.count_recovery()
        name = REMEDIES[remedy][0]
        count = f"{self._used[code, remedy]} of {times}"
        self.feedback_message = f"{name} ({count})"
        self._stage.record("recovery", step=self._errand.name, code=code, remedy=name, count=count)
        self._put_behind(remedy, reason)
        return Status.FAILURE

    def _refusal(self, code: str, used_up: bool) -> str:
        """Why there is no remedy, or an empty text."""
        if not self._stage.recovers:
            return "recovery is switched off"
        if used_up:
            tried = RULES[code].times
            return f"tried {tried} times" if tried else f"nothing to be done about {code}"
        if self._used.total() >= PER_STEP:
            return f"{PER_STEP} recoveries in this step are enough"
        if self._stage.scope.spent >= PER_TASK:
            return f"{PER_TASK} recoveries in this task are enough"
        return ""

    def _put_behind(self, remedy: Remedy, reason: Failure) -> None:
        """Put the remedy with the next attempt, and the next choice, behind this node."""
        parent = self.parent
        if not isinstance(parent, Alternatives):
            raise TypeError("a recovery stands among alternatives")
        attempt = self._used.total()
        path = f"{self._path}+{attempt}"
        name, steps = REMEDIES[remedy]
        nodes: list[Behaviour] = [
            run(step, self._stage, attempt=attempt, path=f"{path}.{number}")
            for number, step in enumerate(steps(self._errand, reason), 1)
        ]
        if remedy in ASKING:
            asked = question(reason, self._errand)
            nodes.insert(0, AskForHelp(asked, stage=self._stage, step_id=path))
        nodes.append(run(self._errand, self._stage, attempt=attempt, path=path))
        following = Recover(self._errand, self._stage, self._used, path=self._path)
        parent.extend(self, [in_order(name, nodes), following])


def unasked() -> list[str]:
    """Codes for which help is asked without a question to ask; there must be none."""
    asking = [code for code, rule in RULES.items() if any(r in ASKING for r, _ in rule.tries)]
    return [code for code in asking if code not in HELP]
