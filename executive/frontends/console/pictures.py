"""Pictures of a run as they come: where each stands in its file, and no picture in memory."""

from __future__ import annotations

import os
from bisect import bisect_right
from pathlib import Path
from typing import BinaryIO, NamedTuple

from robot import shots
from robot.files.ordinary_files import open_ordinary

CHUNK = 1 << 20
"""Bytes read at a time."""
MOST = 200_000
"""Pictures of a run."""


class Place(NamedTuple):
    """Where a picture stands in its file, and when it was taken."""

    t_s: float
    offset: int
    length: int


class Pictures:
    """The pictures of a file that grows; it may not be there yet.

    Attributes:
        places: of those that were found, in the order of time.
    """

    def __init__(self, path: Path) -> None:
        """Open nothing yet."""
        self.places: list[Place] = []
        self._path = path
        self._file: BinaryIO | None = None
        self._at = self._line_at = 0
        self._begun = b""

    def read(self) -> bool:
        """Find what has come since; whether there may be more at once."""
        file = self._file or self._opened()
        if file is None or self._at >= shots.MOST_BYTES or len(self.places) >= MOST:
            return False
        data = file.read(CHUNK)
        *whole, rest = (self._begun + data).split(b"\n")
        self._at += len(data)
        for line in whole:
            self._find(line)
            self._line_at += len(line) + 1
        if len(rest) > shots.MAX_LINE:  # no picture: its end is not one either
            self._line_at += len(rest) - 1
            rest = b"-"
        self._begun = rest
        return bool(data)

    def _find(self, line: bytes) -> None:
        t_s = shots.taken_s(line) if len(line) <= shots.MAX_LINE else None
        last_s = self.places[-1].t_s if self.places else float("-inf")
        if t_s is not None and t_s > last_s:
            self.places.append(Place(t_s, self._line_at, len(line)))

    def at(self, t_s: float | None) -> Place | None:
        """The last that was taken by a time, None: by now."""
        count = len(self.places)
        if t_s is not None:
            count = bisect_right(self.places, t_s, key=lambda place: place.t_s)
        return self.places[count - 1] if count else None

    def line(self, place: Place) -> bytes:
        """A picture as JSON; empty if it is none, or not there any more."""
        if self._file is None:
            return b""
        line = os.pread(self._file.fileno(), place.length, place.offset)
        return line if shots.decode(line) is not None else b""

    def _opened(self) -> BinaryIO | None:
        try:
            self._file = open_ordinary(self._path)
        except OSError:  # not there yet
            return None
        return self._file

    def close(self) -> None:
        """Close the file."""
        if self._file is not None:
            self._file.close()
            self._file = None
