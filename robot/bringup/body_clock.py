"""The body's time on this side of the bus: follows the stamps of its states between messages."""

from __future__ import annotations

from robot.bus import topics
from robot.bus.bus import Bus
from robot.clock import Clock


class BodyClock:
    """A clock in the plant's time, which in a slow simulation runs slower than the wall's.

    Between states it goes on at the wall's pace, so ages and timeouts go on if the body is dead.
    """

    def __init__(self, bus: Bus, wall: Clock) -> None:
        self._states = bus.subscribe(topics.BODY_STATE)
        self._wall = wall
        self._stamp_s: float | None = None
        self._stamped_at_s = 0.0
        self._now_s = 0.0

    def now_s(self) -> float:
        """The body's time; 0 before its first state, never going back."""
        state = self._states.latest
        wall_s = self._wall.now_s()
        if state is not None and state.stamp_s != self._stamp_s:
            self._stamp_s, self._stamped_at_s = state.stamp_s, wall_s
        if self._stamp_s is not None:
            self._now_s = max(self._now_s, self._stamp_s + wall_s - self._stamped_at_s)
        return self._now_s

    def sleep_until(self, time_s: float) -> None:
        """Sleep as if the body's time went at the wall's pace."""
        left_s = time_s - self.now_s()
        if left_s > 0.0:
            self._wall.sleep_until(self._wall.now_s() + left_s)
