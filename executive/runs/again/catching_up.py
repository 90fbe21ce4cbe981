"""Goes on with a `fast` run that was cut off: done again up to its last event, then to its end.

What is done again is proved to be the same, so that its journal is in the end the one of a run that
was never cut off.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager
from pathlib import Path

import msgspec

from executive.engine.loop import Interrupts
from executive.journal import journal, successor
from executive.journal.files import LineFile
from executive.journal.journal import CAPACITY, FILE, Journal
from executive.journal.why import ANEW
from executive.meaning.request import Setting
from executive.runs import run_folder, runtimes
from executive.runs.again import recording, replay
from executive.runs.again.comparison import Checked, Difference
from executive.runs.again.recording import Recording
from executive.runs.runtimes import Setup
from executive.runs.summary import Summary
from executive.runs.task_run import Before, Show, see_through
from robot.clock import Clock
from robot.errors import ConfigError, Problem

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
        ConfigError: if it is under way, has ended, has not begun to do anything, or another run
            went on with it.
    """
    if journal.is_written(folder):
        cure = "wait until it has ended, or stop it with Ctrl-C where it runs"
        raise ConfigError([Problem(f"{folder} is under way", suggestion=cure)])
    successor.refuse(folder)
    recorded = recording.load(folder)
    if recorded.ended:
        cure = "`humanoid why` says how; ask for it anew with `humanoid do`"
        raise ConfigError([Problem(f"{folder} has ended: nothing is left of it", suggestion=cure)])
    if recorded.submitted is None:
        raise ConfigError([Problem(f"{folder}: nothing had begun", suggestion=ANEW)])
    return recorded


def go_on(recorded: Recording, where: Setting, screen: Screen) -> Summary:
    """Do a run again to its last event, then go on to its end.

    Raises:
        CannotGoOn: if it does not repeat.
        ConfigError: if its folder is another user's, or somebody goes on with it just now.
    """
    assert recorded.submitted is not None
    run_folder.claim(recorded.folder)
    assignment = recording.assigned(recorded.submitted, recorded.folder, where)
    setup = Setup(where=where, seed=recorded.header.seed, folder=recorded.folder)
    onward = LineFile(recorded.folder / FILE, capacity=CAPACITY)
    checked = Checked(recorded.lines, onward=onward)
    kept = Journal(
        recorded.folder, wall_s=screen.time_of_day, lines=checked, wall_from=len(recorded.lines)
    )
    interrupts, begun_s = Interrupts(), screen.wall.now_s()
    with (
        interrupts.listen(),
        runtimes.opened(setup) as robot,
        replay.reenacted(
            recorded, setup, robot, checked=checked, interrupts=interrupts, journal=kept
        ) as session,
    ):
        with screen.following() as follow:
            replay.catch_up(session, recorded, checked=checked, follow=follow)
        if checked.difference is not None:
            raise CannotGoOn(checked.difference)
        before = Before(recorded.events[0].t_s, begun_s, recorded.events)
        return see_through(
            assignment, session, begin=_nothing, show=screen.show, wall=screen.wall, before=before
        )


def _nothing() -> None:
    """It goes on as it is."""
