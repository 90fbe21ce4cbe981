"""Lines of a run's file that pages are given: where each stands in it, and no line in memory.

A run may be a stranger's, with lines of 100 kB: a page is given so many bytes of them, and told how
many it is not.
"""

from __future__ import annotations

import math
from array import array
from collections.abc import Callable

from executive.frontends.console.tail import Tail

MOST_BYTES = 100_000_000
"""Given to a page: it keeps them. Movements of three hours have 80 MB."""
BATCH_BYTES = 1 << 20
"""Of a message to a page; one line at least."""


class Kept:
    """Those lines of a file that make sense, in the order of time, up to a number of them.

    Attributes:
        last_s: the time of the last of them.
    """

    def __init__(self, tail: Tail, *, most: int, time_of: Callable[[bytes], float | None]) -> None:
        """Read nothing yet.

        Args:
            tail: of the file, which is closed by whoever made it.
            most: lines that are kept.
            time_of: what a line says of when it was; None if it makes no sense.
        """
        self.last_s = -math.inf
        self._tail, self._most, self._time_of = tail, most, time_of
        self._times_s, self._offsets, self._lengths = array("d"), array("q"), array("l")
        self._full = 0
        self._bytes = 0

    @property
    def left_out(self) -> int:
        """How many lines are not among them that made sense, or were too long for that."""
        return self._full + self._tail.too_long

    @property
    def is_cut(self) -> bool:
        """Whether the file is so long that its end is not read."""
        return self._tail.is_cut

    def __len__(self) -> int:
        """How many there are by now."""
        return len(self._times_s)

    def read(self) -> bool:
        """Find what has come since; whether there may be more at once."""
        placed = self._tail.placed()
        for offset, line in placed:
            t_s = self._time_of(line)
            if t_s is None or not t_s > self.last_s:
                continue
            if len(self) >= self._most or self._bytes + len(line) > MOST_BYTES:
                self._full += 1
                continue
            self.last_s = t_s
            self._bytes += len(line)
            self._times_s.append(t_s)
            self._offsets.append(offset)
            self._lengths.append(len(line))
        return bool(placed)

    def batch(self, begin: int, *, most: int) -> tuple[list[bytes], int]:
        """Lines from a number on, and the number behind the last of them.

        One that is no more in the file as it was is left out.
        """
        found: list[bytes] = []
        size, number = 0, begin
        while number < min(len(self), begin + most):
            size += self._lengths[number]
            if found and size > BATCH_BYTES:
                break
            line = self._tail.at(self._offsets[number], self._lengths[number])
            if self._time_of(line) == self._times_s[number]:
                found.append(line)
            number += 1
        return found, number
