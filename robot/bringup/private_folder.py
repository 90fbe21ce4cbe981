"""A run's private folder, in memory where that can be: sockets, and the motors' shared memory.

Its path is short (a unix socket's may have 108 bytes) and its mode 0700, so nobody else reaches the
motors. Its maker holds a lock on it as long as it lives; what a killed run left is unlocked, and is
taken away by the next one. A process id would not do: it means another process in another
container, and none at all once it was given again.
"""

from __future__ import annotations

import errno
import fcntl
import itertools
import os
import shutil
import stat
import tempfile
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

from robot.errors import ProcessError

PREFIX = "humanoid-run-"
IN_MEMORY, LAST = Path("/dev/shm"), Path("/tmp")
MOST_SWEPT = 10_000
"""Entries looked at: whoever fills the place that all share must not hold up a start."""
MOST_BYTES = 60
"""Of the path of the place: a socket's may have 108, and its name and the folder's come to 40."""
TRIES = 10
ROOM_FILES, ROOM_BYTES = 24, 1 << 14
"""What a run writes there, and a place has to have room for, twice over: eight sockets and their
locks, the motors' memory, and who speaks to whom (`robot.bringup.mailbox`)."""


class PrivateFolder(NamedTuple):
    """A folder of this process, and the descriptor by which it is locked until it ends."""

    path: Path
    lock: int


def create() -> PrivateFolder:
    """Make a fresh folder of this process, and remove those whose owners are gone.

    Raises:
        ProcessError: if there is no place for it.
    """
    refused: list[str] = []
    for parent in dict.fromkeys((IN_MEMORY, _temporary(), LAST)):
        try:
            _check(parent)
            sweep(parent)
            return _made(parent)
        except OSError as error:
            refused.append(f"{parent}: {error.strerror or error}")
    raise ProcessError(
        f"there is no place for a live run's sockets ({'; '.join(refused)}); make /dev/shm or "
        "/tmp writable, or run it with --fast"
    )


def remove(folder: PrivateFolder) -> None:
    """Take a folder away, once; one that somebody removed already is fine."""
    shutil.rmtree(folder.path, ignore_errors=True)
    os.close(folder.lock)


def there() -> list[Path]:
    """This user's folders, of runs that live or that died; whoever opens one looks at it."""
    found: list[Path] = []
    for parent in dict.fromkeys((IN_MEMORY, _temporary(), LAST)):
        with suppress(OSError), os.scandir(parent) as entries:
            for entry in itertools.islice(entries, MOST_SWEPT):
                if not entry.name.startswith(PREFIX) or not entry.is_dir(follow_symlinks=False):
                    continue
                if entry.stat(follow_symlinks=False).st_uid == os.geteuid():
                    found.append(Path(entry.path))
    return found


def sweep(parent: Path) -> None:
    """Remove this user's folders that nobody holds; whatever else lies there is left alone."""
    with os.scandir(parent) as entries:
        for entry in itertools.islice(entries, MOST_SWEPT):
            if entry.name.startswith(PREFIX) and (lock := _locked(Path(entry.path))) is not None:
                remove(PrivateFolder(Path(entry.path), lock))


def _temporary() -> Path:
    """The user's own choice of a place for temporary files, or the system's."""
    try:
        return Path(tempfile.gettempdir())
    except FileNotFoundError:  # there is none that can be written
        return LAST


def _check(parent: Path) -> None:
    """Refuse a place that is too deep, or where others can put a folder in this one's place.

    Raises:
        OSError: if it is one, or is not there.
    """
    if len(os.fsencode(parent)) > MOST_BYTES:
        raise OSError(errno.ENAMETOOLONG, "its path is too long for a socket's")
    found = parent.stat()
    others = found.st_mode & (stat.S_IWGRP | stat.S_IWOTH)
    if found.st_uid not in (0, os.geteuid()) or (others and not found.st_mode & stat.S_ISVTX):
        raise PermissionError(errno.EPERM, "others may move what lies there")


def _made(parent: Path) -> PrivateFolder:
    for _ in range(TRIES):
        path = Path(tempfile.mkdtemp(prefix=PREFIX, dir=parent))
        if (lock := _locked(path)) is not None:
            made = PrivateFolder(path, lock)
            try:
                _check_room(path)
            except OSError:
                remove(made)
                raise
            return made
        # Another one, that sweeps just now, takes it for a dead one's; or nothing is locked here.
        shutil.rmtree(path, ignore_errors=True)
    raise OSError(errno.ENOLCK, "folders cannot be locked there")


def _check_room(path: Path) -> None:
    """Refuse a place that somebody has filled: folders can be made there, and no file.

    Raises:
        OSError: if it is one.
    """
    proofs = [path / f"room-{number}" for number in range(ROOM_FILES)]
    for proof in proofs:
        proof.write_bytes(bytes(ROOM_BYTES))
    for proof in proofs:
        proof.unlink()


def _locked(path: Path) -> int | None:
    """Lock a folder of this user; None if it is another's, no folder, gone, or held."""
    try:
        folder = os.open(path, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC)
    except OSError:
        return None
    try:
        if os.fstat(folder).st_uid == os.geteuid():
            fcntl.flock(folder, fcntl.LOCK_EX | fcntl.LOCK_NB)
            if os.path.samestat(path.stat(follow_symlinks=False), os.fstat(folder)):
                return folder
    except OSError:
        pass
    os.close(folder)
    return None
