"""The command `humanoid resume`: from its options to an exit status."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime
from pathlib import Path
from typing import Any

import typer

from executive import commands, doing
from executive.history import past, recording, resuming, showing
from executive.history.recording import Recording
from executive.history.resuming import CannotGoOn, Screen
from executive.runs import Summary
from robot.bringup import entry
from robot.bringup.mailbox import Handle
from robot.clock import WallClock

PROMPT = "executive.repl.cli:again"
"""Goes on with what was done at the prompt, at the prompt."""


def resume(run: str | None, *, model: Path | None = None, as_json: bool) -> int:
    """Go on with a run that was cut off (default: the newest); returns the exit status.

    Raises:
        RobotError: it cannot be gone on with (ConfigError), or a part does not start.
    """
    folder = past.find(run)
    recorded = resuming.check(folder)
    if recorded.header.attended:
        again: Callable[[Recording, Path | None], int] = entry.attribute(PROMPT)
        return again(recorded, model)
    where, changed = recording.setting(recorded)
    for change in changed:
        typer.echo(f"note: {change}, since it was recorded", err=True)
    if recorded.header.runtime != "fast":
        fresh = resuming.fresh_folder(
            recorded, stamp=f"{datetime.now().astimezone():%Y%m%d-%H%M%S}"
        )
        return resuming.go_on_live(recorded, folder=fresh, as_json=as_json)
    try:
        summary = resuming.go_on_fast(recorded, where, _screen(folder.name, as_json=as_json))
    except CannotGoOn as end:
        typer.echo("It cannot be gone on with: it does not repeat.", err=True)
        typer.echo("\n".join(showing.differs(end.difference)), err=True)
        return commands.FAILED
    return _ended(summary, as_json=as_json)


def overseen(handle: Handle, task: dict[str, Any]) -> int:
    """The executive's side of a live run that is gone on with; returns the exit status."""
    as_json = bool(task["as_json"])
    return _ended(resuming.live(task, handle, _screen("", as_json=as_json)), as_json=as_json)


def _screen(name: str, *, as_json: bool) -> Screen:
    return Screen(
        following=lambda: showing.following(f"catching up with {name}", quiet=as_json),
        show=commands.silent if as_json else commands.on_screen,
        wall=WallClock(),
        time_of_day=lambda: datetime.now().astimezone().timestamp(),
    )


def _ended(summary: Summary, *, as_json: bool) -> int:
    if as_json:
        commands.echo_json(summary)
    else:
        typer.echo("\n".join(doing.closing(summary)))
    return summary.exit_status
