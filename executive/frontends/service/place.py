"""Where robots that are up can be reached: a folder for each, which only this user enters.

    $XDG_RUNTIME_DIR/humanoid/NAME/    mode 0700; `humanoid up` holds a lock on it while it lives
        service.sock                   mode 0600; of the executive, after a take-over of the next
        service.json                   which run it is, or was (`Running`), by the executive
        up.log                         what a detached one writes to its standard output

Whoever finds the folder unlocked knows that nobody is there, whatever a killed robot has left in
it. Folders are opened before they are looked at, and used by their descriptors: nobody can put
another one in their place in between, and a socket's name is never too long.
"""

from __future__ import annotations

import contextlib
import errno
import fcntl
import os
import re
import socket
import stat
import struct
import time
from collections.abc import Generator, Iterator
from contextlib import contextmanager
from itertools import islice
from pathlib import Path
from typing import NamedTuple

import msgspec

from executive.frontends.line_server import is_own
from robot.errors import ConfigError, Problem
from robot.files.ordinary_files import read_secret, write_ordinary
from robot.files.user_state import user_state_folder

SOCKET, RUNNING, LOG = "service.sock", "service.json", "up.log"
DEFAULT_NAME = "robot"
PRIVATE = 0o700
MAX_BYTES = 64_000
MOST_PLACES = 1000
"""Folders that are looked at."""
TRIES, AGAIN_S = 20, 0.01
"""Of claiming a name: whoever looks whether it is taken holds its lock for a moment."""
CONNECT_S = 5.0
_TIMEVAL = struct.Struct("ll")
"""Seconds and microseconds (socket(7), SO_SNDTIMEO)."""
_NAME = re.compile(r"[a-z0-9][a-z0-9_-]{0,31}")


class Place(NamedTuple):
    """A name by which a robot is reached, and its folder."""

    name: str
    folder: Path


class Running(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What is up at a place.

    Attributes:
        pid: of the process that was started as `humanoid up`.
        run: the folder of its run.
        private: the folder that the processes of a live run share; empty for a fast one.
    """

    pid: int
    run: str
    private: str
    world: str
    robot: str
    runtime: str


def bases() -> tuple[Path, ...]:
    """The folders in which places may lie, the best one first.

    A service manager says where a session's runtime folder is, a job of cron's does not: both find
    the same robots.
    """
    found: list[Path] = []
    said = os.environ.get("XDG_RUNTIME_DIR", "")
    for runtime in (Path(said), Path(f"/run/user/{os.geteuid()}")):
        if runtime.is_absolute() and _is_own(runtime):
            found.append(runtime / "humanoid")
    state = user_state_folder()
    if state is not None:
        found.append(state / "up")
    return tuple(dict.fromkeys(found))


def _is_own(folder: Path) -> bool:
    try:
        found = folder.stat()
    except OSError:
        return False
    return stat.S_ISDIR(found.st_mode) and _is_private(found, mode=0o022)


def _is_private(found: os.stat_result, *, mode: int = 0o077) -> bool:
    """Whether something is this user's, and closed to what `mode` says of others."""
    return found.st_uid == os.geteuid() and not found.st_mode & mode


def check_name(name: str) -> None:
    """Refuse what could not be the name of a folder. Raises ConfigError."""
    if not _NAME.fullmatch(name):
        cure = "take letters a-z, digits, - and _, at most 32: --name kitchen"
        raise ConfigError([Problem(f"{name!r} is no name for a robot", suggestion=cure)])


# --- whose a name is ------------------------------------------------------------------------------


@contextmanager
def claimed(name: str) -> Generator[Place]:
    """Hold a name inside the block: nobody else's robot is reached by it.

    Raises:
        ConfigError: if a robot of that name is up, or there is no place for one.
    """
    check_name(name)
    taken = next((one for one in places_up() if one.name == name), None)
    if taken is not None:
        raise _taken(name)
    refused: list[str] = []
    for base in bases():
        try:
            folder, lock = _locked_anew(base, name)
        except BlockingIOError:
            raise _taken(name) from None
        except OSError as error:
            refused.append(f"{base}: {error.strerror or error}")
            continue
        try:
            yield Place(name, folder)
        finally:
            with contextlib.suppress(OSError):
                (folder / SOCKET).unlink(missing_ok=True)
            os.close(lock)
        return
    cure = "set XDG_RUNTIME_DIR to a folder of your own"
    text = f"there is no place for a robot's socket ({'; '.join(refused) or 'no home'})"
    raise ConfigError([Problem(text, suggestion=cure)])


def _taken(name: str) -> ConfigError:
    cure = f"`humanoid down --name {name}` ends it; --name OTHER begins another one"
    return ConfigError([Problem(f"a robot called {name} is up already", suggestion=cure)])


def _locked_anew(base: Path, name: str) -> tuple[Path, int]:
    """Make a place if it is missing, and lock it; what a dead robot left in it is removed."""
    base.parent.mkdir(mode=PRIVATE, parents=True, exist_ok=True)
    base.mkdir(mode=PRIVATE, exist_ok=True)
    os.close(_entered(base))
    folder = base / name
    folder.mkdir(mode=PRIVATE, exist_ok=True)
    lock = _entered(folder)
    try:
        for _ in range(TRIES):
            if _lock(lock, fcntl.LOCK_EX):
                break
            time.sleep(AGAIN_S)
        else:
            raise BlockingIOError(errno.EWOULDBLOCK, "a robot of that name is up")
        for left in (SOCKET, RUNNING, LOG):
            (folder / left).unlink(missing_ok=True)
    except BaseException:
        os.close(lock)
        raise
    return folder, lock


def _entered(folder: Path) -> int:
    """A descriptor of a folder of this user's that nobody else enters.

    Raises:
        OSError: if it is none.
    """
    opened = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC)
    if not _is_private(os.fstat(opened)):
        os.close(opened)
        raise PermissionError(errno.EPERM, f"others may enter it: chmod 700 {folder}")
    return opened


def _lock(folder: int, kind: int) -> bool:
    try:
        fcntl.flock(folder, kind | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True


# --- who is there ---------------------------------------------------------------------------------


def is_up(place: Place) -> bool:
    """Whether somebody holds a place."""
    try:
        folder = _entered(place.folder)
    except OSError:
        return False
    try:
        return not _lock(folder, fcntl.LOCK_SH)
    finally:
        os.close(folder)


def places_up() -> list[Place]:
    """The places of all robots that are up, by name."""
    return sorted(place for place in _places() if is_up(place))


def _places() -> Iterator[Place]:
    for base in bases():
        with contextlib.suppress(OSError), os.scandir(base) as entries:
            for entry in islice(entries, MOST_PLACES):
                if _NAME.fullmatch(entry.name):
                    yield Place(entry.name, Path(entry.path))


def find(name: str | None) -> Place:
    """The robot of a name, or the only one that is up.

    Raises:
        ConfigError: there is none, or more than one.
    """
    if name is not None:
        check_name(name)
    up = places_up()
    fitting = [place for place in up if name in (None, place.name)]
    if len(fitting) == 1:
        return fitting[0]
    names = ", ".join(place.name for place in up)
    if fitting:
        text, cure = f"more than one robot is up: {names}", f"say which: --name {up[0].name}"
    elif up:
        text, cure = f"no robot called {name} is up", f"these are: {names}"
    else:
        called = "" if name is None else f" called {name}"
        text, cure = f"no robot{called} is up", "begin with: humanoid up --detach"
    raise ConfigError([Problem(text, suggestion=cure)])


def last(name: str | None) -> Place:
    """The robot of a name, or the only one that is up, or that was: a log outlives its robot.

    Raises:
        ConfigError: as `find` does.
    """
    try:
        return find(name)
    except ConfigError:
        wanted = name or DEFAULT_NAME
        there = [one for one in _places() if one.name == wanted and running(one)]
        if not there:
            raise
        return there[0]


def running(place: Place) -> Running | None:
    """What is up at a place; None where it does not say yet."""
    with contextlib.suppress(OSError, msgspec.DecodeError, RecursionError):
        data = read_secret(place.folder / RUNNING, limit=MAX_BYTES)
        return msgspec.json.decode(data, type=Running)
    return None


# --- sockets --------------------------------------------------------------------------------------


def listen(place: Place, told: Running, *, backlog: int) -> socket.socket:
    """A socket that listens at a place, in place of one that a dead executive has left.

    Raises:
        OSError: if there is no room, or the folder is not private any more.
    """
    folder = _entered(place.folder)
    try:
        here = Path(f"/proc/self/fd/{folder}")
        (here / SOCKET).unlink(missing_ok=True)
        listening = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        try:
            listening.bind(str(here / SOCKET))
            (here / SOCKET).chmod(0o600)
            listening.listen(backlog)
            write_ordinary(here / RUNNING, msgspec.json.encode(told))
            (here / RUNNING).chmod(0o600)
        except BaseException:
            listening.close()
            raise
    finally:
        os.close(folder)
    return listening


def connect(place: Place, *, wait_s: float = CONNECT_S) -> socket.socket:
    """A connection to who listens at a place.

    Args:
        place: of the robot.
        wait_s: how long to wait in the queue, of one that takes nobody in.

    Raises:
        OSError: nobody does, or it is not this user; EAGAIN: the queue is full.
    """
    folder = _entered(place.folder)
    connection = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    # Not `settimeout`, with which a full queue is refused at once, and others get in first.
    whole_s = int(wait_s)
    until = _TIMEVAL.pack(whole_s, round((wait_s - whole_s) * 1e6))
    connection.setsockopt(socket.SOL_SOCKET, socket.SO_SNDTIMEO, until)
    try:
        _join(connection, f"/proc/self/fd/{folder}/{SOCKET}")
        if not is_own(connection):
            raise PermissionError(errno.EPERM, "another user listens there")
    except BaseException:
        connection.close()
        raise
    finally:
        os.close(folder)
    return connection


def _join(connection: socket.socket, address: str) -> None:
    """Connect, again where a signal came meanwhile (Ctrl-Z and `fg`, a window's new size).

    Python takes a connect(2) that a signal has ended (EINTR, signal(7)) for one that goes on by
    itself, and a socket on which nothing goes on for one that is connected.
    """
    while True:
        connection.connect(address)
        try:
            connection.getpeername()
        except OSError as error:
            if error.errno != errno.ENOTCONN:
                raise
            continue
        return
