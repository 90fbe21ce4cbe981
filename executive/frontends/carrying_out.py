"""Opens a robot for an assignment and does it, shown and kept as the options say."""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import AbstractContextManager, ExitStack, nullcontext
from pathlib import Path

import msgspec

from executive.engine.executive import Executive
from executive.engine.loop import PATIENCE_S, Interrupts
from executive.frontends import speaking
from executive.frontends.composition_root import REALITY
from executive.frontends.console.beside import shown as viewed
from executive.frontends.driving import chosen
from executive.frontends.dump.record import recorded
from executive.frontends.dump.writer import along
from executive.frontends.exit import before_it_moves
from executive.frontends.hooks import notified
from executive.frontends.launching import hear_people, under_way
from executive.frontends.options import Seeded, Shown, Viewed, Voiced
from executive.frontends.output import Screen, say, write_json
from executive.frontends.progress import Lines, LiveTree, Silent
from executive.meaning import own_eyes, request
from executive.meaning.request import Setting
from executive.runs import lidar_maps, runtimes, task_run
from executive.runs.again import continuation
from executive.runs.again.continuation import Left, left_in
from executive.runs.runtimes import Setup
from executive.runs.session import Session
from executive.runs.summary import Summary, last_lines
from executive.runs.task_run import Assignment, Progress, Show
from intents.goals import Goal
from robot.bringup.mailbox import Handle
from robot.clock import WallClock

MUTE, UNSEEN = Voiced(), Viewed()


class Prepared(msgspec.Struct, frozen=True, kw_only=True):
    """What is to be done, with what robot, and (`left`) what was done of it before."""

    assignment: Assignment
    setup: Setup
    left: Left | None = None


Attend = Callable[
    [Session, Handle | None, Callable[[str], None], tuple[Goal, ...]], AbstractContextManager[None]
]
"""Takes orders from pages while a session works on goals, and says a line to people."""


def _nobody(
    _session: Session,
    _handle: Handle | None,
    _out: Callable[[str], None],
    _goals: tuple[Goal, ...],
) -> AbstractContextManager[None]:
    """Take no orders."""
    return nullcontext()


Prepare = Callable[[], Prepared | int]
"""Understands what was asked for; an exit status where that is refused, which has been said."""


def carry_out(
    prepare: Prepare,
    options: Shown,
    handle: Handle | None = None,
    *,
    voiced: Voiced = MUTE,
    page: Viewed = UNSEEN,
    attend: Attend = _nobody,
) -> int:
    """Do what was asked for, or go on with it, and say how it ended; returns the exit status.

    Args:
        prepare: is called unless the journal of a run that is under way says what to do.
        options: how it is shown.
        handle: of a live robot.
        voiced: whether the robot speaks; what cannot be heard has been told.
        page: whether it is shown on a page, and recorded.
        attend: takes orders from pages: of a live robot from any, of a fast one from its own.

    Raises:
        RobotError: a file is wrong (ConfigError), or a part does not start.
    """
    again = under_way(handle) is not None
    with nullcontext() if again else before_it_moves():
        prepared = _begun(handle) or prepare()
    if isinstance(prepared, int):
        return prepared
    with speaking.opened(wanted=voiced.aloud, model=voiced.voice_model) as speech:
        show = show_for(options)

        def shown(executive: Executive) -> Progress:
            executive.journal.listen(speech.note)
            return show(executive)

        folder, err = prepared.setup.folder, options.as_json
        with (
            viewed(folder, wanted=page.view, err=err),
            recorded(folder, wanted=page.record, err=err),
        ):
            steered = attend if handle is not None or page.view else _nobody

            def out(text: str) -> None:
                say(text, err=options.as_json)

            goals = prepared.assignment.understood.goals
            summary = _work_off(
                prepared,
                shown,
                handle,
                attend=lambda session: steered(session, handle, out, goals),
            )
            say_how_it_ended(summary, as_json=options.as_json)  # before what is still written
        speech.finish()
    return summary.exit_status


def setup(where: Setting, options: Seeded, folder: Path, *, handle: Handle | None = None) -> Setup:
    """What a run is set up with. Raises ConfigError if its motors cannot be driven so.

    Who tells the robot where it is is settled here, and stays as it is in a run that is under way.
    """
    there = under_way(handle)
    by = there.localisation if there is not None else options.localisation
    as_json = isinstance(options, Shown) and options.as_json  # its summary says it as well

    def tell(text: str) -> None:
        if not as_json:
            say(text, err=True)

    told_by = own_eyes.trusted(where.world, where.robot_name)
    if there is None and options.eyes == "auto" and told_by == "oracle":
        tell(own_eyes.untried(where.world.name))
    where = lidar_maps.localised(where, by, tell=tell)
    kind: runtimes.Kind = "fast" if options.fast else "live"
    driver = chosen(options.driver, where.description, fast=options.fast, err=as_json)
    return Setup(
        where=where, kind=kind, seed=options.seed, folder=folder, pictures=options.camera,
        driver=driver,
    )  # fmt: skip


def _begun(handle: Handle | None) -> Prepared | None:
    """What an executive before this one had begun; None if it had not come so far."""
    there = under_way(handle)
    if there is None:
        return None
    where = request.setting(
        REALITY.under(there.reality, eyes=there.eyes, localisation=there.localisation),
        there.world,
        robot=there.robot,
        vary_seed=there.variation_seed,
    )
    left = left_in(Path(there.folder))
    assignment = left.newest(where)
    if assignment is None:
        return None
    again = Setup(
        where=where, kind="live", seed=there.seed, folder=left.folder, driver=there.motors
    )
    return Prepared(assignment=assignment, setup=again, left=left)


def _work_off(
    prepared: Prepared,
    show: Show,
    handle: Handle | None,
    *,
    attend: Callable[[Session], AbstractContextManager[None]],
) -> Summary:
    """Open the robot, and do what was prepared."""
    assignment, left = prepared.assignment, prepared.left
    interrupts = Interrupts()
    with ExitStack() as stack:
        stack.enter_context(
            interrupts.listen(patience_s=None if handle is not None else PATIENCE_S)
        )
        hear_people(handle, interrupts)
        robot = stack.enter_context(runtimes.opened(prepared.setup, handle=handle))
        session = stack.enter_context(
            Session(
                prepared.setup,
                robot,
                interrupts=interrupts,
                time_of_day=time.time,
                first=_next_number(prepared.setup, handle),
                faults=assignment.faults,
            )
        )
        stack.enter_context(notified(session.journal, prepared.setup.folder))
        stack.enter_context(attend(session))
        wall = WallClock()
        if left is None:
            return task_run.do(assignment, session, show=show, wall=wall)
        return continuation.do(assignment, session, left, show=show, wall=wall)


def _next_number(setup: Setup, handle: Handle | None) -> int:
    """Of the journal's next event: an executive before this one may have written some."""
    begun = under_way(handle) is not None and setup.folder is not None
    return left_in(setup.folder).next_number if begun and setup.folder else 0


# --- on the screen -----------------------------------------------------------------------------


def show_for(options: Shown) -> Show:
    """How people see it: a live tree on a terminal, plain lines elsewhere; and dumps beside it.

    Raises:
        ConfigError: an option cannot be meant.
    """
    shown = _silent if options.as_json else _on_screen
    return along(shown, options.dump, on=options.dump_on, formats=options.dump_format)


def _silent(_executive: Executive) -> Progress:
    return Silent()


def _on_screen(executive: Executive) -> Progress:
    console = Screen()
    if console.is_terminal:
        return LiveTree(executive, console, wall_s=WallClock().now_s)
    return Lines(executive)


def say_how_it_ended(summary: Summary, *, as_json: bool) -> None:
    """The last words."""
    if as_json:
        write_json(summary)
    else:
        say("\n".join(last_lines(summary)))
