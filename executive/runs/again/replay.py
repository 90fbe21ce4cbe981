"""Does a recorded `fast` run again and proves that the journal is the same, byte for byte."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import msgspec

from executive.engine.loop import Interrupts
from executive.journal import journal
from executive.journal.files import Nowhere
from executive.journal.journal import Journal
from executive.runs import runtimes
from executive.runs.again import recording
from executive.runs.again.comparison import Checked, Difference
from executive.runs.again.recording import Recording
from executive.runs.again.requests import Feeder
from executive.runs.runtimes import Opened, Setup
from executive.runs.session import Session
from robot.errors import ConfigError, Problem
from robot.reality.contract import Reality

GRACE_S = 1.0
"""How long after the last recorded event it is waited for one that has not come."""

Follow = Callable[[float, float], None]
"""Called with the time reached and the time of the end, both in seconds of the run."""


class Replayed(msgspec.Struct, frozen=True, kw_only=True):
    """What a replay found: `difference` None means identical, all `events` of them."""

    folder: str
    events: int
    simulated_s: float
    changed: list[str]
    difference: Difference | None = None
    cut: bool = False


def replay(folder: Path, reality: Reality, *, follow: Follow) -> Replayed:
    """Do a run again.

    Args:
        folder: of the run.
        reality: that its world is of.
        follow: shows how far it is.

    Raises:
        ConfigError: if it cannot be done again: it ran live, is under way, or is not whole.
    """
    recorded = recording.load(folder)
    check(recorded)
    where, changed = recording.setting(recorded, reality)
    checked = Checked(recorded.lines, onward=None if recorded.ended else Nowhere())
    setup = Setup(where=where, seed=recorded.header.seed)
    with runtimes.opened(setup) as robot:
        run(recorded, setup, robot, checked=checked, follow=follow)
    return Replayed(
        folder=str(folder),
        events=checked.count,
        simulated_s=recorded.last_s,
        changed=changed,
        difference=checked.difference,
        cut=not recorded.ended,
    )


def check(recorded: Recording) -> None:
    """Refuse what cannot repeat.

    Raises:
        ConfigError: if it ran live, or is under way.
    """
    folder = recorded.folder
    if recorded.header.runtime != "fast":
        why = "it ran live, on the wall clock and with processes of their own, which never repeat"
        cure = "runs with --fast can be replayed; `humanoid why` explains any run"
        raise ConfigError([Problem(f"{folder} cannot be replayed: {why}", suggestion=cure)])
    if journal.is_written(folder):
        raise ConfigError([Problem(f"{folder} is under way", suggestion="wait until it has ended")])


def run(
    recorded: Recording, setup: Setup, robot: Opened, *, checked: Checked, follow: Follow
) -> None:
    """Do it again on a robot that is up, to the last recorded event or the first difference."""
    with reenacted(recorded, setup, robot, checked=checked) as session:
        catch_up(session, recorded, checked=checked, follow=follow)


def catch_up(session: Session, recorded: Recording, *, checked: Checked, follow: Follow) -> None:
    """Let a session do again what is recorded, as far as it is the same."""
    last_s = recorded.last_s

    def over() -> bool:
        late = session.now_s > last_s + GRACE_S
        return checked.complete or checked.difference is not None or late

    session.on_tick(lambda: None if checked.complete else follow(session.now_s, last_s))
    session.run(until=over)
    checked.end()


def reenacted(
    recorded: Recording,
    setup: Setup,
    robot: Opened,
    *,
    checked: Checked,
    interrupts: Interrupts | None = None,
    journal: Journal | None = None,
) -> Session:
    """A session that is asked for everything that was asked for in the recorded one.

    Args:
        recorded: the run.
        setup: that of the run, as it is now.
        robot: that is up, at its beginning.
        checked: compares the lines of the journal.
        interrupts: of somebody who is there now.
        journal: that writes to `checked`, a new one by default.
    """
    plans = recording.planned_faults(recorded, setup.where)
    session = Session(
        setup,
        robot,
        interrupts=interrupts,
        journal=journal or Journal(lines=checked),
        faults=plans,
        kill=_survive,
        attended=recorded.header.attended,
    )
    feeder = Feeder(
        session,
        [event for event in recorded.inputs if event.event == "request" or not plans],
        restore=lambda event: recording.assigned(event, recorded.folder, setup.where),
    )
    session.journal.write(recorded.events[0].t_s, "run", **recorded.events[0].data)
    feeder.feed()
    session.on_tick(feeder.feed)
    return session


def _survive() -> None:
    """A killed executive is one that is not there: the one that does it again lives on."""
