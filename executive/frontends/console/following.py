"""Reads a run as it grows: its journal and how everything moved, from their files alone.

A watcher that reads files cannot hold up who writes them, whatever becomes of it; and a run that is
over is watched in the same way.
"""

from __future__ import annotations

import math
import os
from pathlib import Path
from typing import BinaryIO

from executive.frontends.console.pictures import Pictures
from executive.journal import journal, motion, sensed
from executive.journal.reader import Reader
from executive.journal.run import Run
from robot import shots
from robot.ordinary_files import open_ordinary

CHUNK = 1 << 20
"""Bytes read at a time, so that a long file holds nobody up."""


class Tail:
    """The lines of a file that grows, may not be there yet, and may be begun anew."""

    def __init__(self, path: Path, *, longest: int, most: int) -> None:
        """Open nothing yet.

        Args:
            path: of the file.
            longest: bytes of a line; what is longer is passed over.
            most: bytes that are read at all.
        """
        self._path = path
        self._longest = longest
        self._most = most
        self._file: BinaryIO | None = None
        self._taken = 0
        self._begun = b""

    def lines(self) -> list[bytes]:
        """What has come since the last time, up to `CHUNK` bytes of it, without ends of lines."""
        file = self._file or self._opened()
        if file is None or self._taken >= self._most:
            return []
        data = file.read(CHUNK)
        self._taken += len(data)
        *whole, self._begun = (self._begun + data).split(b"\n")
        if len(self._begun) > self._longest:
            self._begun = b""
        return [line for line in whole if line and len(line) <= self._longest]

    def _opened(self) -> BinaryIO | None:
        try:
            file = open_ordinary(self._path)
        except OSError:  # not there yet
            return None
        os.posix_fadvise(file.fileno(), 0, 0, os.POSIX_FADV_SEQUENTIAL)
        self._file = file
        return file

    def close(self) -> None:
        """Close the file."""
        if self._file is not None:
            self._file.close()
            self._file = None


class Following:
    """A run as far as it has been read.

    Attributes:
        folder: of the run.
        moments: how everything moved, each as the JSON that the page is given.
        last_s: the time of the last of them.
        sensed: what was sensed and planned, in the same way.
        pictures: what the camera saw, by kind.
    """

    def __init__(self, folder: Path) -> None:
        """Read nothing yet."""
        self.folder = folder
        self.moments: list[bytes] = []
        self.last_s = -math.inf
        self.sensed: list[bytes] = []
        self.pictures = {
            "colour": Pictures(folder / shots.COLOUR_FILE),
            "depth": Pictures(folder / shots.DEPTH_FILE),
        }
        self._sensed_s = -math.inf
        self._reader = Reader()
        self._events = Tail(
            folder / journal.FILE, longest=journal.MAX_LINE, most=journal.MOST_BYTES
        )
        self._motion = Tail(folder / motion.FILE, longest=motion.MAX_LINE, most=motion.MOST_BYTES)
        self._senses = Tail(folder / sensed.FILE, longest=sensed.MAX_LINE, most=sensed.MOST_BYTES)

    @property
    def run(self) -> Run:
        """What has happened so far."""
        return self._reader.run

    @property
    def live(self) -> bool:
        """Whether somebody writes it."""
        return journal.is_written(self.folder)

    def read(self) -> bool:
        """Take what has come since; whether there may be more at once."""
        events, moves, senses = self._events.lines(), self._motion.lines(), self._senses.lines()
        for line in events:
            self._reader.line(line + b"\n")
        for line in moves:
            self._move(line)
        for line in senses:
            self._sense(line)
        seen = [one.read() for one in self.pictures.values()]
        return bool(events or moves or senses) or any(seen)

    def _move(self, line: bytes) -> None:
        moment = motion.decode(line)
        sane = moment is not None and moment.t_s > self.last_s
        if moment is not None and sane and len(self.moments) < motion.MOST_MOMENTS:
            self.last_s = moment.t_s
            self.moments.append(line)

    def _sense(self, line: bytes) -> None:
        one = sensed.decode(line)
        if one is None or one.t_s <= self._sensed_s or len(self.sensed) >= sensed.MOST_LINES:
            return
        self._sensed_s = one.t_s
        self.sensed.append(line)

    def close(self) -> None:
        """Close the files."""
        for one in (self._events, self._motion, self._senses, *self.pictures.values()):
            one.close()
