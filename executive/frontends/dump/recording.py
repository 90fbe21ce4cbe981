"""A run as MCAP while it goes on: read from its files, so that nothing can hold the robot up."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable, Iterator
from itertools import takewhile
from pathlib import Path
from typing import BinaryIO, TypeVar

from executive.frontends.console.tail import Tail
from executive.frontends.dump.foxglove import Writer
from executive.frontends.dump.looks import began_s, looks
from executive.frontends.end_signals import Ending
from executive.journal import journal, motion, sensed
from executive.journal.reader import Reader
from robot import shots

T = TypeVar("T")

CHUNK_BYTES = 1 << 17
"""Written at a time: a crash takes along what came in the last second or two."""
LOOK_EVERY_S = 0.25


class Recording:
    """A file that a run is written to as far as it has come.

    Attributes:
        last_s: the robot's time up to which movements were written [s]; -inf before the first.
    """

    def __init__(self, folder: Path, file: BinaryIO, ending: Ending) -> None:
        """Read nothing yet; the file is written once it is known where the run is.

        Args:
            folder: of the run.
            file: new and empty; whoever opened it closes it.
            ending: ends it in the middle of what it takes.
        """
        self._folder, self._file, self._ending = folder, file, ending
        self._reader = Reader()
        self._writer: Writer | None = None
        self._events = Tail(
            folder / journal.FILE, longest=journal.MAX_LINE, most=journal.MOST_BYTES
        )
        self._motion = Tail(folder / motion.FILE, longest=motion.MAX_LINE, most=motion.MOST_BYTES)
        self._sensed = Tail(folder / sensed.FILE, longest=sensed.MAX_LINE, most=sensed.MOST_BYTES)
        self._pictures = [
            Tail(folder / name, longest=shots.MAX_LINE, most=shots.MOST_BYTES)
            for name in (shots.COLOUR_FILE, shots.DEPTH_FILE)
        ]
        self.last_s = -math.inf

    def take(self) -> bool:
        """Write what has come since; whether there may be more at once.

        Raises:
            KeyboardInterrupt: it was to end before it was known where the run is.
        """
        lines = self._events.lines()
        events: list[journal.Event] = []
        for line in self._until_asked(lines):
            if (event := journal.decode(line)) is not None:
                events.append(event)
            self._reader.line(line + b"\n")
        writer = self._writer or self._begun()
        if writer is None:
            return bool(lines)
        for event in self._until_asked(events):
            writer.event(event)
        writer.news(self._reader.run)
        moves = self._motion.lines()
        for line in self._until_asked(moves):
            moment = motion.decode(line)
            if moment is None or abs(moment.t_s) >= journal.MOST_S:
                continue
            if moment.t_s > self.last_s:
                self.last_s = moment.t_s
                writer.moment(moment)
        senses = self._sensed.lines()
        for line in self._until_asked(senses):
            one = sensed.decode(line)
            if one is not None and abs(one.t_s) < journal.MOST_S:
                writer.sensed(one)
        seen = [line for pictures in self._pictures for line in pictures.lines()]
        for line in self._until_asked(seen):
            shot = shots.decode(line)
            if shot is not None and abs(shot.t_s) < journal.MOST_S:
                writer.shot(shot)
        self._file.flush()
        return bool(lines or moves or senses or seen)

    def _until_asked(self, items: Iterable[T]) -> Iterator[T]:
        """Those of a list, until it is to end."""
        return takewhile(lambda _: not self._ending.asked, items)

    def _begun(self) -> Writer | None:
        """The writer, once the first event says where the run is."""
        run = self._reader.run
        if not run.events:
            return None
        with self._ending.breaking():  # a world, or a file without sense, takes its time
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
        for one in (self._motion, self._sensed, *self._pictures):
            one.close()


def follow(
    folder: Path,
    file: BinaryIO,
    *,
    ending: Ending,
    is_over: Callable[[], bool],
    tell: Callable[[float], object],
) -> None:
    """Write a run to a file until it is over, to where it had come when that is known.

    Args:
        folder: of the run.
        file: new and empty.
        ending: ends it at once, to where it has read.
        is_over: whether no more will come.
        tell: is told the robot's time up to which it has come.
    """
    recording = Recording(folder, file, ending)
    try:
        while not ending.asked:
            over = is_over()  # before what is left is read: nothing comes after it
            while not ending.asked and recording.take():
                tell(max(0.0, recording.last_s))
            if over:
                return
            time.sleep(LOOK_EVERY_S)
    except KeyboardInterrupt:
        if not ending.asked:
            raise
    finally:
        recording.close()
