"""Leaves that steer a task: rounds, further attempts, deadlines, what to do about a failure.

Rounds and attempts are built when their turn comes. Their leaf stands in a composite with memory
and puts what comes next behind itself, as recoveries do (`executive.trees.recovery`)::

    3 times           sequence with memory
      + round?        put round 1 and the next question behind itself
      + round 1
      > round?        ...

So each round is a fresh subtree, in which nothing is done yet; and a task that is interrupted goes
on in the round where it was. Rounds that are over are folded into one leaf each.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from py_trees.behaviour import Behaviour
from py_trees.common import Status
from py_trees.composites import Composite

from executive.behaviours.stage import Stage
from executive.trees.idioms import Build
from executive.trees.parts import Finding, Loop, Retry, of_attempt
from robot.failures import Failure, failure

PATIENCE_S = 2.0
"""How long an expectation may take to come true: what is seen lags behind what is done."""


class Finished(Behaviour):
    """Stands for a step that was done before; SUCCESS."""

    def __init__(self, name: str) -> None:
        """Look done from the beginning."""
        super().__init__(name)
        self.status = Status.SUCCESS
        self.feedback_message = "done before"

    def update(self) -> Status:
        """Nothing is left to do."""
        return Status.SUCCESS


class Round(Behaviour):
    """Puts the next round of a loop behind itself, or ends the loop."""

    def __init__(
        self,
        loop: Loop,
        number: int,
        *,
        make: Build,
        stage: Stage,
        passed: Callable[[int], bool],
    ) -> None:
        """Ask before round `number`, from 1.

        Args:
            loop: the rounds, and the question that decides on them.
            number: of the round that would come.
            make: builds a round from its number.
            stage: shared by all leaves.
            passed: whether a round was begun in an earlier run, so that it is not asked for again.
        """
        super().__init__("another round?")
        self._loop, self._number, self._make = loop, number, make
        self._stage, self._passed = stage, passed
        self._asked = False

    def update(self) -> Status:
        """Ask once."""
        if self._asked:
            return Status.SUCCESS
        loop, number = self._loop, self._number
        wanted = loop.question is None or self._passed(number) or loop.question(self._stage.board)
        if wanted and number > loop.at_most and loop.question is not None:
            text = f"after {loop.at_most} rounds it is still so: {loop.name}"
            self._stage.fail(failure("timeout", text), step=loop.name)
            return Status.FAILURE
        self._asked = True
        if wanted and number <= loop.at_most:
            self.feedback_message = f"round {number}"
            self._put_behind()
        return Status.SUCCESS

    def _put_behind(self) -> None:
        parent = self.parent
        if not isinstance(parent, Composite):
            raise TypeError("a round stands in a sequence")
        index = parent.children.index(self)
        if index >= 4:  # the round before the last: fold it
            old = parent.children[index - 3]
            parent.replace_child(old, Finished(f"round {self._number - 2}"))
        following = Round(
            self._loop,
            self._number + 1,
            make=self._make,
            stage=self._stage,
            passed=self._passed,
        )
        parent.add_children([self._make(self._number), following])


class Again(Behaviour):
    """Puts the next attempt behind itself; always FAILURE, so that the selector goes on."""

    def __init__(self, retry: Retry, number: int, *, make: Build, stage: Stage, path: str) -> None:
        """Decide on attempt `number`; `make` builds it, `path` is that of the retry."""
        super().__init__("again?")
        self._retry, self._number = retry, number
        self._make, self._stage, self._path = make, stage, path
        self._asked = False

    def update(self) -> Status:
        """Grow once, unless the operator's patience is over or there is nothing to try again."""
        if self._asked or self._number > self._retry.attempts:
            return Status.FAILURE
        self._asked = True
        parent = self.parent
        if not isinstance(parent, Composite):
            raise TypeError("an attempt stands in a selector")
        reason = self._stage.scope.failure
        code = reason.code if reason else "internal"
        count = f"attempt {self._number} of {self._retry.attempts}"
        self.feedback_message = count
        at = of_attempt(self._path, self._number)
        self._stage.record("again", id=at, step=self._retry.name, code=code, count=count)
        following = Again(
            self._retry, self._number + 1, make=self._make, stage=self._stage, path=self._path
        )
        parent.add_children([self._make(self._number), following])
        return Status.FAILURE


class Deadline(Behaviour):
    """RUNNING until its time is up, then FAILURE with `timeout`; interruptions do not count."""

    def __init__(self, name: str, limit_s: float, *, stage: Stage, path: str) -> None:
        """Allow `limit_s` of the time in which the job has its turn."""
        super().__init__(name)
        self._limit_s, self._stage, self._path = limit_s, stage, path
        self._begun_s: float | None = None

    def update(self) -> Status:
        """Look at the job's time."""
        worked_s = self._stage.scope.worked_s
        if self._begun_s is None:
            self._begun_s = worked_s
        left_s = self._limit_s - (worked_s - self._begun_s)
        if left_s >= 0.0:
            self.feedback_message = f"{left_s:.0f} s left"
            return Status.RUNNING
        text = f"{self.name} took longer than {self._limit_s:g} s"
        reason = failure("timeout", text, limit_s=self._limit_s)
        self._stage.fail(reason, step=self.name, step_id=self._path)
        return Status.FAILURE


class Caught(Behaviour):
    """Remembers the failure that is on the board when its turn comes first; always SUCCESS."""

    def __init__(self, *, stage: Stage, result: Callable[[], Status] | None = None) -> None:
        """Remember also how a node ended, where `result` tells it."""
        super().__init__("remember how it ended")
        self._stage, self._result = stage, result
        self._asked = False
        self.failure: Failure | None = None
        self.status_then = Status.FAILURE

    def update(self) -> Status:
        """Look once."""
        if not self._asked:
            self._asked = True
            self.failure = self._stage.scope.failure
            if self._result is not None:
                self.status_then = self._result()
        return Status.SUCCESS


class Matches(Behaviour):
    """SUCCESS if the failure that was caught has one of some codes."""

    def __init__(self, name: str, caught: Caught, matches: Callable[[str], bool]) -> None:
        """Ask `matches` about the code."""
        super().__init__(name)
        self._caught, self._matches = caught, matches

    def update(self) -> Status:
        """Ask."""
        reason = self._caught.failure
        code = reason.code if reason else "internal"
        return Status.SUCCESS if self._matches(code) else Status.FAILURE


class AsItEnded(Behaviour):
    """Ends as a node ended before, and puts its failure back on the board."""

    def __init__(self, caught: Caught, *, stage: Stage) -> None:
        """End as `caught` remembers it."""
        super().__init__("as it ended")
        self._caught, self._stage = caught, stage

    def update(self) -> Status:
        """Restore."""
        if self._caught.status_then is Status.SUCCESS:
            return Status.SUCCESS
        self._stage.scope.failure = self._caught.failure
        return Status.FAILURE


class Fails(Behaviour):
    """Fails with a reason."""

    def __init__(self, name: str, reason: Failure, *, stage: Stage, path: str) -> None:
        """Fail with `reason`."""
        super().__init__(name)
        self._reason, self._stage, self._path = reason, stage, path

    def update(self) -> Status:
        """Say why."""
        self.feedback_message = self._reason.cause
        self._stage.fail(self._reason, step=self.name, step_id=self._path)
        return Status.FAILURE


class Compare(Behaviour):
    """Compares what should be so with what is so; a result for each goes into the journal."""

    def __init__(self, name: str, findings: Sequence[Finding], *, stage: Stage, path: str) -> None:
        """Ask all of `findings`, for at most `PATIENCE_S` until all are so."""
        super().__init__(name)
        self._findings, self._stage, self._path = tuple(findings), stage, path
        self._begun_s = 0.0

    def initialise(self) -> None:
        """Begin to wait."""
        self._begun_s = self._stage.now_s

    def update(self) -> Status:
        """Ask."""
        board = self._stage.board
        answers = [finding.question(board) for finding in self._findings]
        if not all(answers) and self._stage.now_s - self._begun_s < PATIENCE_S:
            return Status.RUNNING
        wrong: list[str] = []
        for finding, so in zip(self._findings, answers, strict=True):
            found = finding.found(board) if finding.found else ""
            self._stage.record("expect", id=self._path, check=finding.text, so=so, found=found)
            if not so:
                wrong.append(finding.text + (f" (instead: {found})" if found else ""))
        if not wrong:
            return Status.SUCCESS
        text = f"not as the mission expects: {'; '.join(wrong)}"
        self._stage.fail(failure("not_as_expected", text), step=self.name, step_id=self._path)
        return Status.FAILURE
