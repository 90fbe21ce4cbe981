"""A job in a line of text: its number as typed, its row as shown."""

from __future__ import annotations

from executive.engine.job_book import JobError
from executive.engine.jobs import Job
from executive.journal import failures
from robot.files.misfits import shown

MOST_DIGITS = 9
"""Of a job's number; a run has a few hundred."""


def is_number(rest: str) -> bool:
    """Whether what follows is a job's number, or nothing."""
    return not rest or rest.isdecimal()


def number_of(text: str) -> int:
    """A job's number as typed.

    Raises:
        JobError: if it is none.
    """
    if not (text.isdecimal() and len(text) <= MOST_DIGITS):
        raise JobError(f"{shown(text)} is no job's number; `goals` shows them")
    return int(text)


def row(job: Job) -> str:
    """How a job stands, for a list."""
    took = f"{job.took_s:.1f} s" if job.took_s is not None else ""
    reason = failures.because(job.failure.cause if job.failure else None)
    urgent = " (urgent)" if job.urgent else ""
    return f"{job.number:3} {job.state:11} {job.text}{urgent}  {took}{reason}".rstrip()
