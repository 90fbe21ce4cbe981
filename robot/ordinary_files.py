"""Files that may be a stranger's: ordinary ones only, opened without waiting, read within a bound.

A pipe in place of a file would make its reader wait for ever, a device would feed it for ever, and
a link would lead it out of the folder it was told to stay in.
"""

from __future__ import annotations

import errno
import os
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
        data = file.read(limit + 1)
    if len(data) > limit:
        raise OSError(errno.EFBIG, f"the file is larger than {limit / 1e6:g} MB", str(path))
    return data
