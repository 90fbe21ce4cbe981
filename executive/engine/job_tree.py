"""The jobs in the tree, side by side where they do not want the same part of the body.

A job whose turn it is not is frozen, not reset: its leaves at work come to rest, and its nodes keep
what they know. So it goes on at the step, and at the try of a recovery, where it was.
"""

from __future__ import annotations

import logging
import math
from collections.abc import Iterator
from dataclasses import dataclass, field

from msgspec.structs import replace
from py_trees.behaviour import Behaviour
from py_trees.common import Status
from py_trees.composites import Composite

from executive.behaviours.scope import Scope
from executive.behaviours.stage import Stage, broken, failure_data
from executive.blackboard import FAILURE, GOAL, RECOVERIES, RESTLESS
from executive.engine.jobs import OVER, UNDER_WAY, Job, JobState, side_by_side
from robot.failures import Failure, failure

log = logging.getLogger(__name__)


@dataclass(eq=False)
class Work:
    """A job with its part of the tree; `ending` is why it is being ended from outside."""

    job: Job
    node: Behaviour
    scope: Scope = field(default_factory=Scope)
    ending: Failure | None = None


class Jobs(Composite):
    """The jobs: ticks those whose turn it is. FAILURE when there is none, RUNNING otherwise."""

    def __init__(self, stage: Stage) -> None:
        """Begin with an empty queue."""
        super().__init__("jobs", [])
        self._stage = stage
        self._works: list[Work] = []
        self._over: list[Work] = []
        self._last_s = math.nan
        self.pausing = False

    @property
    def works(self) -> tuple[Work, ...]:
        """All that are not over, those that wait in their order."""
        return tuple(self._works)

    def find(self, number: int) -> Work | None:
        """The job of that number, if it is not over."""
        return next((work for work in self._works if work.job.number == number), None)

    # --- the queue ---

    def add(self, work: Work) -> None:
        """Put a job at the end of the queue."""
        self._record(work.job)
        work.scope.number = work.job.number
        work.scope.speed_m_s = work.job.limits.speed_m_s
        self._works.append(work)

    def move(self, work: Work, place: int) -> None:
        """Put a waiting job at a place of the queue, counted from 0."""
        others = [other for other in self._works if other is not work]
        waiting = [other for other in others if other.job.state == "waiting"]
        place = max(0, min(place, len(waiting)))
        waiting.insert(place, work)
        self._works = [other for other in others if other.job.state != "waiting"] + waiting

    # --- the tree ---

    def tick(self) -> Iterator[Behaviour]:
        """Tick the jobs whose turn it is, and freeze the others."""
        if self.status is not Status.RUNNING:
            self.initialise()
        turns = self._take_turns()
        self._count_time(turns)
        for work in turns:
            if work.ending or work.node.status in (Status.SUCCESS, Status.FAILURE):
                continue  # its body is coming to rest
            with self._stage.turn(work.scope):
                yield from self._tick(work)
        self.current_child = turns[0].node if turns else None
        self.status = Status.RUNNING if turns else Status.FAILURE
        yield self

    def _tick(self, work: Work) -> Iterator[Behaviour]:
        """Tick one job; a mistake in its part of the tree ends that job only."""
        try:
            yield from work.node.tick()
        except Exception as error:
            log.exception("job %d broke", work.job.number)
            reason = broken(error)
            self._stage.fail(reason, step=work.job.text)
            self.end(work, reason)

    def stop(self, new_status: Status = Status.INVALID) -> None:
        """Freeze all jobs: something more urgent has the body."""
        for work in self._works:
            self._freeze(work, "paused" if self.pausing else "interrupted")
        self.status = new_status
        self.iterator = self.tick()

    def _take_turns(self) -> list[Work]:
        """Begin, go on with and freeze jobs as the queue wants it."""
        for work in self._over:
            self.remove_child(work.node)
        self._over.clear()
        by_number = {work.job.number: work for work in self._works if work.ending is None}
        running = side_by_side([work.job for work in by_number.values()])
        turns = [by_number[job.number] for job in running]
        for work in self._works:
            if work not in turns and work.ending is None:
                self._freeze(work, "interrupted")
        for work in turns:
            self._let_run(work)
        return turns

    def _count_time(self, turns: list[Work]) -> None:
        """Count the time of those at work, and end what has taken too long."""
        now_s, last_s = self._stage.now_s, self._last_s
        self._last_s = now_s
        if self.status is not Status.RUNNING:
            return
        for work in turns:
            limit_s = work.job.limits.duration_s
            work.scope.worked_s += now_s - last_s
            if work.scope.worked_s > limit_s:
                cause = f"{work.job.text!r} took longer than {limit_s:g} s"
                self.end(work, failure("timeout", cause))

    def _let_run(self, work: Work) -> None:
        if work.job.began_s is None:
            board, now_s = self._stage.task, self._stage.now_s
            self.add_child(work.node)
            work.job = replace(work.job, began_s=now_s)
            board.set(GOAL, work.job.text)
            board.set(FAILURE, None)
            board.set(RECOVERIES, 0)
        self.become(work, "running")

    def _freeze(self, work: Work, state: JobState) -> None:
        work.scope.suspend()
        if work.job.state in UNDER_WAY:
            self.become(work, state)

    # --- the end ---

    def end(self, work: Work, reason: Failure) -> None:
        """End a job from outside; it is over when `settle` finds its skills at rest."""
        if work.ending is None:
            work.ending = reason
            work.node.stop(Status.INVALID)

    def settle(self) -> list[Job]:
        """The jobs that have come to their end, with the body at rest; they leave the queue."""
        return self._finish([work for work in self._works if self._at_end(work)])

    def abandon(self, reason: Failure) -> list[Job]:
        """End all jobs as they are."""
        for work in self._works:
            work.ending = work.ending or reason
        return self._finish(list(self._works))

    def _at_end(self, work: Work) -> bool:
        over = work.ending is not None or work.node.status in (Status.SUCCESS, Status.FAILURE)
        moves = self._stage.board.read(RESTLESS) and work.job.began_s is not None
        return over and not moves and self._stage.at_rest(work.scope)

    def _finish(self, ended: list[Work]) -> list[Job]:
        """Give jobs their final states."""
        self._works = [work for work in self._works if work not in ended]
        self._over += [work for work in ended if work.node.parent is self]
        for work in ended:
            reason = work.ending
            if reason is None and work.node.status is Status.FAILURE:
                reason = work.scope.failure or failure("internal", "it failed without a reason")
            began_s = work.job.began_s
            work.job = replace(
                work.job,
                failure=reason,
                took_s=0.0 if began_s is None else round(self._stage.now_s - began_s, 4),
                recoveries=work.scope.recoveries,
            )
            cancelled = reason is not None and reason.code == "cancelled"
            self.become(work, "cancelled" if cancelled else "failed" if reason else "done")
        return [work.job for work in ended]

    def become(self, work: Work, state: JobState) -> None:
        """Change a job's state, and journal it."""
        if work.job.state == state or work.job.state in OVER:
            return
        work.job = replace(work.job, state=state)
        self._record(work.job)

    def _record(self, job: Job) -> None:
        """Write a job's state into the journal."""
        reason = failure_data(job.failure) if job.failure is not None else {}
        self._stage.record(
            "job", job=job.number, text=job.text, state=job.state, urgent=job.urgent, **reason
        )
