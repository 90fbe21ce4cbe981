"""The last look at a task's work: what it put down has to stand there by what is believed now."""

from __future__ import annotations

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from executive.behaviours.stage import Stage
from executive.trees.flow import PATIENCE_S
from executive.trees.parts import Kept
from robot.failures import failure


class StandsAsPut(Behaviour):
    """SUCCESS if everything that the job put down is believed to stand where it was put."""

    def __init__(self, part: Kept, *, stage: Stage, path: str) -> None:
        """Compare what the job's scope says was put down with the world model."""
        super().__init__(part.name)
        self._part, self._stage, self._path = part, stage, path
        self._begun_s = 0.0

    def initialise(self) -> None:
        """Begin to wait."""
        self._begun_s = self._stage.now_s

    def update(self) -> Status:
        """Ask, for at most `PATIENCE_S`."""
        gone = self._part.gone(self._stage.board, self._stage.scope.put_down)
        if not gone:
            return Status.SUCCESS
        if self._stage.now_s - self._begun_s < PATIENCE_S:
            return Status.RUNNING
        cause = f"it was put down, and does not stand there any more: {'; '.join(gone)}"
        reason = failure("not_as_expected", cause, suggestion="see where it is, and say it again")
        self.feedback_message = cause
        self._stage.fail(reason, step=self.name, step_id=self._path)
        return Status.FAILURE
