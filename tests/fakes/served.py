"""Emulated devices that a thread plays on the wall clock, for clients that know nothing of us."""

import queue
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
        self._wanted: queue.SimpleQueue[Callable[[], None]] = queue.SimpleQueue()
        self._thread = threading.Thread(target=self._serve)
        self._thread.start()

    def _serve(self) -> None:
        while not self._ends.is_set():
            self.server.step(WallClock().now_s() + 0.01)
            while not self._wanted.empty():
                self._wanted.get()()

    def between_steps(self, act: Callable[[], None]) -> None:
        """Do something to the server while it waits for nobody, and wait until that is done."""
        is_done = threading.Event()

        def run() -> None:
            try:
                act()
            finally:
                is_done.set()

        self._wanted.put(run)
        assert is_done.wait(PATIENCE_S)

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
