"""Who commands, of several processes that share a memory: the one that holds its file's lock."""

from __future__ import annotations

import fcntl
from io import BufferedRandom


class Turns:
    """A memory whose file is a lock too; the system lets go of it when its holder dies."""

    _file: BufferedRandom

    def lock(self) -> bool:
        """Become the one that commands, until `unlock` or the process's end; False: another is."""
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
        return True

    def unlock(self) -> None:
        """Let another one command."""
        fcntl.flock(self._file, fcntl.LOCK_UN)
