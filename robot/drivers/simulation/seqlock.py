"""One record of numbers in shared memory: one writer, any readers, no locks, no torn reads.

The writer makes the sequence odd, writes, and makes it even again; a reader that saw it odd or
changed tries again (a seqlock). A CRC-32 over the numbers and their sequence stands guard where
the order of stores is not: after a writer that died half way, or on a weakly ordered machine.
"""

from __future__ import annotations

import zlib
from mmap import mmap

import numpy as np
from numpy.typing import NDArray

from robot.se3 import Array

HEADER_BYTES = 16
TRIES = 50


class Seqlock:
    """A record of float64 at an offset of a memory map.

    Attributes:
        torn: reads that gave up because no whole record could be had.
    """

    def __init__(self, memory: mmap, offset: int, *, size: int) -> None:
        """Look at `size` numbers from `offset` (a multiple of 8) on."""
        self.torn = 0
        self._seen = 0
        self._header: NDArray[np.uint64] = np.frombuffer(memory, np.uint64, 2, offset)
        self._values: Array = np.frombuffer(memory, np.float64, size, offset + HEADER_BYTES)

    @staticmethod
    def bytes_for(size: int) -> int:
        """Memory that a record of `size` numbers takes."""
        return HEADER_BYTES + 8 * size

    def release(self) -> None:
        """Let go of the memory, so that the map can be closed."""
        self._header = np.zeros(2, np.uint64)
        self._values = np.zeros(0)

    @property
    def sequence(self) -> int:
        """Even when at rest; grows by two a record. Cheap: looks at the header only."""
        return int(self._header[0])

    def write(self, values: Array) -> None:
        """Publish new numbers, shape (size,)."""
        header = self._header
        sequence = int(header[0]) | 1
        header[0] = sequence
        self._values[:] = values
        header[1] = zlib.crc32(values.data, sequence + 1)
        header[0] = sequence + 1

    def read(self) -> tuple[int, Array] | None:
        """The newest whole record and its sequence; None before the first, or if torn."""
        header = self._header
        for _ in range(TRIES):
            before = int(header[0])
            if before == 0:
                return None
            if before & 1:
                continue
            checksum = int(header[1])
            values = self._values.copy()
            if int(header[0]) == before and zlib.crc32(values.data, before) == checksum:
                return before, values
        self.torn += 1
        return None

    def news(self) -> Array | None:
        """The newest whole record, if the last call did not give it already."""
        if int(self._header[0]) == self._seen:
            return None
        record = self.read()
        if record is None:
            return None
        self._seen, values = record
        return values
