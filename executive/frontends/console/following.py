"""Reads a run as it grows: its journal and how everything moved, from their files alone.

A watcher that reads files cannot hold up who writes them, whatever becomes of it; and a run that is
over is watched in the same way.
"""

from __future__ import annotations

from pathlib import Path

from executive.frontends.console.kept import Kept
from executive.frontends.console.pictures import Pictures
from executive.frontends.console.tail import Tail
from executive.journal import journal, motion, sensed
from executive.journal.reader import Reader
from executive.journal.run import Run
from robot import shots
from robot.reality import trail


class Following:
    """A run as far as it has been read.

    Attributes:
        folder: of the run.
        moments: how everything moved, each line the JSON that the page is given.
        sensed: what was sensed and planned, in the same way.
        truth: how everything truly moved, where that was in simulation, in the same way.
        pictures: what the camera saw, by kind.
    """

    def __init__(self, folder: Path) -> None:
        """Read nothing yet."""
        self.folder = folder
        self.pictures = {
            "colour": Pictures(folder / shots.COLOUR_FILE),
            "depth": Pictures(folder / shots.DEPTH_FILE),
        }
        self._reader = Reader()
        self._events = Tail(
            folder / journal.FILE, longest=journal.MAX_LINE, most=journal.MOST_BYTES
        )
        self._motion = Tail(folder / motion.FILE, longest=motion.MAX_LINE, most=motion.MOST_BYTES)
        self._senses = Tail(folder / sensed.FILE, longest=sensed.MAX_LINE, most=sensed.MOST_BYTES)
        self._truths = Tail(folder / trail.FILE, longest=trail.MAX_LINE, most=trail.MOST_BYTES)
        self.truth = Kept(self._truths, most=trail.MOST_LINES, time_of=_true_s)
        self.moments = Kept(self._motion, most=motion.MOST_MOMENTS, time_of=_moved_s)
        self.sensed = Kept(self._senses, most=sensed.MOST_LINES, time_of=_sensed_s)

    @property
    def run(self) -> Run:
        """What has happened so far."""
        return self._reader.run

    @property
    def live(self) -> bool:
        """Whether somebody writes it."""
        return journal.is_written(self.folder)

    @property
    def left_out(self) -> str:
        """What of the run is not shown, in a few words; empty if all is."""
        return ", ".join(
            f"{count:,} {what}" + (" and all later ones" if cut else "")
            for count, cut, what in (
                (self.moments.left_out, self.moments.is_cut, "movements"),
                (self.sensed.left_out, self.sensed.is_cut, "readings of sensors"),
                (self.run.left_out, self._events.is_cut, "entries of the journal"),
            )
            if count or cut
        )

    def read(self) -> bool:
        """Take what has come since; whether there may be more at once."""
        events = self._events.lines()
        for line in events:
            self._reader.line(line + b"\n")
        grown = [
            one.read() for one in (self.moments, self.sensed, self.truth, *self.pictures.values())
        ]
        return bool(events) or any(grown)

    def close(self) -> None:
        """Close the files."""
        for one in (
            self._events,
            self._motion,
            self._senses,
            self._truths,
            *self.pictures.values(),
        ):
            one.close()


def _moved_s(line: bytes) -> float | None:
    moment = motion.decode(line)
    return None if moment is None else moment.t_s


def _sensed_s(line: bytes) -> float | None:
    one = sensed.decode(line)
    return None if one is None else one.t_s


def _true_s(line: bytes) -> float | None:
    one = trail.decode(line)
    return None if one is None else one.t_s
