"""The executive: goals in, ticks at 20 Hz, an outcome out. The same in `fast` and in `live`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

import msgspec

from executive.behaviours.sense import Sense
from executive.behaviours.stage import Stage, failure_data
from executive.blackboard import GOAL, RECOVERIES, SAID, STOP, Blackboard
from executive.health import HealthMonitor
from executive.journal import Journal
from executive.skills import catalogue
from executive.skills.context import SkillContext
from executive.skills.parameters import SkillParams
from executive.skills.skill import Skill
from executive.trees.root import BuildTask, Tree
from robot.errors import Failure, failure

RATE_HZ = 20.0


class Outcome(msgspec.Struct, frozen=True, kw_only=True):
    """How a task ended: with a failure, or well. `took_s` is the runtime's time."""

    failure: Failure | None
    took_s: float
    recoveries: int


MakeSkill = Callable[[SkillParams, SkillContext], Skill]


class Executive:
    """One robot's executive: one tree, one task at a time."""

    def __init__(
        self,
        context: SkillContext,
        journal: Journal,
        *,
        rates_hz: Mapping[str, float],
        make: MakeSkill = catalogue.make,
    ) -> None:
        """Build the tree; nothing moves before a task is begun.

        Args:
            context: what every skill is given; its `say` is called with every spoken text too.
            journal: where events go.
            rates_hz: the promised rate of each topic, from which health is judged.
            make: makes a skill from its parameters.
        """
        self.board = Blackboard()
        self.journal = journal
        self._operator = self.board.claim("operator")
        self._voice = self.board.claim("voice")
        self._say_on = context.say
        self._context = replace(context, say=self._say)
        self._make = make
        self.stage = Stage(self.board, journal, self._make_skill)
        monitor = HealthMonitor(
            rates_hz,
            start_s=context.link.now_s(),
            motors=context.description.motor_names,
        )
        sense = Sense(self.stage, context.link, monitor, holdings=context.holdings)
        self.tree = Tree(self.stage, sense)
        self._begun_s: float | None = None
        self.outcome: Outcome | None = None

    def begin(self, build: BuildTask, *, text: str) -> None:
        """Start a task, in place of one that is under way; `text` is what was asked for."""
        self.outcome = None
        self._begun_s = None
        self._operator.set(STOP, "")
        self.stage.task.set(GOAL, text)
        self.tree.begin(build(self.stage))

    def tick(self, now_s: float) -> None:
        """Tick the tree; `outcome` is set when the task is over and the body at rest."""
        self.tree.tick(now_s)
        if self._begun_s is None:
            self._begun_s = now_s
        verdict = self.tree.verdict()
        if verdict is not None:
            self._finish(verdict if isinstance(verdict, Failure) else None, now_s)

    def stop(self, why: str) -> None:
        """Bring the robot to a stand and end the task with `cancelled`; takes several ticks."""
        self._operator.set(STOP, why)

    def abandon(self, reason: Failure | None, now_s: float) -> None:
        """End the task at once, without bringing anything to rest (None: as a person wants it)."""
        reason = reason or failure("cancelled", "stopped at once on request; the motors damp")
        self._finish(reason, now_s)

    def _finish(self, reason: Failure | None, now_s: float) -> None:
        took_s = round(now_s - (self._begun_s or 0.0), 4)
        recoveries = self.board.read(RECOVERIES)
        self.outcome = Outcome(failure=reason, took_s=took_s, recoveries=recoveries)
        self.tree.clear()
        ended = failure_data(reason) if reason else {"code": "done"}
        self.journal.write(now_s, "outcome", **ended, took_s=took_s, recoveries=recoveries)

    def _make_skill(self, params: SkillParams, attempt: int) -> Skill:
        """A skill; a retry plans with another seed."""
        context = replace(self._context, seed=self._context.seed + attempt)
        return self._make(params, context)

    def _say(self, text: str) -> None:
        self._voice.set(SAID, text)
        self.stage.record("said", text=text)
        self._say_on(text)
