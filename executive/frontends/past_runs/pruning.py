"""`humanoid runs prune`: makes room by removing run folders that nobody needs any more."""

from __future__ import annotations

import os
import shutil
import stat
import sys
import time
from collections.abc import Generator
from contextlib import contextmanager, suppress
from itertools import islice
from pathlib import Path

from executive.frontends.output import ask, say
from executive.journal import holding, journal, past_runs, places
from robot.errors import ConfigError, Problem
from robot.exit_status import ExitStatus
from robot.files.exchangeable import check_way

DAY_S = 86_400.0
MOST_FILES = 100_000
"""Of one run, whose sizes are added up."""
SHOWN = 10


def prune(
    *, keep: int | None, older_than_days: float | None, everywhere: bool, yes: bool, dry_run: bool
) -> int:
    """Remove run folders that are both beyond the newest and old enough; returns the exit status.

    Args:
        keep: so many of the newest stay, whatever their age.
        older_than_days: younger ones stay.
        everywhere: of every folder in which something was run.
        yes: without asking.
        dry_run: only say which.

    Raises:
        ConfigError: it is not said which may go, or nobody is there to be asked.
    """
    if keep is None and older_than_days is None:
        cure = "say --keep 20, or --older-than 30"
        raise ConfigError([Problem("it is not said which runs may go", suggestion=cure)])
    known = past_runs.runs(places=places.everywhere() if everywhere else places.all_places())
    old = chosen(known, keep=keep or 0, older_than_days=older_than_days, now_s=time.time())
    free = [folder for folder in old if _why_not(folder) == ""]
    _tell_kept([folder for folder in old if folder not in free])
    if not free:
        say("There is nothing to remove.")
        return ExitStatus.DONE
    size = sum(map(size_bytes, free))
    for folder in free[:SHOWN]:
        say(f"  {folder}")
    if len(free) > SHOWN:
        say(f"  ... and {len(free) - SHOWN} more")
    say(f"{len(free)} of {_runs(len(known))}, {size / 1e6:.1f} MB")
    if dry_run:
        return ExitStatus.DONE
    if not yes and not _agreed():
        say("Nothing was removed.")
        return ExitStatus.FAILED
    kept = [folder for folder in free if not removed(folder)]
    _tell_kept(kept)
    say(f"Removed: {_runs(len(free) - len(kept))}.")
    return ExitStatus.FAILED if kept else ExitStatus.DONE


def _runs(count: int) -> str:
    return f"{count} run{'' if count == 1 else 's'}"


def chosen(
    known: list[Path], *, keep: int, older_than_days: float | None, now_s: float
) -> list[Path]:
    """Which of the runs, the oldest first, are beyond the newest `keep` and old enough."""
    beyond = known[: max(0, len(known) - keep)]
    if older_than_days is None:
        return beyond
    limit_s = now_s - older_than_days * DAY_S
    return [folder for folder in beyond if past_runs.began_s(folder) < limit_s]


def removed(folder: Path) -> bool:
    """Remove a run, if nobody uses it; whether it is gone."""
    with _held(folder) as free:
        if not free:
            return False
        with suppress(RecursionError):  # nested as no run is
            shutil.rmtree(folder, ignore_errors=True)
    return not os.path.lexists(folder)


def size_bytes(folder: Path) -> int:
    """How much room a run takes."""
    total, left, folders = 0, MOST_FILES, [folder]
    while folders and left > 0:
        try:
            with os.scandir(folders.pop()) as entries:
                for entry in islice(entries, left):
                    left -= 1
                    found = entry.stat(follow_symlinks=False)
                    total += found.st_size
                    if stat.S_ISDIR(found.st_mode):
                        folders.append(Path(entry.path))
        except OSError:
            continue
    return total


def _why_not(folder: Path) -> str:
    """Why a run may not be removed; empty if it may."""
    try:
        found = folder.lstat()
    except OSError:
        return "is gone"
    if not stat.S_ISDIR(found.st_mode):
        return "is a link"
    if way := _wrong_way(folder.parent):
        return way
    if found.st_uid != os.geteuid():
        return "belongs to another user"
    return "is under way" if journal.is_written(folder) else ""


def _wrong_way(place: Path) -> str:
    """Why nothing is removed from a folder: somebody could put another one, or a link, there."""
    if place.is_symlink():
        return f"is reached through a link, {place}"
    try:
        check_way(place, cure="")
    except ConfigError as refused:
        return f"lies where somebody could exchange it: {refused.problems[0].message}"
    return ""


@contextmanager
def _held(folder: Path) -> Generator[bool]:
    """Keep runs out of a folder inside the block; whether that could be done."""
    if _wrong_way(folder.parent):
        yield False
        return
    try:
        opened = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC)
    except OSError:
        yield False
        return
    try:
        held = holding.hold(folder, opened)
    except OSError:
        yield False
        return
    finally:
        os.close(opened)
    try:
        yield True
    finally:
        os.close(held)


def _tell_kept(folders: list[Path]) -> None:
    for folder in folders:
        say(f"  stays: {folder} {_why_not(folder) or 'cannot be removed'}", err=True)


def _agreed() -> bool:
    """Whether the person says so. Raises ConfigError if nobody is there."""
    if not sys.stdin.isatty():
        cure = "add --yes, or --dry-run to look first"
        raise ConfigError([Problem("nobody is there to be asked", suggestion=cure)])
    try:
        return ask("Remove them? [y/N]").strip().casefold() in ("y", "yes")
    except EOFError:
        return False
