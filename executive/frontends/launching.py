"""Front ends on their way: `fast` in this process, live in an executive below a launcher.

A front end is a function of its options and a handle on its robot's processes (None in `fast`). It
is the executive's process that understands what was asked for, and refuses it before it starts the
robot; one that was started again (`handle.deaths`) goes on with the run that is under way.
"""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import msgspec

from executive.frontends import streams
from executive.frontends.exit import last_words
from executive.frontends.output import say
from robot.bringup.mailbox import Handle
from robot.bus.run import Run

if TYPE_CHECKING:
    from executive.engine.loop import Interrupts

T = TypeVar("T")

PlainFrontEnd = Callable[[Handle | None, dict[str, Any]], int]
"""A front end as a process calls it: with a handle on the robot's, if any, and plain options."""


class FrontEnd(StrEnum):
    """What an executive can be there for; `executive.main` has the function of each."""

    DO = "do"
    LISTEN = "listen"
    MISSION = "mission"
    PROMPT = "prompt"
    RESUME = "resume"
    SERVICE = "service"


def here(front: PlainFrontEnd, options: object) -> int:
    """Run a front end in this process, in `fast`; returns the exit status.

    Args:
        front: what `from_plain_options` made.
        options: of the front end, a struct or a dataclass.

    Raises:
        RobotError: as the front end does.
    """
    streams.beside_work()
    return front(None, msgspec.to_builtins(options, enc_hook=str))


def launch(front: FrontEnd, options: object, *, as_json: bool = False) -> int:
    """Run a front end in an executive of its own; returns the exit status.

    Args:
        front: which one.
        options: of the front end, a struct or a dataclass.
        as_json: nothing but JSON goes to standard output.

    Raises:
        FileNotFoundError: the current folder is not there any more.
    """
    Path.cwd()  # here, where it can be told: no process of a run can begin in it
    from robot.bringup import launcher  # half of what the command line would take to load

    plain = msgspec.to_builtins(options, enc_hook=str)
    ended = launcher.launch(front, plain, tell=lambda line: say(line, err=True))
    if ended.wished:
        return last_words("Stopped on request.", [], "", status=ended.status, as_json=as_json)
    if ended.reason:
        cure = "see `humanoid why`; `humanoid resume` goes on where it was"
        return last_words("Broken:", [ended.reason], cure, status=ended.status, as_json=as_json)
    return ended.status


def from_plain_options(kind: type[T], front: Callable[[T, Handle | None], int]) -> PlainFrontEnd:
    """A front end as the executive's process calls it: with plain data for options."""

    def run(handle: Handle | None, plain: dict[str, Any]) -> int:
        return front(msgspec.convert(plain, kind, dec_hook=_path), handle)

    return run


def _path(kind: type[Any], value: object) -> object:
    """A path, from plain data."""
    return kind(value)


def under_way(handle: Handle | None) -> Run | None:
    """The run that an executive before this one has begun; None where there was none."""
    return handle.under_way if handle is not None and handle.deaths else None


def hear_people(handle: Handle | None, interrupts: Interrupts) -> None:
    """Say that this executive hears people from now on; what they said before counts, too."""
    if handle is not None and handle.hear():
        interrupts.wish()


def now_stamp() -> str:
    """The time of day, as folders of runs are called by it."""
    return f"{datetime.now().astimezone():%Y%m%d-%H%M%S}"


def folder_for(wanted: Path | None, text: str, handle: Handle | None = None) -> Path:
    """The folder of a run: of the one that is under way, the one wanted, or a new one.

    Raises:
        ConfigError: if the one wanted holds a run already, or another one uses it.
    """
    from executive.journal import places
    from executive.runs import run_folder

    there = under_way(handle)
    if there is not None:
        run_folder.claim(Path(there.folder))
        return Path(there.folder)
    folder = wanted or new_folder(text)
    run_folder.claim(folder, wanted=wanted is not None)
    run_folder.check_free(folder)
    if wanted is not None:
        places.remember_outside(folder)
    return folder


def new_folder(text: str) -> Path:
    """A new folder for a run, where others cannot exchange it; says so where that is at home.

    Raises:
        ConfigError: if there is no such place.
    """
    from executive.journal import places
    from executive.runs import run_folder

    base, why = run_folder.place_for_new()
    if why:
        say(why, err=True)
    places.remember(base)
    return run_folder.folder_for(text, stamp=now_stamp(), base=base)
