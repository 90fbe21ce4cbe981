"""Flags by which launcher and executives tell each other: bytes of a file made before any robot is.

Whoever fills the disk or the memory that the private folder is in, once a robot moves, can keep
every new file from being made. A stop needs none: the bytes are there, and so are their pages.

A flag outlives either process's death, and is set from a signal handler.
"""

from __future__ import annotations

import fcntl
import os
import struct
from pathlib import Path

from robot.errors import ProcessError

FILE = "flags"
ROOM_BYTES = 64
_STOP_AT, _HEARS_AT = 0, 4
_COUNT = struct.Struct("<I")


def make(folder: Path) -> Flags:
    """Take the room for them; none is set.

    Raises:
        ProcessError: there is no room.
    """
    flags = os.O_RDWR | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC
    try:
        made = Flags(os.open(folder / FILE, flags, 0o600))
        os.pwrite(made.file, bytes(ROOM_BYTES), 0)
    except OSError as error:
        raise ProcessError(
            f"no stop could be left in {folder} for another executive ({error.strerror}); "
            "make room there, or run it with --fast"
        ) from error
    return made


def find(folder: Path) -> Flags:
    """Those that the launcher made. Raises OSError if there are none."""
    return Flags(os.open(folder / FILE, os.O_RDWR | os.O_NOFOLLOW | os.O_CLOEXEC))


class Flags:
    """Open, so that a shortage of descriptors keeps no stop back either.

    Attributes:
        file: descriptor.
    """

    def __init__(self, file: int) -> None:
        """Of an open file."""
        self.file = file

    def __del__(self) -> None:
        """Close it."""
        os.close(self.file)

    def leave_stop(self) -> None:
        """Tell the next executive that people said stop; also from a signal handler."""
        os.pwrite(self.file, b"\1", _STOP_AT)

    def take_stop(self) -> bool:
        """Whether people said stop, and nobody has heeded it; from here on somebody has."""
        fcntl.flock(self.file, fcntl.LOCK_EX)  # of two that ask, one heeds it
        try:
            said = os.pread(self.file, 1, _STOP_AT) == b"\1"
            if said:
                os.pwrite(self.file, b"\0", _STOP_AT)
        finally:
            fcntl.flock(self.file, fcntl.LOCK_UN)
        return said

    def say_it_hears(self, deaths: int) -> None:
        """Say that the executive that took over from so many hears people itself now."""
        os.pwrite(self.file, _COUNT.pack(deaths), _HEARS_AT)

    def hears(self, deaths: int) -> bool:
        """Whether the executive that took over from so many said that it hears people."""
        return os.pread(self.file, _COUNT.size, _HEARS_AT) == _COUNT.pack(deaths)
