"""When a period of the motors' lines ends: on a grid that a late one moves on, and is counted."""

from __future__ import annotations

from collections.abc import Callable

from robot.clock import Clock

LOOKS = 2
"""A period, for what came in, where a family does not say otherwise: to wake up for every reply
would take a third of a core more."""
ANSWERED = 0.5
"""Of a period, for replies to what went out after its end: else all of them would be late, and what
goes out next, too."""
SAME_S = 1e-6
"""Sums of periods are not exact, and the time of a simulation goes on in whole periods."""


class Periods:
    """Periods of a clock, one after the other.

    Attributes:
        late: those that began late by more than one.
    """

    def __init__(self, clock: Clock, period_s: float) -> None:
        """None has begun."""
        self.late = 0
        self._clock, self._period_s = clock, period_s
        self._ends_s = 0.0

    def begin(self) -> None:
        """One begins now, whatever was before."""
        self._ends_s = self._clock.now_s() + self._period_s

    def wait(self, look: Callable[[], None], *, looks: int = LOOKS) -> None:
        """Wait for the end of this one; the next begins there.

        Args:
            look: takes what came in, now and then.
            looks: so often in a period, the last time at its end.
        """
        now_s = self._clock.now_s()
        if now_s > self._ends_s + self._period_s:
            self.late += 1
            self._ends_s = now_s
        if now_s >= self._ends_s - SAME_S:  # what was just asked is not yet answered
            self._ends_s = now_s + self._period_s * ANSWERED
        until_s = self._ends_s
        while True:
            look_s = self._clock.now_s() + self._period_s / looks
            self._clock.sleep_until(min(until_s, look_s))
            look()
            if (ended_s := self._clock.now_s()) >= until_s - SAME_S:
                break
        begun_s = ended_s if ended_s - until_s < SAME_S else until_s
        self._ends_s = begun_s + self._period_s
