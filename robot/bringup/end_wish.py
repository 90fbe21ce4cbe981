"""A wish that a motion ends, by a signal: heard without breaking into what lets a motor go."""

from __future__ import annotations

import signal
import threading
from types import FrameType
from typing import Self

from robot.clock import Clock
from robot.closing import Closing

WISHED = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
PATIENCE_S = 3.0
"""What ending may take before a further signal breaks it off; to let one motor go takes 0.7 s."""


class EndWish(Closing):
    """A context manager: inside, a signal is a wish that is asked about.

    A KeyboardInterrupt while a motor is being let go would leave it unsaid whether it was, so that
    none is raised but by a signal that comes more than `PATIENCE_S` after the first. Outside the
    main thread no signal is heard. One that is ignored (`nohup`) stays so.

    Attributes:
        asked: whether somebody wants it to end.
    """

    def __init__(self, clock: Clock) -> None:
        """Hear nothing yet."""
        self.asked = False
        self._clock, self._asked_s = clock, 0.0
        self._before: dict[signal.Signals, object] = {}

    def __enter__(self) -> Self:
        """Hear signals from now on."""
        if threading.current_thread() is threading.main_thread():
            for number in WISHED:
                if signal.getsignal(number) is not signal.SIG_IGN:
                    self._before[number] = signal.signal(number, self._hear)
        return self

    def close(self) -> None:
        """Signals do again what they did before."""
        while self._before:
            number, before = self._before.popitem()
            if callable(before) or isinstance(before, int):
                signal.signal(number, before)

    def _hear(self, _number: int, _frame: FrameType | None) -> None:
        now_s = self._clock.now_s()
        if not self.asked:
            self.asked, self._asked_s = True, now_s
        elif now_s - self._asked_s > PATIENCE_S:
            raise KeyboardInterrupt
