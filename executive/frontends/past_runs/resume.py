"""The command `humanoid resume`: from its options to an exit status."""

from __future__ import annotations

import time
from dataclasses import dataclass
from pathlib import Path

from executive.frontends import carrying_out
from executive.frontends.carrying_out import UNSEEN, Prepared
from executive.frontends.composition_root import REALITY
from executive.frontends.console.beside import shown as viewed
from executive.frontends.driving import chosen
from executive.frontends.dump.record import recorded as saved
from executive.frontends.launching import FrontEnd, from_plain_options, launch, now_stamp, under_way
from executive.frontends.options import Shown, Viewed
from executive.frontends.output import say
from executive.frontends.past_runs import printing
from executive.frontends.prompt.attached import attached
from executive.journal import past_runs
from executive.meaning.request import Setting
from executive.runs import run_folder
from executive.runs.again import catching_up, recording
from executive.runs.again.catching_up import CannotGoOn, Screen
from executive.runs.again.continuation import left_in
from executive.runs.again.recording import Recording
from executive.runs.runtimes import Setup
from robot.bringup.mailbox import Handle
from robot.clock import WallClock
from robot.exit_status import ExitStatus


@dataclass(frozen=True, kw_only=True)
class GoOn(Shown, Viewed):
    """A live run that is gone on with: its folder."""

    left_by: Path


def resume(
    run: str | None,
    *,
    model: Path | None = None,
    as_json: bool,
    page: Viewed = UNSEEN,
) -> int:
    """Go on with a run that was cut off (default: the newest); returns the exit status.

    Raises:
        RobotError: it cannot be gone on with (ConfigError), or a part does not start.
    """
    recorded = catching_up.check(past_runs.find_cut_off(run))
    if recorded.header.attended:
        from executive.frontends.prompt.cli import go_on_with

        return go_on_with(recorded, model, page)
    if recorded.header.runtime == "fast":
        return _go_on_fast(recorded, page, as_json=as_json)
    wanted = GoOn(left_by=recorded.folder, as_json=as_json, view=page.view, record=page.record)
    return launch(FrontEnd.RESUME, wanted, as_json=as_json)


def _go_on_fast(recorded: Recording, page: Viewed, *, as_json: bool) -> int:
    where, changed = recording.setting(recorded, REALITY)
    _note(changed)
    words = f"catching up with {recorded.folder.name}"
    screen = Screen(
        following=lambda: printing.following(words, quiet=as_json),
        show=carrying_out.show_for(Shown(as_json=as_json)),
        wall=WallClock(),
        time_of_day=time.time,
    )
    try:
        with (
            viewed(recorded.folder, wanted=page.view, err=as_json),
            saved(recorded.folder, wanted=page.record, err=as_json),
        ):
            summary = catching_up.go_on(recorded, where, screen)
    except CannotGoOn as end:
        say("It cannot be gone on with: it does not repeat.", err=True)
        say("\n".join(printing.differs(end.difference)), err=True)
        return ExitStatus.FAILED
    carrying_out.say_how_it_ended(summary, as_json=as_json)
    return summary.exit_status


def go_on_live(wanted: GoOn, handle: Handle | None = None) -> int:
    """Go on with a live run with a new robot, as a run of its own; returns the exit status.

    Raises:
        RobotError: as `resume` does.
    """

    def prepare() -> Prepared:
        recorded = catching_up.check(wanted.left_by)
        where, changed = recording.setting(recorded, REALITY)
        _note(changed)
        left = left_in(recorded.folder)
        assignment = left.newest(where)
        assert assignment is not None, "the recording holds a submission"
        there, beside = under_way(handle), recorded.folder.parent
        folder = (
            Path(there.folder)
            if there
            else run_folder.folder_for(recorded.header.text, stamp=now_stamp(), base=beside)
        )
        setup = Setup(
            where=where,
            kind="live",
            seed=recorded.header.seed,
            folder=folder,
            driver=there.motors if there else _driver(recorded, where, err=wanted.as_json),
        )
        return Prepared(assignment=assignment, setup=setup, left=left)

    return carrying_out.carry_out(prepare, wanted, handle, page=wanted, attend=attached)


def _driver(recorded: Recording, where: Setting, *, err: bool) -> str:
    """The driver that moved its motors. Raises ConfigError if it cannot any more."""
    return chosen(recorded.header.driver, where.description, fast=False, err=err)


in_executive = from_plain_options(GoOn, go_on_live)


def _note(changed: list[str]) -> None:
    for change in changed:
        say(f"note: {change}, since it was recorded", err=True)
