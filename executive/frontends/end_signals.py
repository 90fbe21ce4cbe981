"""Signals that ask a long command to end, heard as a wish that it asks about."""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
from collections.abc import Generator
from contextlib import contextmanager
from types import FrameType

from robot.clock import Clock, WallClock
from robot.closing import Closing
from robot.exit_status import ExitStatus

WISHED = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
PATIENCE_S = 2.0
"""What an orderly end may take before the next signal ends it without one; it takes 0.5 s."""
SHOWN = b"\x1b[?25h"
"""Shows a terminal's cursor again, which what is drawn there may have hidden."""


class Ending(Closing):
    """From its making to its close: the first signal is a wish.

    A later one, where the wish is not fulfilled within some time, kills the workers and leaves.
    Only in the main thread. A signal that is ignored (`nohup`) stays so.

    Attributes:
        asked: whether somebody wants it to end.
    """

    def __init__(self, clock: Clock | None = None, *, patience_s: float = PATIENCE_S) -> None:
        """Listen from now on.

        Args:
            clock: of the wall; another one in tests.
            patience_s: so long after the first signal no other one counts.
        """
        self.asked = False
        self._clock, self._patience_s = clock or WallClock(), patience_s
        self._asked_s = 0.0
        self._breaks = False
        heard = [number for number in WISHED if signal.getsignal(number) is not signal.SIG_IGN]
        self._before = {number: signal.signal(number, self._hear) for number in heard}

    def close(self) -> None:
        """Signals do again what they did before."""
        while self._before:
            signal.signal(*self._before.popitem())

    @contextmanager
    def breaking(self) -> Generator[None]:
        """The wish breaks the block off, which cannot ask about it: by a KeyboardInterrupt."""
        self._breaks = True
        try:
            if self.asked:
                raise KeyboardInterrupt
            yield
        finally:
            self._breaks = False

    def _hear(self, _number: int, _frame: FrameType | None) -> None:
        if not self.asked:
            self.asked, self._asked_s = True, self._clock.now_s()
            if self._breaks:
                raise KeyboardInterrupt
        elif self._clock.now_s() - self._asked_s >= self._patience_s:
            self._leave()

    def _leave(self) -> None:
        for worker in multiprocessing.active_children():
            worker.kill()
        if sys.stderr.isatty():
            os.write(sys.stderr.fileno(), SHOWN)
        os._exit(ExitStatus.FAILED)
