"""Where time comes from. Nothing else in the project reads the wall clock or sleeps."""

from __future__ import annotations

import contextlib
import os
import select
import time
from typing import Protocol


class Clock(Protocol):
    """Seconds since an arbitrary start, never going back."""

    def now_s(self) -> float:
        """Read the time."""
        ...

    def sleep_until(self, time_s: float) -> None:
        """Return at `time_s` or at once if it has passed."""
        ...


class WallClock:
    """The machine's monotonic clock."""

    def now_s(self) -> float:
        """Read the monotonic clock."""
        return time.monotonic()

    def sleep_until(self, time_s: float) -> None:
        """Sleep, then return."""
        left_s = time_s - time.monotonic()
        if left_s > 0.0:
            time.sleep(left_s)


class SimulatedClock:
    """A clock that somebody else moves: `fast` runs and tests."""

    def __init__(self, start_s: float = 0.0) -> None:
        """Start at `start_s`."""
        self._now_s = start_s

    def now_s(self) -> float:
        """Read the simulated time."""
        return self._now_s

    def set(self, time_s: float) -> None:
        """Move the clock on.

        Raises:
            ValueError: if the time would go back.
        """
        if time_s < self._now_s:
            raise ValueError(f"time would go back from {self._now_s} to {time_s}")
        self._now_s = time_s

    def sleep_until(self, time_s: float) -> None:
        """Move on to `time_s` at once."""
        self._now_s = max(self._now_s, time_s)


class Waker:
    """A wait that another thread or a signal handler can end.

    It is a pipe, because a lock must not be taken in a signal handler.
    """

    def __init__(self) -> None:
        """Open the pipe. Raises OSError: no more files can be open."""
        self._ends: tuple[int, ...] = ()
        self._ends = self._read, self.fd = os.pipe2(os.O_NONBLOCK | os.O_CLOEXEC)

    def wake(self) -> None:
        """End the wait under way, or else the next one."""
        with contextlib.suppress(BlockingIOError):  # it is full: the wait ends anyway
            os.write(self.fd, b"\0")

    def wait(self, timeout_s: float) -> bool:
        """Wait until `wake` or for `timeout_s`; whether it was woken."""
        woken, _, _ = select.select([self._read], [], [], max(timeout_s, 0.0))
        return bool(woken) and bool(self.drain())

    def drain(self) -> bytes:
        """What was written to `fd` since the last time, a byte each."""
        with contextlib.suppress(BlockingIOError):
            return os.read(self._read, 4096)
        return b""

    def __del__(self) -> None:
        """Close the pipe, once nobody can wake it any more."""
        for end in self._ends:
            os.close(end)
