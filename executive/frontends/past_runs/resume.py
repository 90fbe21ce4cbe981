"""The command `humanoid resume`: from its options to an exit status."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path
from typing import Any

import typer

from executive.frontends import do
from executive.frontends.past_runs import printing
from executive.frontends.prompt import cli as prompt
from executive.frontends.reality import REALITY
from executive.frontends.supervised import FrontEnd, oversee
from executive.journal import past_runs
from executive.runs import recording, resumption, task_run
from executive.runs.recording import Recording
from executive.runs.resumption import CannotGoOn, Screen
from executive.runs.run_folder import Summary
from robot.bringup.mailbox import Handle
from robot.clock import WallClock


def resume(run: str | None, *, model: Path | None = None, as_json: bool) -> int:
    """Go on with a run that was cut off (default: the newest); returns the exit status.

    Raises:
        RobotError: it cannot be gone on with (ConfigError), or a part does not start.
    """
    folder = past_runs.find(run)
    recorded = resumption.check(folder)
    if recorded.header.attended:
        return prompt.again(recorded, model)
    where, changed = recording.setting(recorded, REALITY)
    for change in changed:
        typer.echo(f"note: {change}, since it was recorded", err=True)
    if recorded.header.runtime != "fast":
        fresh = resumption.fresh_folder(
            recorded, stamp=f"{datetime.now().astimezone():%Y%m%d-%H%M%S}"
        )
        return _go_on_live(recorded, folder=fresh, as_json=as_json)
    try:
        summary = resumption.go_on_fast(recorded, where, _screen(folder.name, as_json=as_json))
    except CannotGoOn as end:
        typer.echo("It cannot be gone on with: it does not repeat.", err=True)
        typer.echo("\n".join(printing.differs(end.difference)), err=True)
        return do.FAILED
    return _ended(summary, as_json=as_json)


def _go_on_live(recorded: Recording, *, folder: Path, as_json: bool) -> int:
    """Go on with a live run with a new robot, as a run in `folder`; returns the exit status."""
    task = {"as_json": as_json, "left_by": str(recorded.folder), "folder": str(folder)}
    return oversee(FrontEnd.RESUME, task, as_json=as_json)


def overseen(handle: Handle, task: dict[str, Any]) -> int:
    """The executive's side of a live run that is gone on with; returns the exit status."""
    as_json = bool(task["as_json"])
    screen = _screen("", as_json=as_json)
    return _ended(resumption.live(task, handle, screen, reality=REALITY), as_json=as_json)


def _screen(name: str, *, as_json: bool) -> Screen:
    return Screen(
        following=lambda: printing.following(f"catching up with {name}", quiet=as_json),
        show=do.silent if as_json else do.on_screen,
        wall=WallClock(),
        time_of_day=lambda: datetime.now().astimezone().timestamp(),
    )


def _ended(summary: Summary, *, as_json: bool) -> int:
    if as_json:
        do.echo_json(summary)
    else:
        typer.echo("\n".join(task_run.closing(summary)))
    return summary.exit_status
