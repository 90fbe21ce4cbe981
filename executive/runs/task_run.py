"""Carries a task out in a session and sums it up: a sentence, or a mission."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple, Protocol

import msgspec
from msgspec.structs import replace

from executive.engine.executive import Executive
from executive.engine.jobs import UNLIMITED, Limits
from executive.journal.journal import Event
from executive.meaning.request import Understood
from executive.missions.fault_plans import FaultPlan
from executive.runs import run_folder
from executive.runs.session import Session
from executive.runs.summary import Expected, Summary, summary
from robot.clock import Clock
from robot.closing import Closing


class Progress(Closing, Protocol):
    """Shows an executive at work; a context manager."""

    def update(self) -> None:
        """Called after every tick."""
        ...


Show = Callable[[Executive], Progress]
"""Makes the progress display of an executive."""


class Assignment(msgspec.Struct, frozen=True, kw_only=True):
    """What is to be done; the robot that does it is the session's.

    Attributes:
        understood: the task.
        limits: what it may take.
        origin: what the task is made from, for the journal (default: the goals).
        done: paths of steps that are left out.
        faults: what goes wrong on purpose.
    """

    understood: Understood
    limits: Limits = UNLIMITED
    origin: dict[str, Any] | None = None
    done: frozenset[str] = frozenset()
    faults: tuple[FaultPlan, ...] = ()

    def submit_to(self, session: Session, *, number: int | None = None) -> None:
        """Queue it as a job, or as the one of that number, which is gone on with."""
        session.submit(
            self.understood,
            limits=self.limits,
            origin=self.origin,
            done=self.done,
            number=number,
        )


def do(assignment: Assignment, session: Session, *, show: Show, wall: Clock) -> Summary:
    """Do an assignment to its end, whatever that is, and write its folder.

    Args:
        assignment: the task; its faults are the session's.
        session: entered, at time 0.
        show: how people see what goes on.
        wall: measures how long it takes.
    """

    def begin() -> None:
        session.begin(assignment.understood.text)
        assignment.submit_to(session)

    return see_through(assignment, session, begin=begin, show=show, wall=wall)


class Before(NamedTuple):
    """What lies behind of a run that is gone on with in its own folder.

    Attributes:
        since_s: when it began, by the runtime's clock.
        begun_s: when doing it again began, by the wall's.
        events: that were done again.
    """

    since_s: float
    begun_s: float
    events: Sequence[Event]


def see_through(
    assignment: Assignment,
    session: Session,
    *,
    begin: Callable[[], None],
    show: Show,
    wall: Clock,
    before: Before | None = None,
) -> Summary:
    """Begin, or go on, and run a session until nothing is left to do; write its summary.

    What lies `before` counts as well: the summary is of the whole run.
    """
    since_s, begun_s, past = before or Before(session.now_s, wall.now_s(), ())
    expected: list[Expected] = []
    for event in past:
        _note(event, expected)
    with show(session.executive) as progress:
        session.journal.listen(lambda event: _note(event, expected))
        session.on_tick(progress.update)
        begin()
        session.run()
        wall_s = wall.now_s() - begun_s
        found = summary(session, assignment.understood.task, since_s=since_s, wall_s=wall_s)
        found = replace(found, expected=tuple(expected))
    found = replace(found, unwritten=session.unwritten())
    if session.setup.folder is not None:
        problem = run_folder.save(session.setup.folder, "summary.json", found)
        found = replace(found, unwritten=(*found.unwritten, *([problem] if problem else [])))
    return found


def _note(event: Event, expected: list[Expected]) -> None:
    """Keep what a mission expected, for the summary."""
    if event.event == "expect":
        found = {key: event.data[key] for key in ("check", "so", "found")}
        expected.append(msgspec.convert(found, Expected))
