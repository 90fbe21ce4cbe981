"""How who waits for another process sleeps: long at first, then in short naps."""

from __future__ import annotations

from robot.clock import Clock

POLL_S = 0.0001
SLEPT_SHARE, MOST_SLEPT_S = 0.5, 0.001
"""For this part of the last wait the next one is slept through: whoever looks every 0.1 ms wakes up
ten times a period for nothing, on a machine that has better things to do."""


class Naps:
    """Of one who waits again and again for about as long."""

    def __init__(self, clock: Clock) -> None:
        """Nothing was waited for yet."""
        self._clock = clock
        self._first_s = POLL_S
        self._begun_s = 0.0
        self._is_first = True

    def begin(self) -> None:
        """A wait begins."""
        self._begun_s, self._is_first = self._clock.now_s(), True

    def nap(self) -> None:
        """Sleep a little."""
        nap_s = self._first_s if self._is_first else POLL_S
        self._is_first = False
        self._clock.sleep_until(self._clock.now_s() + nap_s)

    def end(self) -> None:
        """What was waited for came, or is waited for no longer."""
        waited_s = self._clock.now_s() - self._begun_s
        self._first_s = max(POLL_S, min(SLEPT_SHARE * waited_s, MOST_SLEPT_S))
