"""A run as MCAP while it goes on: read from its files, so that nothing can hold the robot up."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from pathlib import Path
from typing import BinaryIO

from executive.frontends.console.following import Tail
from executive.frontends.dump.foxglove import Writer
from executive.frontends.dump.looks import began_s, looks
from executive.journal import journal, motion
from executive.journal.reader import Reader

CHUNK_BYTES = 1 << 17
"""Written at a time: a crash takes along what came in the last second or two."""
LOOK_EVERY_S = 0.25


class Recording:
    """A file that a run is written to as far as it has come.

    Attributes:
        last_s: the robot's time up to which movements were written [s]; -inf before the first.
    """

    def __init__(self, folder: Path, file: BinaryIO) -> None:
        """Read nothing yet; the file is written once it is known where the run is.

        Args:
            folder: of the run.
            file: new and empty; whoever opened it closes it.
        """
        self._folder, self._file = folder, file
        self._reader = Reader()
        self._writer: Writer | None = None
        self._events = Tail(
            folder / journal.FILE, longest=journal.MAX_LINE, most=journal.MOST_BYTES
        )
        self._motion = Tail(folder / motion.FILE, longest=motion.MAX_LINE, most=motion.MOST_BYTES)
        self.last_s = -math.inf

    def take(self) -> bool:
        """Write what has come since; whether there may be more at once."""
        lines = self._events.lines()
        events = [event for line in lines if (event := journal.decode(line)) is not None]
        for line in lines:
            self._reader.line(line + b"\n")
        writer = self._writer or self._begun()
        if writer is None:
            return bool(lines)
        for event in events:
            writer.event(event)
        writer.news(self._reader.run)
        moves = self._motion.lines()
        for line in moves:
            moment = motion.decode(line)
            if moment is None or abs(moment.t_s) >= journal.MOST_S:
                continue
            if moment.t_s > self.last_s:
                self.last_s = moment.t_s
                writer.moment(moment)
        self._file.flush()
        return bool(lines or moves)

    def _begun(self) -> Writer | None:
        """The writer, once the first event says where the run is."""
        run = self._reader.run
        if not run.events:
            return None
        motors, scene = looks(run, self._folder)
        self._writer = Writer(
            self._file,
            scene=scene,
            motors=motors,
            began_s=began_s(self._folder, run),
            begin_s=run.begin_s,
            chunk_bytes=CHUNK_BYTES,
        )
        return self._writer

    def close(self) -> None:
        """Write the index, which readers that seek need."""
        if self._writer is not None:
            self._writer.close()
        self._events.close()
        self._motion.close()


def follow(
    folder: Path, file: BinaryIO, *, is_over: Callable[[], bool], tell: Callable[[float], object]
) -> None:
    """Write a run to a file until it is over, or to where it had come when that is known.

    Args:
        folder: of the run.
        file: new and empty.
        is_over: whether no more will come.
        tell: is told the robot's time up to which it has come.
    """
    recording = Recording(folder, file)
    try:
        while True:
            over = is_over()  # before what is left is read: nothing comes after it
            while recording.take():
                tell(max(0.0, recording.last_s))
            if over:
                return
            time.sleep(LOOK_EVERY_S)
    finally:
        recording.close()
