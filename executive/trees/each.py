"""Several things, each in its turn: what fails with one does not keep the others from being done.

What has the robot itself unable to go on (`HOPELESS`) ends all of it.
"""

from __future__ import annotations

from collections.abc import Sequence

from msgspec.structs import replace
from py_trees.behaviour import Behaviour
from py_trees.common import OneShotPolicy, Status
from py_trees.composites import Sequence as InOrder
from py_trees.decorators import FailureIsSuccess, OneShot

from executive.behaviours.stage import Stage
from executive.blackboard import Blackboard
from executive.skills.parameters import MAX_TEXT
from executive.skills.say import SayParams
from executive.trees.idioms import once
from executive.trees.parts import Each, Errand, below
from executive.trees.recovery import resilient
from intents.english.trouble import listing
from robot.failures import Failure, codes, failure

HOPELESS = frozenset(codes("robot", "system"))
"""Failures of the robot itself: the next thing would fare no better."""


def each(part: Each, works: Sequence[Behaviour], *, stage: Stage, path: str) -> Behaviour:
    """The tree of an `Each`; `works` are the trees of its parts."""
    tally = Tally()
    nodes: list[Behaviour] = []
    for thing, work in zip(part.things, works, strict=True):
        settled = OneShot(work.name, work, policy=OneShotPolicy.ON_COMPLETION)
        nodes += [FailureIsSuccess(work.name, settled), Note(thing, settled, tally, stage=stage)]
    tell = Errand(name="say what is done", params=tally.told)
    nodes += [once(resilient(tell, stage, path=below(path, "tell"))), Verdict(tally, stage=stage)]
    return InOrder(part.name, memory=True, children=nodes)


class Tally:
    """Which things are done, and why the others are not."""

    def __init__(self) -> None:
        """Begin with nothing."""
        self.done: list[str] = []
        self.failed: dict[str, Failure] = {}

    @property
    def words(self) -> str:
        """The whole of it, for people."""
        done = f"Done: {listing(self.done, 'and')}." if self.done else ""
        reasons = [f"{thing} ({reason.cause})" for thing, reason in self.failed.items()]
        left = f"Not done: {'; '.join(reasons)}." if reasons else ""
        return " ".join(text for text in (done, left) if text)

    def told(self, _board: Blackboard) -> SayParams:
        """What the robot says at the end."""
        return SayParams(text=self.words[:MAX_TEXT])

    @property
    def failure(self) -> Failure | None:
        """The first failure, with how many things are not done; None if all are."""
        if not self.failed:
            return None
        first = next(iter(self.failed.values()))
        count = len(self.done) + len(self.failed)
        reasons = "; ".join(f"{thing}: {reason.cause}" for thing, reason in self.failed.items())
        return replace(first, cause=f"{len(self.failed)} of {count} not done: {reasons}")


class Note(Behaviour):
    """Notes how a thing's part ended; FAILURE only where there is no going on."""

    def __init__(self, thing: str, work: Behaviour, tally: Tally, *, stage: Stage) -> None:
        """Look at how `work` ended."""
        super().__init__("note")
        self._thing, self._work, self._tally, self._stage = thing, work, tally, stage
        self._noted = False

    def update(self) -> Status:
        """Look once."""
        if not self._noted:
            self._noted = True
            if self._work.status is Status.SUCCESS:
                self._tally.done.append(self._thing)
                return Status.SUCCESS
            reason = self._stage.scope.failure or failure("internal", "it failed without a reason")
            self._tally.failed[self._thing] = reason
            if reason.code in HOPELESS:
                return Status.FAILURE
        return Status.SUCCESS


class Verdict(Behaviour):
    """FAILURE if one thing is not done, with its reason on the board."""

    def __init__(self, tally: Tally, *, stage: Stage) -> None:
        """Judge by the tally."""
        super().__init__("all done?")
        self._tally, self._stage = tally, stage

    def update(self) -> Status:
        """Judge."""
        reason = self._tally.failure
        if reason is None:
            return Status.SUCCESS
        self.feedback_message = reason.cause
        self._stage.fail(reason, step=self.name)
        return Status.FAILURE
