"""Files that may be a stranger's: ordinary ones only, opened without waiting, read within a bound.

A pipe in place of a file would make its reader wait for ever, a device would feed it for ever, and
a link would lead it out of the folder it was told to stay in; a writer likewise.
"""

from __future__ import annotations

import contextlib
import errno
import os
import secrets
import stat
from pathlib import Path
from typing import BinaryIO


def open_ordinary(path: Path | str, *, follow_links: bool = True) -> BinaryIO:
    """Open a file for reading bytes, if it is one that ends.

    Args:
        path: where it is.
        follow_links: whether its last part may be a symbolic link.

    Raises:
        OSError: it is missing, a folder, a device, a pipe, a socket, or a link that is not
            followed; `strerror` says which.
    """
    # Without O_NONBLOCK the open itself waits for the other end of a pipe.
    flags = os.O_RDONLY | os.O_NONBLOCK | os.O_NOCTTY | os.O_CLOEXEC
    file = os.open(path, flags if follow_links else flags | os.O_NOFOLLOW)
    try:
        if not stat.S_ISREG(os.fstat(file).st_mode):
            raise OSError(errno.EINVAL, "this is no ordinary file", str(path))
        return os.fdopen(file, "rb")
    except BaseException:
        os.close(file)
        raise


def read_ordinary(path: Path | str, *, limit: int, follow_links: bool = True) -> bytes:
    """All of a file, if it has at most `limit` bytes.

    Raises:
        OSError: as `open_ordinary`, or it is larger.
    """
    with open_ordinary(path, follow_links=follow_links) as file:
        if os.fstat(file.fileno()).st_size > limit:
            raise _too_large(limit, path)  # before there is room for it
        data = file.read(limit + 1)
    return _bounded(data, limit, path)


def read_secret(path: Path | str, *, limit: int) -> bytes:
    """All of a file that is this user's, and that nobody else may read or change.

    Raises:
        OSError: as `read_ordinary`, or it is not such a file.
    """
    with open_ordinary(path) as file:
        found = os.fstat(file.fileno())
        if found.st_uid != os.geteuid():
            raise OSError(errno.EPERM, "the file belongs to another user", str(path))
        if found.st_mode & (stat.S_IRWXG | stat.S_IRWXO):
            raise OSError(errno.EPERM, f"others may use the file: chmod 600 {path}", str(path))
        data = file.read(limit + 1)
    return _bounded(data, limit, path)


def write_ordinary(path: Path | str, data: bytes, *, anew: bool = False) -> None:
    """Put a file in its place in a folder that is there, whole or not at all.

    What stood there before is replaced, if it was an ordinary file of this user that may be
    written; who may use it stays as it was.

    Args:
        path: where it is to be.
        data: what it is to hold.
        anew: whether nothing may have that name yet.

    Raises:
        OSError: it cannot be written, or that is no place to write to; `strerror` says which.
    """
    path = Path(path)
    before = _check_place(path, anew=anew)
    fresh = path.with_name(f".{secrets.token_hex(8)}.new")
    flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC
    file = os.open(fresh, flags, 0o666 if before is None else 0o600)
    try:
        with os.fdopen(file, "wb") as opened:
            if before is not None:
                os.fchmod(file, before)
            opened.write(data)
        if anew:
            os.link(fresh, path)  # unlike a renaming it replaces nothing
            fresh.unlink()
        else:
            fresh.replace(path)
    except BaseException:
        fresh.unlink(missing_ok=True)
        raise


def open_to_append(path: Path | str) -> int:
    """A descriptor of an ordinary file of this user, made where it is missing, to append to.

    Raises:
        OSError: it cannot be written, or that is no place to write to; `strerror` says which.
    """
    path = Path(path)
    _check_place(path, anew=False)
    flags = os.O_RDWR | os.O_CREAT | os.O_APPEND | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC
    return os.open(path, flags, 0o644)


def make_below(base: Path | str, folder: Path | str) -> None:
    """Make a folder and those between it and `base`, or take them as they are, but for links.

    Args:
        base: made as well; it may be reached through links.
        folder: `base` itself, or below it by its name.

    Raises:
        OSError: something on the way is a link or no folder, or it cannot be made.
    """
    place = Path(base)
    place.mkdir(parents=True, exist_ok=True)
    for part in Path(os.path.relpath(folder, base)).parts:
        place /= part
        with contextlib.suppress(FileExistsError):
            place.mkdir()
        mode = place.lstat().st_mode
        if part == ".." or not stat.S_ISDIR(mode):
            what = "a link, which is not followed" if stat.S_ISLNK(mode) else "no folder below it"
            raise OSError(errno.ENOTDIR, f"{place} is {what}", str(place))


def is_within(folder: Path | str, path: Path | str) -> bool:
    """Whether a path stays inside a folder, wherever its links and `..` lead."""
    inner, outer = os.path.realpath(path), os.path.realpath(folder)
    return os.path.commonpath((inner, outer)) == outer


def _check_place(path: Path, *, anew: bool) -> int | None:
    """Refuse to write where something else is than a file of this user that may be written.

    Returns:
        Who may read, write and run what is there; None if nothing is.
    """
    try:
        found = path.stat(follow_symlinks=False)
    except FileNotFoundError:
        return None
    if anew:
        raise FileExistsError(errno.EEXIST, "something of that name is there already", str(path))
    if stat.S_ISLNK(found.st_mode):
        raise OSError(errno.ELOOP, "this is a link; name what it points to", str(path))
    if not stat.S_ISREG(found.st_mode):
        raise OSError(errno.EINVAL, "this is no ordinary file", str(path))
    if found.st_uid != os.geteuid():
        raise OSError(errno.EPERM, "the file there belongs to another user", str(path))
    if not found.st_mode & stat.S_IWUSR:  # root would be let through
        raise OSError(errno.EACCES, "the file there is protected from being written", str(path))
    return found.st_mode & (stat.S_IRWXU | stat.S_IRWXG | stat.S_IRWXO)


def _bounded(data: bytes, limit: int, path: Path | str) -> bytes:
    if len(data) > limit:
        raise _too_large(limit, path)
    return data


def _too_large(limit: int, path: Path | str) -> OSError:
    return OSError(errno.EFBIG, f"the file is larger than {_size(limit)}", str(path))


def _size(limit: int) -> str:
    return f"{limit / 1e6:g} MB" if limit >= 1e5 else f"{limit / 1e3:g} kB"
