"""Files that lines are appended to: neither a full disk nor a stalled one stops who writes.

`LineFile` writes in the caller's thread: what `append` returns from is with the operating system.
`BackgroundFile` writes in a thread of its own, for loops that must never wait for a disk.
Both hold lines back in memory while they cannot be written, drop the oldest beyond a capacity,
count them, and never leave half a line before a whole one.
"""

from __future__ import annotations

import fcntl
import os
import threading
from collections import deque
from pathlib import Path
from typing import Protocol

CLOSE_S = 1.0
RETRY_S = 0.2
BATCH = 200


class Lines(Protocol):
    """Where lines go."""

    @property
    def waiting(self) -> int:
        """How many lines are in memory only."""
        ...

    @property
    def dropped(self) -> int:
        """How many were given up."""
        ...

    @property
    def problem(self) -> str:
        """Why they wait; empty when all is well."""
        ...

    def append(self, line: bytes) -> None:
        """Add a line (without its end); never raises."""
        ...

    def close(self) -> None:
        """Write what can be written in bounded time, and close; safe to call twice."""
        ...


class Nowhere:
    """Takes lines and keeps none."""

    waiting = dropped = 0
    problem = ""

    def append(self, line: bytes) -> None:
        """Forget it."""

    def close(self) -> None:
        """Nothing to close."""


class LineFile:
    """Writes in the caller's thread."""

    def __init__(self, path: Path, *, capacity: int) -> None:
        """Append to `path`, holding back at most `capacity` lines."""
        self._waiting: deque[bytes] = deque()
        self._capacity = capacity
        self._begun = False
        self._file: int | None = None
        self.dropped = 0
        self.problem = ""
        try:
            self._file = opened(path)
        except OSError as error:
            self.problem = f"{path}: {error.strerror}"

    @property
    def waiting(self) -> int:
        """How many lines are in memory only."""
        return len(self._waiting)

    def append(self, line: bytes) -> None:
        """Write a line, and whatever waited for room before it."""
        self._waiting.append(line + b"\n")
        if len(self._waiting) > self._capacity:
            del self._waiting[1 if self._begun else 0]
            self.dropped += 1
        self._flush()

    def _flush(self) -> None:
        if self._file is None:
            return
        try:
            while self._waiting:
                written = os.write(self._file, self._waiting[0])
                if written < len(self._waiting[0]):
                    self._waiting[0] = self._waiting[0][written:]
                    self._begun = True
                else:
                    self._waiting.popleft()
                    self._begun = False
            self.problem = ""
        except OSError as error:
            self.problem = error.strerror or str(error)

    def close(self) -> None:
        """Close the file; safe to call twice."""
        if self._file is not None:
            self._flush()
            os.close(self._file)
            self._file = None


class BackgroundFile:
    """Writes in a thread of its own: `append` takes microseconds whatever the disk does.

    The thread is a daemon: one that hangs in a write does not keep the process from ending.
    """

    def __init__(self, path: Path, *, capacity: int) -> None:
        """Append to `path` from a new thread, holding back at most `capacity` lines."""
        self.dropped = 0
        self.problem = ""
        self._path = path
        self._capacity = capacity
        self._waiting: deque[bytes] = deque()
        self._lock = threading.Lock()
        self._news = threading.Event()
        self._closing = False
        self._writing = 0
        self._thread = threading.Thread(target=self._work, name=f"write {path.name}", daemon=True)
        self._thread.start()

    @property
    def waiting(self) -> int:
        """How many lines are in memory only, those that are being written included."""
        return len(self._waiting) + self._writing

    def append(self, line: bytes) -> None:
        """Hand a line to the thread."""
        with self._lock:
            self._waiting.append(line + b"\n")
            if len(self._waiting) > self._capacity:
                self._waiting.popleft()
                self.dropped += 1
        self._news.set()

    def close(self) -> None:
        """Give the thread `CLOSE_S` to write what it has; safe to call twice."""
        self._closing = True
        self._news.set()
        self._thread.join(timeout=CLOSE_S)

    def _work(self) -> None:
        file = self._opened()
        if file is None:
            return
        try:
            while (batch := self._next()) and self._written(file, batch):
                self._writing = 0
        finally:
            os.close(file)

    def _opened(self) -> int | None:
        """Open the file, as often as it takes; None when closed before that."""
        while not self._closing:
            try:
                return opened(self._path)
            except OSError as error:
                self.problem = f"{self._path}: {error.strerror}"
                self._pause()
        return None

    def _next(self) -> bytes:
        """The next lines, a batch at a time, waited for; nothing when closed and all is written."""
        while True:
            with self._lock:
                lines = [self._waiting.popleft() for _ in range(min(BATCH, len(self._waiting)))]
                self._writing = len(lines)
            if lines or self._closing:
                return b"".join(lines)
            self._news.wait()
            self._news.clear()

    def _written(self, file: int, batch: bytes) -> bool:
        """Write all of a batch; False when closed before there was room for it."""
        while batch:
            try:
                batch = batch[os.write(file, batch) :]
                self.problem = ""
            except OSError as error:
                self.problem = error.strerror or str(error)
                if self._closing:
                    return False
                self._pause()
        return True

    def _pause(self) -> None:
        """Wait before trying again, or until closed."""
        self._news.wait(RETRY_S)
        self._news.clear()


def opened(path: Path) -> int:
    """Open a file to append to, locked while it is open; what a killed writer left half is cut.

    Raises:
        OSError: if it cannot be opened.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    flags = os.O_RDWR | os.O_CREAT | os.O_APPEND | os.O_NOFOLLOW | os.O_CLOEXEC
    file = os.open(path, flags, 0o644)
    try:
        fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
        size = os.fstat(file).st_size
        whole = whole_bytes(file, size)
        if whole < size:
            os.ftruncate(file, whole)
    except OSError:  # a pipe, or a file system without locks: good enough to write to
        pass
    return file


def whole_bytes(file: int, size: int, *, step: int = 65_536) -> int:
    """How many of the first `size` bytes are whole lines."""
    end = size
    while end > 0:
        begin = max(0, end - step)
        found = os.pread(file, end - begin, begin).rfind(b"\n")
        if found >= 0:
            return begin + found + 1
        end = begin
    return 0


def is_open(path: Path) -> bool:
    """Whether a process has the file open to append to: it lives, wherever it is stuck."""
    try:
        # Without O_NONBLOCK a pipe in its place would be waited at.
        file = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
    except OSError:
        return False
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return True
    finally:
        os.close(file)
    return False
