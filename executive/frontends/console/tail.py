"""The lines of a file that grows."""

from __future__ import annotations

import os
from pathlib import Path
from typing import BinaryIO

from robot.files.ordinary_files import open_ordinary

CHUNK = 1 << 20
"""Bytes read at a time, so that a long file holds nobody up."""


class Tail:
    """The lines of a file that grows, may not be there yet, and may be begun anew.

    Attributes:
        too_long: lines that were passed over.
    """

    def __init__(self, path: Path, *, longest: int, most: int) -> None:
        """Open nothing yet.

        Args:
            path: of the file.
            longest: bytes of a line; what is longer is passed over.
            most: bytes that are read at all.
        """
        self.too_long = 0
        self._path = path
        self._longest = longest
        self._most = most
        self._file: BinaryIO | None = None
        self._taken = 0
        self._begun = b""

    @property
    def is_cut(self) -> bool:
        """Whether no more is read, however much there is."""
        return self._taken >= self._most

    def lines(self) -> list[bytes]:
        """What has come since the last time, up to `CHUNK` bytes of it, without ends of lines."""
        return [line for _, line in self.placed()]

    def placed(self) -> list[tuple[int, bytes]]:
        """The same, each line with where it begins in the file."""
        file = self._file or self._opened()
        if file is None or self.is_cut:
            return []
        at = self._taken - len(self._begun)
        data = file.read(CHUNK)
        self._taken += len(data)
        *whole, self._begun = (self._begun + data).split(b"\n")
        found: list[tuple[int, bytes]] = []
        for line in whole:
            if line and len(line) <= self._longest:
                found.append((at, line))
            self.too_long += len(line) > self._longest
            at += len(line) + 1
        if len(self._begun) > self._longest:
            self.too_long += 1
            self._begun = b""
        return found

    def at(self, offset: int, length: int) -> bytes:
        """Bytes of the file as it is now; fewer, where it has become shorter."""
        return b"" if self._file is None else os.pread(self._file.fileno(), length, offset)

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
