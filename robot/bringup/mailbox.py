"""How the executive asks the launcher above it for a robot: through files in a private folder.

===============  ==============================================================================
``front.json``   written by the launcher: which front end the executive runs, with its options
``run.json``     written by the executive: the robot and world it wants (`robot.bus.run.Run`)
``state.json``   written by the launcher: how the processes are, after every change
===============  ==============================================================================

The files outlive either process's death in the middle of anything: an executive that is started
again finds the run that is under way, and attaches to it.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import msgspec

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
        self._seen = (0, 0)

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
            save(self.folder / RUN_FILE, wanted)
        elif there != wanted:
            raise ProcessError("this process has another robot already; start it anew")

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
        path = self.folder / STATE_FILE
        try:
            now = path.stat()
            seen = (now.st_mtime_ns, now.st_ino)
            if seen != self._seen:
                self._state = msgspec.json.decode(path.read_bytes(), type=State)
                self._seen = seen
        except FileNotFoundError:
            pass
        return self._state


def save(path: Path, value: msgspec.Struct) -> None:
    """Write a file that a reader sees whole or not at all."""
    fresh = path.with_suffix(".new")
    fresh.write_bytes(msgspec.json.encode(value))
    fresh.rename(path)
