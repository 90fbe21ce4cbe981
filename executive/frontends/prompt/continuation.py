"""Goes on with the jobs of a prompt whose executive died, while the robot stood and waited."""

from __future__ import annotations

from pathlib import Path

from executive.engine.jobs import OVER
from executive.journal.journal import Event
from executive.meaning.request import Setting
from executive.runs import recording
from executive.runs.continuation import go_on
from executive.runs.session import Session
from executive.runs.task_run import Job


def unfinished(events: list[Event]) -> list[list[Event]]:
    """Of every job that was not over: its events from its submission on, the oldest first.

    What the hands hold counts for all of them, whichever job took it. Jobs are numbered in the
    order of their submission, anew in every executive of a run; one that returns submits again what
    was open, so that the newest executive's jobs are all there is.
    """
    submitted: list[int] = []
    over: set[int] = set()
    for at, event in enumerate(events):
        if event.event == "returned":
            submitted, over = [], set()
        elif event.event == "request" and event.data.get("request") == "submit":
            submitted.append(at)
        elif event.event == "job" and event.data["state"] in OVER:
            over.add(int(event.data["job"]))
    open_ = [(number, at) for number, at in enumerate(submitted, start=1) if number not in over]
    return [
        [event for event in events[at:] if event.event == "held" or _of(event) in (number, None)]
        for number, at in open_
    ]


def _of(event: Event) -> int | None:
    """The job that an event belongs to; None for those of no job."""
    return event.data.get("job")


def return_to(
    session: Session, events: list[Event], *, where: Setting, folder: Path, anew: bool = False
) -> None:
    """Submit again what was open, without the steps that are done.

    Args:
        session: of the prompt that goes on with them.
        events: of the run that was cut off.
        where: robot and world.
        folder: of that run.
        anew: whether that was another run, whose robot is gone.
    """
    if not anew:
        session.journal.write(session.runtime.clock.now_s(), "returned")
    for since in unfinished(events):
        job = Job(
            understood=recording.restore(since[0], folder, where),
            where=where,
            seed=0,
            runtime_name="live",
            folder=folder,
            origin=dict(since[0].data["origin"]),
        )
        go_on(session, job, since, anew=anew)
