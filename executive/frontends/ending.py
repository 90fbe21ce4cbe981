"""Signals that ask a long command to end, heard as a wish that it asks about."""

from __future__ import annotations

import multiprocessing
import os
import signal
from types import FrameType

from robot.clock import Clock, WallClock
from robot.closing import Closing
from robot.exit_status import ExitStatus

WISHED = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
PATIENCE_S = 2.0
"""What an orderly end may take before the next signal ends it without one; it takes 0.5 s."""


class Ending(Closing):
    """From its making to its close: the first signal is a wish.

    A later one, where the wish is not fulfilled within `PATIENCE_S`, kills the workers and leaves.
    Only in the main thread. A signal that is ignored (`nohup`) stays so.

    Attributes:
        asked: whether somebody wants it to end.
    """

    def __init__(self, clock: Clock | None = None) -> None:
        """Listen from now on."""
        self.asked = False
        self._clock = clock or WallClock()
        self._asked_s = 0.0
        heard = [number for number in WISHED if signal.getsignal(number) is not signal.SIG_IGN]
        self._before = {number: signal.signal(number, self._hear) for number in heard}

    def close(self) -> None:
        """Signals do again what they did before."""
        while self._before:
            signal.signal(*self._before.popitem())

    def _hear(self, _number: int, _frame: FrameType | None) -> None:
        if not self.asked:
            self.asked, self._asked_s = True, self._clock.now_s()
        elif self._clock.now_s() - self._asked_s > PATIENCE_S:
            self._leave()

    def _leave(self) -> None:
        for worker in multiprocessing.active_children():
            worker.kill()
        os._exit(ExitStatus.FAILED)
