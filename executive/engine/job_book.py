"""Every job of an executive, numbered, from being submitted until long after its end.

Jobs are submitted and looked up from any thread, and taken up and ended by the tick's.
"""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable

import msgspec

from executive.engine.job_tree import Jobs, Work
from executive.engine.jobs import OVER, UNDER_WAY, Job, in_turn
from robot.errors import RobotError
from robot.failures import Failure

KEPT_JOBS = 1000
"""Jobs that are over stay in `jobs`; the oldest are forgotten."""


class Outcome(msgspec.Struct, frozen=True, kw_only=True):
    """How a job ended: with a failure, or well. `took_s` is the runtime's time."""

    failure: Failure | None
    took_s: float
    recoveries: int


class JobError(RobotError):
    """A request names a job that is not there."""


class JobBook:
    """All jobs: those that are over, those under way, those that wait.

    Attributes:
        lock: is held while a job goes from one of these to another.
        outcome: how the last of them ended, when nothing is left to do.
    """

    def __init__(self, at_work: Jobs, *, jobs_before: int) -> None:
        """None yet.

        Args:
            at_work: the jobs in the tree.
            jobs_before: the highest number of a job of this run so far.
        """
        self.lock = threading.Lock()
        self.outcome: Outcome | None = None
        self._at_work = at_work
        self._waiting: dict[int, Job] = {}  # submitted, and not taken up by a tick yet
        self._over: deque[Job] = deque(maxlen=KEPT_JOBS)
        self._count = jobs_before

    @property
    def last(self) -> int:
        """The highest number given so far."""
        with self.lock:
            return self._count

    @property
    def jobs(self) -> tuple[Job, ...]:
        """All jobs: those that are over, those under way as they take turns, those that wait."""
        with self.lock:
            live = [work.job for work in self._at_work.works]
            known = {job.number for job in live}
            begun = in_turn([job for job in live if job.state in UNDER_WAY])
            waiting = [job for job in live if job.state not in UNDER_WAY]
            new = [job for job in self._waiting.values() if job.number not in known]
            return (*self._over, *begun, *waiting, *new)

    @property
    def open(self) -> bool:
        """Whether any job is not over."""
        return bool(self._waiting or self._at_work.works)

    def submit(self, make: Callable[[int], Job], *, number: int | None) -> Job:
        """Write a job down under its number (None: the next); the lock is held."""
        given = self._count + 1 if number is None else number
        self._count = max(self._count, given)
        job = self._waiting[given] = make(given)
        self.outcome = None
        return job

    def take_up(self, work: Work) -> None:
        """Put a job that waited into the tree."""
        with self.lock:
            del self._waiting[work.job.number]
            self._at_work.add(work)

    def end(self, ended: list[Job]) -> Outcome | None:
        """Write down what has ended, the lock held; if nothing is left, that is the outcome."""
        self._over += ended
        if not ended or self.open:
            return None
        last = ended[-1]
        self.outcome = Outcome(
            failure=last.failure, took_s=last.took_s or 0.0, recoveries=last.recoveries
        )
        return self.outcome

    def must_have(self, number: int, *, waiting: bool = False) -> None:
        """Check that a job is there.

        Raises:
            JobError: if it is not.
        """
        there = [job for job in self.jobs if job.state not in OVER]
        if waiting:
            there = [job for job in there if job.state == "waiting"]
        if all(job.number != number for job in there):
            known = ", ".join(str(job.number) for job in there) or "none"
            kind = "waiting job" if waiting else "job"
            raise JobError(f"there is no {kind} {number}; there is: {known}")
