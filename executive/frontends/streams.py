"""Standard streams that cannot stop a robot, whoever has closed them, and whatever they lack.

A robot on its way must not fall because somebody piped its output into `head`. What cannot be
written is left out; a stream that was closed from the start leads nowhere. Who stopped reading
wants no more; but what a full disk did not take, somebody misses: that is told at the end.
"""

from __future__ import annotations

import errno
import io
import os
import stat
import sys
from contextlib import suppress
from typing import TextIO, cast

GONE = (errno.EPIPE, errno.EIO)
"""Errors after which nobody will read what is written: a pipe, or a terminal that is gone."""


class Lasting(io.TextIOWrapper):
    """A stream of text that leaves out what cannot be written, and raises no OSError.

    Attributes:
        lacks: why somebody who still reads misses some of it; empty if nobody does.
        beside: whether it tells of work that counts by itself, as a robot's.
    """

    lacks: str = ""
    beside: bool = False

    def write(self, text: str, /) -> int:
        """Write a text, or as much as can be; its length."""
        try:
            return super().write(text)
        except OSError as error:
            self._lost(error)
            return len(text)

    def write_data(self, data: bytes) -> None:
        """Write bytes after the text so far, or as much as can be."""
        self.flush()
        try:
            self.buffer.write(data)
            self.buffer.flush()
        except OSError as error:
            self._lost(error)

    def flush(self) -> None:
        """Pass on what was written."""
        try:
            super().flush()
        except OSError as error:
            self._lost(error)

    def _lost(self, error: OSError) -> None:
        """Lead nowhere from here on if nobody is left to read."""
        if error.errno not in GONE or self._is_file():
            self.lacks = error.strerror or "it cannot be written"
        else:
            with suppress(OSError):
                nowhere = os.open(os.devnull, os.O_WRONLY)
                os.dup2(nowhere, self.fileno())
                os.close(nowhere)

    def _is_file(self) -> bool:
        """Whether it is kept on a disk, where EIO means that this one is broken."""
        return stat.S_ISREG(os.fstat(self.fileno()).st_mode)


def beside_work() -> None:
    """What is written from here on tells of a robot's work: how that ends is not for it to say."""
    if isinstance(sys.stdout, Lasting):
        sys.stdout.beside = True


def lost() -> tuple[str, bool]:
    """Why some of standard output is missing, empty if none is; and whether it was the product."""
    sys.stdout.flush()
    if not isinstance(sys.stdout, Lasting):
        return "", False
    return sys.stdout.lacks, not sys.stdout.beside


MOST_DIGITS = 3
"""Of the columns and lines of a terminal."""


def steady() -> None:
    """Make this process's standard streams last; before anything is read or written."""
    for fd in (0, 1, 2):  # what is closed would be the next file that is opened
        try:
            os.fstat(fd)
        except OSError:
            os.open(os.devnull, os.O_RDWR)
    if sys.stdin is None:  # pyright: ignore[reportUnnecessaryComparison]
        sys.stdin = os.fdopen(0, encoding="utf-8", closefd=False)
    if isinstance(sys.stdin, io.TextIOWrapper):
        cast("io.TextIOWrapper", sys.stdin).reconfigure(errors="replace")
    sys.stdout = _lasting(sys.stdout, 1)
    sys.stderr = _lasting(sys.stderr, 2)


def sized() -> None:
    """Leave out a size of the terminal that is none: tables are drawn as wide as that says."""
    for name in ("COLUMNS", "LINES"):
        size = os.environ.get(name, "")
        if len(size) > MOST_DIGITS or not size.isdecimal():
            os.environ.pop(name, None)


def _lasting(stream: object, fd: int) -> TextIO:
    """The stream in place of one of Python's own; others are somebody's on purpose."""
    if stream is None:
        return Lasting(os.fdopen(fd, "wb", closefd=False), encoding="utf-8")
    if type(stream) is not io.TextIOWrapper:
        return cast("TextIO", stream)
    encoding, by_lines = stream.encoding, stream.line_buffering
    return Lasting(stream.detach(), encoding=encoding, errors="replace", line_buffering=by_lines)
