"""The whole tree: sense || come to rest || (emergency > recovery > task > idle).

Every tick senses first, then sees interrupted skills through, then does the first thing in the
order of urgency that applies. Recoveries of single steps live inside the task
(`executive.trees.recovery`); the recovery up here is the one of the robot as a whole: stand and
wait until its senses are back. A task that is interrupted by it goes on at the step where it was.
"""

from __future__ import annotations

from collections.abc import Callable

from py_trees.behaviour import Behaviour
from py_trees.behaviours import Running
from py_trees.common import OneShotPolicy, ParallelPolicy, Status
from py_trees.composites import Parallel, Selector
from py_trees.composites import Sequence as InOrder
from py_trees.decorators import FailureIsSuccess, OneShot

from executive.behaviours.conditions import Check, must_end, must_hold
from executive.behaviours.guards import EndTask, Hold
from executive.behaviours.run_skill import RunSkill
from executive.behaviours.sense import Sense, WindDown
from executive.behaviours.stage import Stage
from executive.blackboard import ABORT, FAILURE, RECOVERIES
from executive.skills.parameters import StopParams
from robot.errors import Failure, failure

REST_LIMIT_S = 15.0

BuildTask = Callable[[Stage], Behaviour]
"""Builds a task's subtree on a stage (`executive.trees.tasks`)."""


class Tree:
    """The root, with room for one task."""

    def __init__(self, stage: Stage, sense: Sense) -> None:
        """Build the tree without a task."""
        self._stage = stage
        self._sense = sense
        self._guard = stage.board.claim("guard")
        self._hold = Hold(stage, self._guard)
        board = stage.board
        rest = RunSkill("come to a stand", StopParams(), stage=stage, limit_s=REST_LIMIT_S)
        self._emergency = InOrder(
            "emergency",
            memory=True,
            children=[
                Check("has to end?", must_end, board=board),
                FailureIsSuccess("as far as it goes", rest),
                EndTask(stage, self._guard),
            ],
        )
        recovery = InOrder(
            "recovery",
            memory=False,
            children=[Check("has to wait?", must_hold, board=board), self._hold],
        )
        choices = [self._emergency, recovery, Running("idle")]
        self._act = Selector("act", memory=False, children=choices)
        self.root = Parallel(
            "robot",
            policy=ParallelPolicy.SuccessOnAll(synchronise=False),
            children=[sense, WindDown(stage), self._act],
        )
        self.task: Behaviour | None = None
        self.shown: Behaviour | None = None
        """The newest task, also when it is over: for people to look at."""

    def begin(self, task: Behaviour) -> None:
        """Put a task into the tree; one that is there is ended first."""
        self.clear()
        if self._emergency.status is Status.RUNNING:
            self._emergency.stop(Status.INVALID)
        self._hold.reset()
        self._guard.set(ABORT, None)
        self._stage.task.set(FAILURE, None)
        self._stage.task.set(RECOVERIES, 0)
        task = OneShot(task.name, task, policy=OneShotPolicy.ON_COMPLETION)
        self.task = self.shown = task
        self._act.insert_child(task, len(self._act.children) - 1)

    def clear(self) -> None:
        """Take the task out; what it was doing comes to rest in the next ticks."""
        if self.task is not None:
            if self.task.status is Status.RUNNING:
                self.task.stop(Status.INVALID)
            self._act.remove_child(self.task)
            self.task = None

    def tick(self, now_s: float) -> None:
        """Tick every node once."""
        self._sense.at(now_s)
        self.root.tick_once()

    def verdict(self) -> Failure | bool | None:
        """How the task ended: True, or a failure; None while it goes on or the body still moves."""
        if self.task is None or not self._stage.quiet:
            return None
        board = self._stage.board
        aborted = board.read(ABORT)
        if aborted is not None:
            return aborted
        if self.task.status is Status.SUCCESS:
            return True
        if self.task.status is Status.FAILURE:
            return board.read(FAILURE) or failure("internal", "the task failed without a reason")
        return None
