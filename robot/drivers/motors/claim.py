"""One program at a time commands a bus: the system lets go of the claim of one that dies."""

from __future__ import annotations

import fcntl
import hashlib
import os
import stat
import struct
from collections.abc import Iterable, Iterator
from contextlib import suppress
from pathlib import Path

from robot.errors import DriverError
from robot.files.user_state import user_state_folder

FILE = "claims.lock"
_FLAGS = os.O_RDWR | os.O_CREAT | os.O_CLOEXEC | os.O_NOFOLLOW
_FLOCK = struct.Struct("hhqqi4x")
"""`struct flock` of Linux: type, whence, start, length, process."""


class Claim:
    """Of several channels, all of them or none.

    A lock on a byte of a file in a folder that only this user enters, a byte for each channel:
    nobody else can hold it, or be faster when its owner dies. Another user's program is not kept
    off by it. (The lock is of the open file, fcntl(2) F_OFD_SETLK: it ends with its process.)
    """

    def __init__(self, channels: Iterable[str]) -> None:
        """Nothing is claimed yet."""
        self._bytes = sorted(map(_byte, set(channels)))
        self._held: list[int] = []
        self._refused_by: tuple[int, int] | None = None

    @property
    def is_held(self) -> bool:
        """Whether it is ours."""
        return bool(self._held)

    def take(self) -> bool:
        """Claim them; False while somebody else has any of them.

        Raises:
            DriverError: this user has no folder for the locks.
        """
        if self._held:
            return True
        if self._is_still_refused():
            return False
        folders = list(_folders())
        if not folders:
            raise DriverError(
                "there is no folder for the claim of a bus; give the user a home or a session"
            )
        for folder in folders:
            try:
                self._held.append(os.open(folder / FILE, _FLAGS, 0o600))
            except OSError as error:
                self._let_go()
                raise DriverError(f"{folder / FILE}: {error.strerror}") from None
            for one in self._bytes:
                if not _lock(self._held[-1], one):
                    self._refused_by = _unlocked(self._held.pop()), one
                    self._let_go()
                    return False
        return True

    def _is_still_refused(self) -> bool:
        """Whether the lock that was not to be had is still another one's.

        A spare asks a thousand times a second: to look for folders and open files each time took a
        fifth of a core. Nothing is taken here, for by now the file may be another one.
        """
        if self._refused_by is None:
            return False
        file, one = self._refused_by
        if _is_locked(file, one):
            return True
        os.close(file)
        self._refused_by = None
        return False

    def is_free(self) -> bool:
        """Whether nobody else has any of them."""
        if self._held:
            return True
        if taken := self.take():
            self.release()
        return taken

    def release(self) -> None:
        """Let go of them, and of who refused them."""
        self._let_go()
        if self._refused_by is not None:
            os.close(self._refused_by[0])
            self._refused_by = None

    def _let_go(self) -> None:
        for one in self._held:
            os.close(one)
        self._held.clear()


def _folders() -> Iterator[Path]:
    """Where locks lie: all of them are taken, for not every program of a user has both folders."""
    state = user_state_folder()
    bases = [Path(f"/run/user/{os.geteuid()}/humanoid"), *([state] if state else [])]
    for base in bases:
        folder = base / "can"
        with suppress(OSError):
            if not base.parent.is_dir() and base is not state:
                continue
            folder.mkdir(mode=0o700, parents=True, exist_ok=True)
            found = folder.lstat()
            own = found.st_uid == os.geteuid() and stat.S_ISDIR(found.st_mode)
            if own and not found.st_mode & 0o077:
                yield folder


def _byte(channel: str) -> int:
    """Which byte stands for a channel: of so many that no two channels share one."""
    return int.from_bytes(hashlib.blake2b(channel.encode(), digest_size=8).digest()) >> 2


def _lock(file: int, byte: int) -> bool:
    """Lock a byte of an open file, whether it is there or not; False if another one has it."""
    try:
        fcntl.fcntl(file, fcntl.F_OFD_SETLK, _FLOCK.pack(fcntl.F_WRLCK, os.SEEK_SET, byte, 1, 0))
    except OSError:
        return False
    return True


def _unlocked(file: int) -> int:
    """An open file without any lock of its own."""
    fcntl.fcntl(file, fcntl.F_OFD_SETLK, _FLOCK.pack(fcntl.F_UNLCK, os.SEEK_SET, 0, 0, 0))
    return file


def _is_locked(file: int, byte: int) -> bool:
    """Whether another one has a lock on a byte."""
    wanted = _FLOCK.pack(fcntl.F_WRLCK, os.SEEK_SET, byte, 1, 0)
    kind, *_ = _FLOCK.unpack(fcntl.fcntl(file, fcntl.F_OFD_GETLK, wanted))
    return kind != fcntl.F_UNLCK
