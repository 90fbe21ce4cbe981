"""Emulated devices that a thread plays on the wall clock, for clients that know nothing of us."""

import threading
import time
from collections.abc import Callable
from typing import Protocol

from robot.clock import WallClock

PATIENCE_S = 60.0


class Steps(Protocol):
    """A server of emulated lines."""

    def step(self, until_s: float) -> None: ...

    def close(self) -> None: ...


class Playing:
    """Plays a server until it is closed."""

    def __init__(self, server: Steps) -> None:
        self.server = server
        self._ends = threading.Event()
        self._thread = threading.Thread(target=self._serve)
        self._thread.start()

    def _serve(self) -> None:
        while not self._ends.is_set():
            self.server.step(WallClock().now_s() + 0.01)

    def close(self) -> None:
        self._ends.set()
        self._thread.join()
        self.server.close()


def until(holds: Callable[[], bool]) -> None:
    """Try until it holds: that it never does is the only way to fail, a machine may be busy."""
    ends_s = time.monotonic() + PATIENCE_S
    while not holds():
        assert time.monotonic() < ends_s
        time.sleep(0.005)
