"""The whole tree: sense || come to rest || (emergency > pause > recovery > jobs > idle).

Every tick senses first, then sees interrupted skills through, then does the first thing in the
order of urgency that applies. Recoveries of single steps live inside the jobs
(`executive.trees.recovery`); the recovery up here is the one of the robot as a whole: stand and
wait until its senses are back. Jobs that are interrupted go on at the step where they were.
"""

from __future__ import annotations

from collections.abc import Callable

from py_trees.behaviour import Behaviour
from py_trees.behaviours import Running
from py_trees.common import ParallelPolicy
from py_trees.composites import Parallel, Selector
from py_trees.composites import Sequence as InOrder
from py_trees.decorators import FailureIsSuccess

from executive.behaviours.conditions import Check, Predicate, must_end, must_hold, must_pause
from executive.behaviours.guards import EndTask, Hold, Rest
from executive.behaviours.run_skill import RunSkill
from executive.behaviours.sense import Sense, WindDown
from executive.behaviours.stage import Stage
from executive.skills.parameters import StopParams
from executive.trees.jobs import Jobs

REST_LIMIT_S = 15.0

BuildTask = Callable[[Stage], Behaviour]
"""Builds a task's subtree on a stage (`executive.trees.tasks`)."""


class Tree:
    """The root, with room for jobs."""

    def __init__(self, stage: Stage, sense: Sense) -> None:
        """Build the tree without a job."""
        self._stage = stage
        self._sense = sense
        guard = stage.board.claim("guard")
        self.hold = Hold(stage, guard)
        self.jobs = Jobs(stage)
        recovery = InOrder(
            "recovery",
            memory=False,
            children=[Check("has to wait?", must_hold, board=stage.board), self.hold],
        )
        choices = [
            self._stand_and("emergency", "has to end?", must_end, EndTask(stage, guard)),
            self._stand_and("pause", "is to pause?", must_pause, Rest(stage, guard)),
            recovery,
            self.jobs,
            Running("idle"),
        ]
        act = Selector("act", memory=False, children=choices)
        self.root = Parallel(
            "robot",
            policy=ParallelPolicy.SuccessOnAll(synchronise=False),
            children=[sense, WindDown(stage), act],
        )

    def _stand_and(
        self, name: str, question: str, predicate: Predicate, last: Behaviour
    ) -> Behaviour:
        """While the answer is yes: come to a stand once, then stay in the last leaf."""
        stand = RunSkill("come to a stand", StopParams(), stage=self._stage, limit_s=REST_LIMIT_S)
        steps = [FailureIsSuccess("as far as it goes", stand), last]
        check = Check(question, predicate, board=self._stage.board)
        then = InOrder("stand", memory=True, children=steps)
        return InOrder(name, memory=False, children=[check, then])

    @property
    def shown(self) -> Behaviour | None:
        """The newest job's part, also when it is over: for people to look at."""
        return self.jobs.children[-1] if self.jobs.children else None

    def at(self, now_s: float) -> None:
        """Set the time of the tick that comes."""
        self._sense.at(now_s)

    def tick(self) -> None:
        """Tick every node once."""
        self.root.tick_once()
