"""Does a recorded `fast` run again and proves that the journal is the same, byte for byte."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import msgspec

from executive.engine.loop import Interrupts, Runtime
from executive.journal import journal
from executive.journal.files import Nowhere
from executive.journal.journal import Journal
from executive.meaning.request import Setting
from executive.runs import recording, runtimes
from executive.runs.comparison import Checked, Difference
from executive.runs.faults import Injector, SlowPlanner
from executive.runs.recording import Recording
from executive.runs.reenactment import Feeder
from executive.runs.session import Session
from robot.errors import ConfigError, Problem
from robot.planning.worker import Planner
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
    header = recorded.header
    with runtimes.opened("fast", where, seed=header.seed, folder=None) as (runtime, planner):
        run(recorded, where, runtime, planner, checked=checked, follow=follow)
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
    recorded: Recording,
    where: Setting,
    runtime: Runtime,
    planner: Planner,
    *,
    checked: Checked,
    follow: Follow,
) -> None:
    """Do it again on an opened runtime, up to the last recorded event or the first difference."""
    with opened(recorded, where, runtime, planner, checked=checked) as session:

        def over() -> bool:
            now_s = runtime.clock.now_s()
            late = now_s > recorded.last_s + GRACE_S
            return checked.complete or checked.difference is not None or late

        session.on_tick(lambda: follow(runtime.clock.now_s(), recorded.last_s))
        session.run(until=over)
        checked.end()


def opened(
    recorded: Recording,
    where: Setting,
    runtime: Runtime,
    planner: Planner,
    *,
    checked: Checked,
    interrupts: Interrupts | None = None,
    journal: Journal | None = None,
) -> Session:
    """A session that is asked for everything that was asked for in the recorded one.

    Args:
        recorded: the run.
        where: its setting, as it is now.
        runtime: entered, at its beginning.
        planner: answers the skills' requests.
        checked: compares the lines of the journal.
        interrupts: of somebody who is there now.
        journal: that writes to `checked`, a new one by default.
    """
    slow = SlowPlanner(planner)
    session = Session(
        runtime,
        slow,
        description=where.description,
        interrupts=interrupts or Interrupts(),
        seed=recorded.header.seed,
        journal=journal or Journal(lines=checked),
    )
    session.executive.attended = recorded.header.attended
    plans = recording.planned_faults(recorded, where)
    injector = Injector(
        plans,
        runtime,
        session.journal,
        begin_s=runtime.clock.now_s(),
        seed=recorded.header.seed,
        planner=slow,
        kill=_survive,
    )
    inputs = [event for event in recorded.inputs if event.event == "request" or not plans]
    feeder = Feeder(
        session,
        inputs,
        restore=lambda event: recording.restore(event, recorded.folder, where),
        injector=injector,
    )
    session.journal.write(recorded.events[0].t_s, "run", **recorded.events[0].data)
    feeder.feed()
    session.on_tick(feeder.feed)
    return session


def _survive() -> None:
    """A killed executive is one that is not there: the one that does it again lives on."""
