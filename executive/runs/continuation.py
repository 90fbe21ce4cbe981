"""Goes on with a live run whose executive died, or with one that nothing is left of but a journal.

The steps that were done are not done again, as long as the world agrees (`agreement`).
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from executive.engine import loop
from executive.journal import journal
from executive.journal.journal import Event, Journal
from executive.runs import agreement, run_folder
from executive.runs.agreement import Agreement
from executive.runs.run_folder import Summary
from executive.runs.session import Session
from executive.runs.task_run import Job, Show, see_through
from robot.clock import Clock
from robot.planning.worker import Planner


def do(
    job: Job,
    runtime: loop.Runtime,
    planner: Planner,
    *,
    show: Show,
    wall: Clock,
    time_of_day: Callable[[], float],
    interrupts: loop.Interrupts,
    left_by: Path | None = None,
) -> Summary:
    """Go on with a job to its end; arguments as for `executive.runs.task_run.do`.

    Args:
        job: the task and its folder.
        runtime: entered: the robot that is still there, or a new one.
        planner: answers the skills' requests.
        show: how people see what goes on.
        wall: measures how long it takes.
        time_of_day: for the journal's sibling file.
        interrupts: looked at every tick.
        left_by: folder of a run that ended with its robot; None: that of the job, and its robot is
            still there.
    """
    folder = left_by or job.folder
    assert folder is not None
    events = journal.read(folder)
    first = events[-1].n + 1 if left_by is None and events else 0
    session = Session(
        runtime,
        planner,
        description=job.where.description,
        interrupts=interrupts,
        seed=job.seed,
        journal=Journal(job.folder, wall_s=time_of_day, background=True, first=first),
    )

    def begin() -> None:
        now_s = runtime.clock.now_s()
        if left_by is not None:
            text = job.understood.text
            header = run_folder.header(
                job.where, text=text, seed=job.seed, runtime=job.runtime_name
            )
            run_folder.begin(session.journal, header, now_s=now_s, folder=job.folder)
            if job.folder is not None:
                run_folder.carry_missions_over(left_by, job.folder)
        go_on(session, job, newest_job(events), anew=left_by is not None)

    return see_through(session, job, begin=begin, show=show, wall=wall)


def newest_job(events: list[Event]) -> list[Event]:
    """The events since the newest submission that was not one of going on."""
    begin = 0
    for number, event in enumerate(events):
        submitted = event.event == "request" and event.data.get("request") == "submit"
        if submitted and events[number - 1].event != "resumed":
            begin = number
    return events[begin:]


def go_on(session: Session, job: Job, events: list[Event], *, anew: bool) -> None:
    """Compare, say what was found, and submit what is left."""
    link = session.runtime.link
    found = agreement.look(
        events,
        job.understood.task,
        link=link,
        knowledge=job.where.knowledge,
        robot=job.where.description,
    )
    for held in found.held:
        session.holdings.take(held)
    now_s = session.runtime.clock.now_s()
    session.journal.write(
        now_s, "resumed", why=_words(found, anew=anew), done=sorted(found.done),
        again=[{"step": step, "why": why} for step, why in found.again],
    )  # fmt: skip
    session.submit(job.understood, limits=job.limits, origin=job.origin, done=found.done | job.done)


def _words(found: Agreement, *, anew: bool) -> str:
    """What is gone on with, for people."""
    words = "with a new robot, in a world as it was at the start" if anew else "the robot stands"
    steps = sum(1 for path in found.done if "?" not in path)
    words += f"; {steps} {'step is' if steps == 1 else 'steps are'} done"
    if found.held:
        words += f"; in the hand: {', '.join(held.object_id for held in found.held)}"
    for step, why in found.again:
        words += f'; "{step}" is done again: {why}'
    return words
