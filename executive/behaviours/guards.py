"""Leaves that end a task from above: after an emergency, or when waiting has not helped."""

from __future__ import annotations

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.behaviours.stage import Stage, failure_data
from executive.blackboard import ABORT, HEALTH, STOP, Writer
from robot.errors import Failure, failure

HOLD_LIMIT_S = 20.0
"""How long the robot may stand and wait in one task, all waits together."""


class EndTask(Behaviour):
    """Ends the task because a person or the robot's health wants it; RUNNING until it is gone."""

    def __init__(self, stage: Stage, guard: Writer) -> None:
        """Write as `guard`."""
        super().__init__("end the task")
        self._stage = stage
        self._guard = guard

    def update(self) -> Status:
        """Say why, once."""
        board = self._stage.board
        if board.read(ABORT) is None:
            asked = board.read(STOP)
            reason = failure("cancelled", asked) if asked else board.read(HEALTH).failure
            end_task(self._stage, self._guard, reason)
        return Status.RUNNING


class Hold(Behaviour):
    """Stands while something is missing; ends the task when that lasts too long."""

    def __init__(self, stage: Stage, guard: Writer, *, limit_s: float = HOLD_LIMIT_S) -> None:
        """Write as `guard`; `limit_s` bounds all holds until `reset`."""
        super().__init__("hold still")
        self._stage = stage
        self._guard = guard
        self._limit_s = limit_s
        self._left_s = limit_s
        self._last_s = 0.0

    def reset(self) -> None:
        """A new task has all the patience again."""
        self._left_s = self._limit_s

    def initialise(self) -> None:
        """Begin to wait."""
        self._last_s = self._stage.now_s
        worst = self._stage.board.read(HEALTH).failure
        self._stage.record("hold", why=worst.cause if worst else "")

    def update(self) -> Status:
        """Count the time."""
        now_s = self._stage.now_s
        self._left_s -= now_s - self._last_s
        self._last_s = now_s
        worst = self._stage.board.read(HEALTH).failure
        self.feedback_message = worst.cause if worst else ""
        if self._left_s < 0.0 and self._stage.board.read(ABORT) is None:
            end_task(self._stage, self._guard, worst)
        return Status.RUNNING


def end_task(stage: Stage, guard: Writer, reason: Failure | None) -> None:
    """Put on the board why the task ends."""
    reason = reason or failure("internal", "the task was ended without a reason")
    guard.set(ABORT, reason)
    stage.record("abort", **failure_data(reason))
