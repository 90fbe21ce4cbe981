"""`humanoid resume`: goes on with a run that was cut off, in the way that its runtime allows.

A `fast` run is done again up to its last event, proved to be the same so far, and goes on from
there: its journal is in the end the one of a run that was never cut off. Of a live run whose
processes all died only the journal is left: a new robot starts, the steps that were done are held
against its world, and what is not so (any more) is done again, as a run of its own.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

import msgspec

from executive.engine.loop import Interrupts
from executive.journal import journal
from executive.journal.files import LineFile
from executive.journal.journal import CAPACITY, FILE, Journal
from executive.meaning.request import Setting
from executive.runs import continuation, recording, replay, run_folder, runtimes, task_run
from executive.runs.comparison import Checked, Difference
from executive.runs.recording import Recording
from executive.runs.run_folder import Summary
from executive.runs.session import Session
from executive.runs.task_run import Job, Show
from robot.bringup.mailbox import Handle
from robot.clock import Clock
from robot.errors import ConfigError, Problem
from robot.reality.contract import Reality

Following = Callable[[], AbstractContextManager[replay.Follow]]
"""Opens a display of how far the run is done again."""


class Screen(msgspec.Struct, frozen=True, kw_only=True):
    """How people see it, and how times are told."""

    following: Following
    show: Show
    wall: Clock
    time_of_day: Callable[[], float]


class CannotGoOn(Exception):
    """A run that does not repeat; carries the first difference."""

    def __init__(self, difference: Difference) -> None:
        """Carry it."""
        self.difference = difference
        super().__init__(f"event {difference.number} differs")


def check(folder: Path) -> Recording:
    """Read a run that can be gone on with.

    Raises:
        ConfigError: if it is under way, has ended, or has not begun to do anything.
    """
    if journal.is_written(folder):
        cure = "wait until it has ended, or stop it with Ctrl-C where it runs"
        raise ConfigError([Problem(f"{folder} is under way", suggestion=cure)])
    recorded = recording.load(folder)
    if recorded.ended:
        cure = "`humanoid why` says how; ask for it anew with `humanoid do`"
        raise ConfigError([Problem(f"{folder} has ended: nothing is left of it", suggestion=cure)])
    if recorded.submitted is None:
        cure = "ask for it anew with `humanoid do`"
        raise ConfigError([Problem(f"{folder}: nothing had begun", suggestion=cure)])
    return recorded


def job_of(recorded: Recording, where: Setting, *, folder: Path) -> Job:
    """The newest job of a recorded run, to be gone on with."""
    assert recorded.submitted is not None
    made_from: dict[str, Any] = dict(recorded.submitted.data["origin"])
    return Job(
        understood=recording.restore(recorded.submitted, recorded.folder, where),
        where=where,
        seed=recorded.header.seed,
        runtime_name=recorded.header.runtime,
        folder=folder,
        origin={key: made_from[key] for key in made_from if key != "done"},
    )


# --- fast --------------------------------------------------------------------------------------


def go_on_fast(recorded: Recording, where: Setting, screen: Screen) -> Summary:
    """Do a run again to its last event, then go on to its end.

    Raises:
        CannotGoOn: if it does not repeat.
    """
    folder = recorded.folder
    job = job_of(recorded, where, folder=folder)
    checked = Checked(recorded.lines, onward=LineFile(folder / FILE, capacity=CAPACITY))
    interrupts = Interrupts()
    with (
        interrupts.listen(),
        runtimes.opened("fast", where, seed=job.seed, folder=None) as (runtime, planner),
    ):
        session = replay.opened(
            recorded, where, runtime, planner, checked=checked, interrupts=interrupts,
            journal=Journal(
                folder, wall_s=screen.time_of_day, lines=checked, wall_from=len(recorded.lines)
            ),
        )  # fmt: skip
        session.executive.attended = False
        with session:
            _catch_up(session, recorded, checked, screen)
            return task_run.see_through(
                session, job, begin=_begun, show=screen.show, wall=screen.wall
            )


def _begun() -> None:
    """It goes on as it is."""


def _catch_up(session: Session, recorded: Recording, checked: Checked, screen: Screen) -> None:
    """Let a session do again what is recorded.

    Raises:
        CannotGoOn: if it does not repeat.
    """
    clock, last_s = session.runtime.clock, recorded.last_s

    def over() -> bool:
        late = clock.now_s() > last_s + replay.GRACE_S
        return checked.complete or checked.difference is not None or late

    with screen.following() as follow:
        session.on_tick(lambda: None if checked.complete else follow(clock.now_s(), last_s))
        session.run(until=over)
    checked.end()
    if checked.difference is not None:
        raise CannotGoOn(checked.difference)


# --- live --------------------------------------------------------------------------------------


def live(task: dict[str, Any], handle: Handle, screen: Screen, *, reality: Reality) -> Summary:
    """Go on with a live run with a new robot, in the executive's own process."""
    left_by, folder = Path(task["left_by"]), Path(task["folder"])
    recorded = recording.load(left_by)
    where, _ = recording.setting(recorded, reality)
    job = job_of(recorded, where, folder=folder)
    interrupts = Interrupts()
    with (
        interrupts.listen(),
        runtimes.opened("live", where, seed=job.seed, folder=folder, handle=handle) as (
            runtime,
            planner,
        ),
    ):
        return continuation.do(
            job, runtime, planner, show=screen.show, wall=screen.wall,
            time_of_day=screen.time_of_day, interrupts=interrupts,
            left_by=None if handle.deaths else left_by,
        )  # fmt: skip


def fresh_folder(recorded: Recording, *, stamp: str) -> Path:
    """Where a live run goes on."""
    return run_folder.folder_for(recorded.header.text, stamp=stamp, base=recorded.folder.parent)
