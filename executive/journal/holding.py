"""Who holds a folder: one process at a time, by a lock that only this user can take.

Whoever may read a file or a folder may lock it, and so keep its owner out: a folder that others may
enter is held by a file in it that is nobody else's (mode 0600).
"""

from __future__ import annotations

import errno
import fcntl
import os
import stat
import time
from pathlib import Path

LOCK = ".lock"
PRIVATE = 0o600
TRIES, AGAIN_S = 20, 0.01
"""Of holding a folder: whoever looks whether it is held, holds it for a moment."""


def hold(folder: Path, opened: int | None = None) -> int:
    """Hold a folder of this user until the descriptor that is returned is closed.

    Args:
        folder: which one.
        opened: a descriptor of it, to be locked where no file can be made in it.

    Raises:
        BlockingIOError: another process holds it.
        OSError: it cannot be held, by a file system without locks for example.
    """
    try:
        file, place = _file_of(folder), folder / LOCK
    except OSError:
        if opened is None:
            raise
        file, place = os.dup(opened), folder
    try:
        _lock(file)
        if not os.path.samestat(os.fstat(file), place.lstat()):  # exchanged in between
            raise BlockingIOError(errno.EAGAIN, "somebody else holds it", str(folder))
    except BaseException:
        os.close(file)
        raise
    return file


def is_held(folder: Path) -> bool | None:
    """Whether a process of this user holds a folder; None where no file of ours says so."""
    flags = os.O_RDONLY | os.O_NONBLOCK | os.O_NOFOLLOW | os.O_CLOEXEC
    try:
        file = os.open(folder / LOCK, flags)
    except OSError:
        return None
    try:
        if not _is_ours(os.fstat(file)):
            return None
        fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except OSError:
        return True
    finally:
        os.close(file)
    return False


def _file_of(folder: Path) -> int:
    """The lock's file, made where there is none, or one that others could hold."""
    path = folder / LOCK
    try:
        if not _is_ours(path.lstat()):
            path.unlink()
    except FileNotFoundError:
        pass
    flags = os.O_RDWR | os.O_CREAT | os.O_NONBLOCK | os.O_NOFOLLOW | os.O_CLOEXEC
    return os.open(path, flags, PRIVATE)


def _is_ours(found: os.stat_result) -> bool:
    mode = found.st_mode
    return stat.S_ISREG(mode) and stat.S_IMODE(mode) == PRIVATE and found.st_uid == os.geteuid()


def _lock(file: int) -> None:
    for _ in range(TRIES - 1):
        try:
            return fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            time.sleep(AGAIN_S)
    return fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
