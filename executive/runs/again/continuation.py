"""Goes on with what was cut off: with the robot that waits for it, or with a new one.

An executive that is started again finds its robot standing; of a live run whose processes all died
only the journal is left. Either way the journal says what was asked for, and the steps that were
done are not done again, as long as the world agrees (`agreement`).
"""

from __future__ import annotations

from pathlib import Path

import msgspec

from executive.engine.jobs import OVER
from executive.journal import journal, successor
from executive.journal.journal import Event
from executive.journal.words import DRAWN
from executive.meaning.request import Setting
from executive.runs import run_folder
from executive.runs.again import agreement, recording
from executive.runs.again.agreement import Agreement
from executive.runs.again.orders import orders_in
from executive.runs.session import Session
from executive.runs.summary import Summary
from executive.runs.task_run import Assignment, Show, see_through
from robot.clock import Clock
from robot.errors import ConfigError


class Left(msgspec.Struct, frozen=True, kw_only=True):
    """What a run that was cut off has left.

    Attributes:
        folder: of the run.
        events: its journal; empty where there is none.
    """

    folder: Path
    events: list[Event]

    @property
    def next_number(self) -> int:
        """Of the event that comes after those in the journal."""
        return self.events[-1].n + 1 if self.events else 0

    @property
    def jobs(self) -> int:
        """The highest number of a job so far; 0 where there was none."""
        return max((_of(event) or 0 for event in self.events if _submits(event)), default=0)

    @property
    def ended(self) -> tuple[tuple[int, str, str], ...]:
        """The jobs that are over: the number, the state and the text of each, in their order."""
        states = {_of(event): event.data for event in self.events if event.event == "job"}
        return tuple(
            (number, str(data["state"]), str(data.get("text", "")))
            for number, data in states.items()
            if number is not None and data.get("state") in OVER
        )

    def newest(self, where: Setting) -> Assignment | None:
        """The newest job, made again; None if none had been submitted.

        Raises:
            ConfigError: if it cannot be made here and now.
        """
        submitted = next((one for one in newest_job(self.events) if _submits(one)), None)
        return recording.assigned(submitted, self.folder, where) if submitted else None


def left_in(folder: Path) -> Left:
    """What is left of a run. Raises ConfigError if its journal is too large to go on with."""
    try:
        return Left(folder=folder, events=journal.read(folder, without=DRAWN))
    except ConfigError:  # it had not come as far as a journal
        journal.check_size(folder)
        return Left(folder=folder, events=[])


def do(assignment: Assignment, session: Session, left: Left, *, show: Show, wall: Clock) -> Summary:
    """Go on with an assignment to its end, whatever that is, and write its folder.

    Args:
        assignment: what was begun.
        session: entered; where its folder is not the one of `left`, its robot is a new one.
        left: by who began it.
        show: how people see what goes on.
        wall: measures how long it takes.
    """
    anew = session.setup.folder != left.folder

    def begin() -> None:
        if anew:
            session.begin(assignment.understood.text)
            _carry_over(left, session)
        else:
            take_over(session, left.events)
        go_on(session, assignment, newest_job(left.events), anew=anew)

    return see_through(assignment, session, begin=begin, show=show, wall=wall)


def return_to(session: Session, left: Left) -> None:
    """Submit again all that was open at a prompt, without the steps that are done."""
    anew = session.setup.folder != left.folder
    if anew:
        _carry_over(left, session)
    else:
        session.journal.write(session.now_s, "returned")
        take_over(session, left.events)
    for since in unfinished(left.events):
        assignment = recording.assigned(since[0], left.folder, session.setup.where)
        go_on(session, assignment, since, anew=anew)


def _carry_over(left: Left, session: Session) -> None:
    if session.setup.folder is not None:
        run_folder.carry_missions_over(left.folder, session.setup.folder)
        successor.note(left.folder, session.setup.folder)


def take_over(session: Session, events: list[Event]) -> None:
    """Take the robot as it was left: with what its hands hold, and what it was told still holds."""
    link, where = session.runtime.link, session.setup.where
    for held in agreement.in_hand(
        events, link=link, knowledge=where.knowledge, robot=where.description
    ):
        session.holdings.take(held)
    orders_in(events).repeat(session.executive)


def go_on(session: Session, assignment: Assignment, events: list[Event], *, anew: bool) -> None:
    """Compare, say what was found, and submit what is left.

    Args:
        session: that goes on.
        assignment: what was asked for.
        events: of the job that was cut off, from its submission on.
        anew: whether the robot is another one, and this another run: the job is a new one there.
    """
    where = session.setup.where
    found = agreement.look(
        events,
        assignment.understood.task,
        link=session.runtime.link,
        knowledge=where.knowledge,
        robot=where.description,
        done=assignment.done,
    )
    session.journal.write(
        session.now_s, "resumed", text=assignment.understood.text,
        why=_words(found, anew=anew), done=sorted(found.done),
        again=[{"step": step, "why": why} for step, why in found.again],
    )  # fmt: skip
    left = msgspec.structs.replace(assignment, done=found.done)
    number = next((_of(event) for event in events if _submits(event)), None)
    left.submit_to(session, number=None if anew else number)


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


# --- which jobs --------------------------------------------------------------------------------


def _submits(event: Event) -> bool:
    return event.event == "request" and event.data.get("request") == "submit"


def newest_job(events: list[Event]) -> list[Event]:
    """The events since the newest submission that was not one of going on."""
    begin = 0
    for number, event in enumerate(events):
        if _submits(event) and events[number - 1].event != "resumed":
            begin = number
    return events[begin:]


def unfinished(events: list[Event]) -> list[list[Event]]:
    """Of every job that was not over: its events from its submission on, the oldest first.

    What the hands hold counts for all of them, whichever job took it. A job that is gone on with is
    submitted again under its number, with the steps that were done by then: the last time counts.
    """
    submitted: dict[int, int] = {}
    for at, event in enumerate(events):
        number = _of(event)
        if number is not None and _submits(event):
            submitted[number] = at
        elif number is not None and event.event == "job" and event.data.get("state") in OVER:
            submitted.pop(number, None)
    return [
        [event for event in events[at:] if event.event == "held" or _of(event) in (number, None)]
        for number, at in submitted.items()
    ]


def _of(event: Event) -> int | None:
    """The job that an event belongs to; None for those of no job."""
    number = event.data.get("job")
    return number if isinstance(number, int) else None
