"""Says lines in a thread of its own: an output that nobody reads holds nobody up."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable

MOST_WAITING = 5_000
"""Lines for an output that nobody reads; older ones are left out."""
CLOSE_S = 1.0


class Printer:
    """Says lines in a thread of its own, as long as somebody reads them."""

    def __init__(self, say: Callable[[str], None]) -> None:
        """Say lines by `say`, which may wait for a reader."""
        self._say = say
        self._lines: deque[str] = deque(maxlen=MOST_WAITING)
        self._news = threading.Event()
        self._closing = False
        self._thread = threading.Thread(target=self._work, name="printer", daemon=True)
        self._thread.start()

    def __call__(self, text: str) -> None:
        """Hand a line over; never waits."""
        self._lines.append(text)
        self._news.set()

    def close(self) -> None:
        """Say what is left, if somebody reads it."""
        self._closing = True
        self._news.set()
        self._thread.join(CLOSE_S)

    def _work(self) -> None:
        while not (self._closing and not self._lines):
            self._news.wait()
            self._news.clear()
            while self._lines:
                self._say(self._lines.popleft())
