"""How everything truly moved in a simulated run, for people who look on: a line when it is news.

The simulation writes `truth.jsonl` into the run's folder, and consoles read it. No part of the
robot does: what it believes is in the journal's own files, and is drawn beside this.
"""

from __future__ import annotations

import os
import threading
from collections import deque
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path

import msgspec

from robot.closing import Closing
from robot.files.ordinary_files import open_to_append

FILE = "truth.jsonl"
MAX_LINE = 64_000
"""Bytes of a line; one in which all the things of a furnished flat are new has 5 kB."""
MOST_BYTES = 500_000_000
"""Of a file: what comes then is not kept."""
MOST_LINES = 200_000
"""Kept of a run: five hours in which something moves all the time."""
MOST_WAITING = 100
"""Lines for a disk that takes none: ten seconds. The oldest go."""

Flat = tuple[float, float, float, float, float, float, float]
"""A pose: x, y, z [m], and the quaternion w, x, y, z."""


class Truth(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """How everything is at a time.

    Attributes:
        t_s: the runtime's time.
        base: X_WB.
        objects: X_WO of those that are elsewhere than before, by id.
        people: the same of people.
    """

    t_s: float
    base: Flat
    objects: Mapping[str, Flat] = {}
    people: Mapping[str, Flat] = {}


_DECODER = msgspec.json.Decoder(Truth)


def decode(line: bytes) -> Truth | None:
    """What a line says; None if it is none, such as a line that was cut."""
    try:
        return _DECODER.decode(line)
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError):
        return None


class TrailFile(Closing):
    """Takes truths, and writes them in a thread of its own: no disk holds physics up."""

    def __init__(self, path: Path) -> None:
        """Begin; a file that cannot be written is left alone."""
        self._path = path
        self._waiting: deque[Truth] = deque(maxlen=MOST_WAITING)
        self._news = threading.Event()
        self._over = False
        self._thread = threading.Thread(target=self._work, name="truth", daemon=True)
        self._thread.start()

    def put(self, truth: Truth) -> None:
        """Have it written; never waits."""
        self._waiting.append(truth)
        self._news.set()

    def close(self) -> None:
        """Write what waits, and end."""
        self._over = True
        self._news.set()
        self._thread.join(1.0)

    def _work(self) -> None:
        with suppress(OSError):
            number = open_to_append(self._path)
            with os.fdopen(number, "ab") as file:
                while not self._over or self._waiting:
                    self._news.wait()
                    self._news.clear()
                    while self._waiting:
                        line = msgspec.json.encode(self._waiting.popleft(), order="deterministic")
                        if file.tell() + len(line) < MOST_BYTES:
                            file.write(line + b"\n")
                    file.flush()
