"""Leaves that keep the robot still from above: an emergency, a sense that is silent, a pause."""

from __future__ import annotations

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.behaviours.stage import Stage, beginning_data, failure_data
from executive.blackboard import ABORT, HEALTH, PAUSE, PAUSED, RESTLESS, STOP, Writer
from robot.failures import Failure, failure

HOLD_LIMIT_S = 20.0
"""How long the robot may stand and wait in one task, all waits together."""
START_S = 1.0
"""How long it waits for its first messages also where nothing is to be recovered."""


class EndTask(Behaviour):
    """Ends all jobs because a person or the robot's health wants it; RUNNING while it does."""

    def __init__(self, stage: Stage, guard: Writer) -> None:
        """Write as `guard`."""
        super().__init__("end the jobs")
        self._stage = stage
        self._guard = guard
        self._asked = ""

    def initialise(self) -> None:
        """The robot has come to a stand, as far as it goes."""
        self._stage.task.set(RESTLESS, False)  # noqa: FBT003

    def update(self) -> Status:
        """Say why, once; a stop that is over gives way to what else is wrong."""
        board = self._stage.board
        asked = board.read(STOP)
        if board.read(ABORT) is None or asked != self._asked:
            self._asked = asked
            reason = failure("cancelled", asked) if asked else board.read(HEALTH).failure
            end_task(self._stage, self._guard, reason)
        return Status.RUNNING

    def terminate(self, new_status: Status) -> None:  # noqa: ARG002
        """What comes next is not ended."""
        self._guard.set(ABORT, None)


class Hold(Behaviour):
    """Stands while something is missing; ends the jobs when that lasts too long."""

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
        health = self._stage.board.read(HEALTH)
        why = health.failure.cause if health.failure else ""
        self._stage.record("hold", why=why, **beginning_data(health.beginning))

    def update(self) -> Status:
        """Count the time."""
        now_s = self._stage.now_s
        self._left_s -= now_s - self._last_s
        self._last_s = now_s
        worst = self._stage.board.read(HEALTH).failure
        self.feedback_message = worst.cause if worst else ""
        patience_s = 0.0 if self._stage.recovers else self._limit_s - START_S
        if self._left_s < patience_s and self._stage.board.read(ABORT) is None:
            end_task(self._stage, self._guard, worst)
        return Status.RUNNING

    def terminate(self, new_status: Status) -> None:  # noqa: ARG002
        """What comes next is not ended."""
        self._guard.set(ABORT, None)


class Rest(Behaviour):
    """Says that the robot stands, or stands paused; RUNNING until it is told to go on."""

    def __init__(self, stage: Stage, guard: Writer) -> None:
        """Write as `guard`."""
        super().__init__("paused")
        self._stage = stage
        self._guard = guard

    def initialise(self) -> None:
        """The body is at rest from here on."""
        self._stage.task.set(RESTLESS, False)  # noqa: FBT003
        if self._stage.board.read(PAUSE):
            self._guard.set(PAUSED, True)  # noqa: FBT003
            self._stage.record("paused")

    def update(self) -> Status:
        """Stay; a pause may have been asked for since."""
        if self._stage.board.read(PAUSE) and not self._stage.board.read(PAUSED):
            self.initialise()
        return Status.RUNNING

    def terminate(self, new_status: Status) -> None:  # noqa: ARG002
        """It moves again."""
        self._guard.set(PAUSED, False)  # noqa: FBT003


def end_task(stage: Stage, guard: Writer, reason: Failure | None) -> None:
    """Put on the board why the jobs end."""
    reason = reason or failure("internal", "the task was ended without a reason")
    guard.set(ABORT, reason)
    stage.record("abort", **failure_data(reason))
