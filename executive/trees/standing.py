"""The last look at a task's work: by what is believed now, things are where it left them."""

from __future__ import annotations

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.behaviours.stage import Stage
from executive.trees.flow import PATIENCE_S
from executive.trees.parts import Kept
from robot.failures import failure


class IsAsLeft(Behaviour):
    """SUCCESS if what the job put down is believed to stand there, and what it took to be held."""

    def __init__(self, part: Kept, *, stage: Stage, path: str) -> None:
        """Compare what the job's scope says it did with the world model."""
        super().__init__(part.name)
        self._part, self._stage, self._path = part, stage, path
        self._begun_s = 0.0

    def initialise(self) -> None:
        """Begin to wait."""
        self._begun_s = self._stage.now_s

    def update(self) -> Status:
        """Ask, for at most `PATIENCE_S`."""
        scope = self._stage.scope
        gone = self._part.gone(self._stage.board, scope.put_down, scope.taken)
        if not gone:
            return Status.SUCCESS
        if self._stage.now_s - self._begun_s < PATIENCE_S:
            return Status.RUNNING
        cause = f"it was left so, and is so no more: {'; '.join(gone)}"
        reason = failure("not_as_expected", cause, suggestion="see where it is, and say it again")
        self.feedback_message = cause
        self._stage.fail(reason, step=self.name, step_id=self._path)
        return Status.FAILURE
