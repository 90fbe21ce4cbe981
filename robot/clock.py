"""Where time comes from. Nothing else in the project reads the wall clock or sleeps."""

from __future__ import annotations

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
