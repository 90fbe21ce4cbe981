"""A job: one thing that was asked for, from waiting in the queue to its one final state."""

from __future__ import annotations

import math
from typing import Literal

import msgspec

from executive.skills.skill import BODY, Resource
from robot.failures import Failure

JobState = Literal["waiting", "running", "interrupted", "paused", "done", "failed", "cancelled"]

UNDER_WAY: frozenset[JobState] = frozenset({"running", "interrupted", "paused"})
OVER: frozenset[JobState] = frozenset({"done", "failed", "cancelled"})


class Limits(msgspec.Struct, frozen=True, kw_only=True):
    """What a job may take: time at work [s] (waiting and pauses do not count), walking speed."""

    duration_s: float = math.inf
    speed_m_s: float = math.inf


UNLIMITED = Limits()


class Job(msgspec.Struct, frozen=True, kw_only=True):
    """One thing that was asked for, as it stands now.

    Attributes:
        number: counted from 1 in one run, also where one executive went on for another.
        text: what was asked for, in words.
        urgent: it takes the parts of the body that it needs from jobs that are not.
        resources: the parts of the body that it may use.
        state: "interrupted" while an urgent job has its parts of the body; it comes back.
        failure: why it failed or was cancelled.
        began_s: when it ran first; None while it waits.
        took_s: from then to its end; None before.
        recoveries: begun so far.
    """

    number: int
    text: str
    urgent: bool = False
    resources: frozenset[Resource] = BODY
    limits: Limits = UNLIMITED
    state: JobState = "waiting"
    failure: Failure | None = None
    began_s: float | None = None
    took_s: float | None = None
    recoveries: int = 0


def in_turn(jobs: list[Job]) -> list[Job]:
    """The jobs in the order in which they take what they need of the body.

    The newest urgent job comes first, then what was begun, then what waits, in its order.
    """
    urgent = sorted((job for job in jobs if job.urgent), key=lambda job: -job.number)
    others = [job for job in jobs if not job.urgent]
    begun = sorted((job for job in others if job.began_s is not None), key=lambda job: job.number)
    waiting = [job for job in others if job.began_s is None]
    return [*urgent, *begun, *waiting]


def side_by_side(jobs: list[Job]) -> list[Job]:
    """Those of the jobs that run now, the most urgent first.

    They take turns (`in_turn`): a job runs when no job before it wants one of its parts of the
    body, so nothing overtakes.

    Args:
        jobs: all that are not over, those that wait in the order of the queue.
    """
    running: list[Job] = []
    wanted: set[Resource] = set()
    for job in in_turn(jobs):
        if not job.resources & wanted:
            running.append(job)
        wanted |= job.resources
    return running
