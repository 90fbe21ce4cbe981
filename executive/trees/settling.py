"""The leaf that settles what a description means, between looks: see `parts.Settle`.

It stands in a sequence with memory and puts what comes next behind itself, as the rounds of a loop
do (`executive.trees.flow`)::

    which mug?              sequence with memory
      + which?              put the first look and the next question behind itself
      + look                ...
      > which?              the white mug: put what is done with it behind itself
      > bring the white mug
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from py_trees.behaviour import Behaviour
from py_trees.common import Status
from py_trees.composites import Composite

from executive.behaviours.stage import Stage
from executive.trees.parts import Settle
from robot.failures import Failure


class Settling(Behaviour):
    """Puts the next look behind itself, or what is done once it is settled."""

    def __init__(
        self,
        part: Settle,
        looks: Sequence[Behaviour],
        *,
        then: Callable[[tuple[str, ...]], Behaviour],
        stage: Stage,
        path: str,
    ) -> None:
        """Ask; `looks` are those still to be done, `then` builds what is done with the things."""
        super().__init__("which?")
        self._part, self._looks, self._then = part, tuple(looks), then
        self._stage, self._path = stage, path
        self._asked = False

    def update(self) -> Status:
        """Ask once."""
        if self._asked:
            return Status.SUCCESS
        open_yet = self._part.thorough and bool(self._looks)
        found = None if open_yet else self._part.question(self._stage.board)
        if isinstance(found, tuple):
            self._asked = True
            means = ",".join(found)
            self.feedback_message = means
            self._stage.record("settled", id=self._path, step=self._part.name, means=means)
            self._put_behind(self._then(found))
            return Status.SUCCESS
        if not self._looks:
            assert isinstance(found, Failure)
            self._stage.fail(found, step=self._part.name, step_id=self._path)
            self.feedback_message = found.cause
            return Status.FAILURE
        self._asked = True
        look, *left = self._looks
        following = Settling(self._part, left, then=self._then, stage=self._stage, path=self._path)
        self._put_behind(look, following)
        return Status.SUCCESS

    def _put_behind(self, *nodes: Behaviour) -> None:
        parent = self.parent
        if not isinstance(parent, Composite):
            raise TypeError("a settling stands in a sequence")
        parent.add_children(list(nodes))
