"""How the executive asks the launcher above it for a robot: through files in a private folder.

===============  ==============================================================================
``front.json``   written by the launcher: which front end the executive runs, with its options
``run.json``     written by the executive: the robot and world it wants (`robot.bus.run.Run`)
``state.json``   written by the launcher: how the processes are, after every change
``flags``        whether the next executive hears people itself now, and whether these said stop
                 while it did not (`robot.bringup.flags`)
===============  ==============================================================================

The files outlive either process's death in the middle of anything: an executive that is started
again finds the run that is under way, and attaches to it.

What the launcher says again and again stands in place, in room that its first word takes: whoever
fills the disk or the memory that the folder is in, once a robot moves, keeps no spare from its
turn. A checksum tells a reader that it read between two words.
"""

from __future__ import annotations

import contextlib
import os
import struct
import zlib
from pathlib import Path
from typing import Any, TypeVar

import msgspec

from robot.bringup.flags import find
from robot.bus import run
from robot.bus.run import Run
from robot.errors import ProcessError
from robot.failures import Failure

FRONT_FILE, RUN_FILE, STATE_FILE = "front.json", "run.json", "state.json"


class Front(msgspec.Struct, frozen=True, kw_only=True):
    """What an executive is to do.

    Attributes:
        entry: name of the front end, which `executive.main` knows.
        options: its own, as plain data.
        deaths: how often executives of this run have died: not 0 means to go on, not to begin.
    """

    entry: str
    options: dict[str, Any]
    deaths: int = 0


class State(msgspec.Struct, frozen=True, kw_only=True):
    """How the robot's processes are: why the run cannot go on, what was restarted, process ids."""

    failure: Failure | None = None
    restarted: tuple[str, ...] = ()
    pids: dict[str, int] = {}


class Handle:
    """The executive's side: the processes as far as it knows them; a `Crew`.

    Attributes:
        folder: the private folder.
        deaths: how often executives of this run have died.
    """

    def __init__(self, folder: Path, *, deaths: int = 0) -> None:
        """Look at a folder that the launcher made."""
        self.folder = folder
        self.deaths = deaths
        self._state = State()

    @property
    def under_way(self) -> Run | None:
        """The run that an executive before this one asked for; None if there is none."""
        path = self.folder / RUN_FILE
        return run.load(path) if path.exists() else None

    def start(self, wanted: Run) -> None:
        """Ask for a robot, or attach to the one that runs.

        Raises:
            ProcessError: if another robot or world runs.
        """
        there = self.under_way
        if there is None:
            _leave(self.folder / RUN_FILE, wanted)
        elif there != wanted:
            raise ProcessError("this process has another robot already; start it anew")

    def hear(self) -> bool:
        """Say that people are heard from here on; whether they said stop while nobody could."""
        flags = find(self.folder)
        told = flags.take_stop()
        flags.say_it_hears(self.deaths)
        return flags.take_stop() or told

    @property
    def restarted(self) -> tuple[str, ...]:
        """What was started again, in order, a sentence each."""
        return self._read().restarted

    def check(self) -> Failure | None:
        """The first death that cannot be mended; None while all is well."""
        return self._read().failure

    def pid(self, name: str) -> int:
        """Process id of one of them. Raises KeyError if it was not started yet."""
        return self._read().pids[name]

    def close(self) -> None:
        """Leave the processes to the launcher, which stops them when this process ends."""

    def _read(self) -> State:
        self._state = read(self.folder / STATE_FILE, State) or self._state
        return self._state


def leave_stop_for_next(folder: Path) -> None:
    """Leave a stop where an executive takes over from a dead one, and does not hear people yet."""
    front = read(folder / FRONT_FILE, Front)
    with contextlib.suppress(OSError):  # that run has ended
        if front is not None and front.deaths and not (there := find(folder)).hears(front.deaths):
            there.leave_stop()


ROOM_BYTES = 1 << 16
"""Of a file that is written in place: sentences and paths, and every process that started again."""
CHECKSUM = struct.Struct("<I")
TRIES = 100
M = TypeVar("M", bound=msgspec.Struct)


def save(path: Path, value: msgspec.Struct) -> None:
    """Write a file in place, which `read` sees whole or not at all; only the first needs room.

    Raises:
        ProcessError: if it cannot be written.
    """
    data = msgspec.json.encode(value)
    try:
        file = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_NOFOLLOW | os.O_CLOEXEC, 0o600)
        with os.fdopen(file, "wb") as out:
            room = max(ROOM_BYTES, os.fstat(file).st_size) - CHECKSUM.size
            body = data.ljust(room)  # JSON may end with blanks
            out.write(CHECKSUM.pack(zlib.crc32(body)) + body)
    except OSError as error:
        raise _unsaid(path, error) from error


def read(path: Path, kind: type[M]) -> M | None:
    """What `save` wrote last; None if there is none yet, or no whole one was seen."""
    for _ in range(TRIES):
        try:
            whole = path.read_bytes()
        except FileNotFoundError:
            return None
        body = memoryview(whole)[CHECKSUM.size :]
        if whole[: CHECKSUM.size] == CHECKSUM.pack(zlib.crc32(body)):
            return msgspec.json.decode(body, type=kind)
    return None


def _leave(path: Path, value: msgspec.Struct) -> None:
    """Write a file once, that a reader sees whole or not at all."""
    fresh = path.with_suffix(".new")
    try:
        fresh.write_bytes(msgspec.json.encode(value))
        fresh.rename(path)
    except OSError as error:
        raise _unsaid(path, error) from error


def _unsaid(path: Path, error: OSError) -> ProcessError:
    return ProcessError(
        f"the processes of this run cannot speak to one another: {path} cannot be written "
        f"({error.strerror}); make room there, or run it with --fast"
    )
