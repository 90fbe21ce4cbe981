"""The contract of a skill: one thing the body can be asked to do, step by step.

A skill talks to the body through `robot.link.BodyLink`, to planners through
`robot.planning.worker.Planner`, and to nothing else: no blackboard, no py_trees, no other skill.
"""

from __future__ import annotations

from typing import Literal, Protocol, runtime_checkable

import msgspec

from executive.skills.parameters import SkillParams
from robot.failures import Failure

Resource = Literal["legs", "left_arm", "right_arm", "head", "voice"]
BODY: frozenset[Resource] = frozenset({"legs", "left_arm", "right_arm", "head"})
"""What a job needs unless it says less: all but the voice."""


class SkillReport(msgspec.Struct, frozen=True, kw_only=True):
    """Where a skill stands after a step.

    Attributes:
        status: "running" until it ends.
        phase: what it is doing, a few words for people ("walking to the table").
        progress: 0 to 1, as far as it can tell.
        failure: why it failed; set exactly when status is "failed".
    """

    status: Literal["running", "succeeded", "failed"]
    phase: str = ""
    progress: float = 0.0
    failure: Failure | None = None


class Skill(Protocol):
    """One skill in action. Made for one goal, used once."""

    resources: frozenset[Resource]

    def start(self, now_s: float) -> None:
        """Begin. Returns at once; failures show in the first report."""
        ...

    def step(self, now_s: float) -> SkillReport:
        """Go on; called at the executive's rate, returns within 2 ms, never sleeps."""
        ...

    def stop(self, now_s: float) -> SkillReport:
        """Bring the body to rest; call until the report is no longer running. May be repeated."""
        ...


@runtime_checkable
class Lasting(Protocol):
    """A skill that knows how long it may take; the others have one limit for all."""

    def limit_s(self) -> float:
        """The longest it may take where it is, interruptions left out [s]."""
        ...


@runtime_checkable
class Resumable(Protocol):
    """A skill that, interrupted, knows what is left of it; the others are begun again."""

    def remaining(self) -> SkillParams | None:
        """What a new skill has to do to go on where this one is now; None: all of it is done."""
        ...
