"""Whether the other end of a quiet connection still answers: it is asked, and only then."""

from __future__ import annotations

from collections.abc import Callable

from executive.frontends.service.client import ANSWER_S

QUIET_S = 2.0
"""After so long without a word the other end is asked for one."""


class Pulse:
    """Follows a connection. That nothing is told means nothing: a robot at rest has no news.

    Attributes:
        lost: whether it was asked, and has not answered for `ANSWER_S`.
    """

    def __init__(self, ask: Callable[[], object], *, now_s: float) -> None:
        """Begin; `ask` sends what is answered at once."""
        self._ask = ask
        self._heard_s = now_s
        self._asked_s: float | None = None
        self.lost = False

    def heard(self, now_s: float) -> bool:
        """Something came; whether it had been lost."""
        self._heard_s, self._asked_s = now_s, None
        was, self.lost = self.lost, False
        return was

    def look(self, now_s: float) -> bool:
        """Ask where it has been quiet; whether it has just been lost."""
        if self._asked_s is None:
            if now_s - self._heard_s >= QUIET_S:
                self._asked_s = now_s
                self._ask()
            return False
        if self.lost or now_s - self._asked_s < ANSWER_S:
            return False
        self.lost = True
        return True
