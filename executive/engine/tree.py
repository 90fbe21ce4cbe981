"""The whole tree: sense || come to rest || (emergency > pause > return > recovery > jobs > idle).

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

from executive.behaviours.conditions import (
    Check,
    Predicate,
    must_end,
    must_hold,
    must_pause,
    must_return,
)
from executive.behaviours.guards import EndTask, Hold, Rest
from executive.behaviours.run_skill import RunSkill
from executive.behaviours.stage import Stage
from executive.blackboard import HOME, Blackboard
from executive.engine.job_tree import Jobs
from executive.engine.sense import Sense, WindDown
from executive.skills.navigate import FloorPose, NavigateParams
from executive.skills.stop import StopParams
from robot.failures import Failure, failure

REST_LIMIT_S = 15.0

BuildTask = Callable[[Stage], Behaviour]
"""Builds a task's subtree on a stage (`executive.meaning.tasks`)."""


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
            self._go_home_and(EndTask(stage, guard)),
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
        check = Check(question, predicate, board=self._stage.board)
        return InOrder(name, memory=False, children=[check, _then("stand", stand, last)])

    def _go_home_and(self, last: Behaviour) -> Behaviour:
        """While there are jobs and the robot had better go back: do, then stay in the last leaf."""
        home = RunSkill("go back to where it began", _home, stage=self._stage)

        def predicate(board: Blackboard) -> bool:
            return must_return(board) and bool(self.jobs.works)

        check = Check("has to go back?", predicate, board=self._stage.board)
        return InOrder("return", memory=False, children=[check, _then("go back", home, last)])

    def at(self, now_s: float) -> None:
        """Set the time of the tick that comes."""
        self._sense.at(now_s)

    def tick(self) -> None:
        """Tick every node once."""
        self.root.tick_once()


def _then(name: str, leaf: Behaviour, last: Behaviour) -> Behaviour:
    """A leaf to its end, whatever that is, then the last one."""
    steps = [FailureIsSuccess("as far as it goes", leaf), last]
    return InOrder(name, memory=True, children=steps)


def _home(board: Blackboard) -> NavigateParams | Failure:
    """To where the robot began."""
    X_WS = board.read(HOME)
    if X_WS is None:
        return failure("localisation_lost", "it is not known where the robot began")
    pose = FloorPose(x_m=X_WS.p[0], y_m=X_WS.p[1], yaw_rad=X_WS.yaw_rad)
    return NavigateParams(pose=pose)
