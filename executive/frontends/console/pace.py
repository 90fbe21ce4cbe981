"""How much of what a page sends is heeded: as much as a person sends; a cry to stop always is."""

from __future__ import annotations

from executive.frontends.console.desk import Order
from intents.stopping import is_stop

CRIES = ("stop", "estop")
"""Buttons that stop."""
LONGEST_CRY = 300
"""Letters of a line in which a cry is looked for while a page sends too much: nobody cries more."""
BURST, PER_S = 60, 10.0
"""Orders at once, as a paste is, and how many a second then (design)."""


def is_cry(order: Order) -> bool:
    """Whether an order stops the robot, however much comes with it."""
    return order.do in CRIES or is_stop(order.line)


class Pace:
    """Of one page: a bucket of orders that fills again."""

    def __init__(self, *, burst: float = BURST, per_s: float = PER_S) -> None:
        """Begin with a full one."""
        self._burst, self._per_s = burst, per_s
        self._left = burst
        self._at_s: float | None = None
        self.refused = 0
        """Orders that were refused since the last one that was not."""

    def heeds(self, order: Order, now_s: float) -> bool:
        """Whether an order that comes at a time is handed on."""
        if self._at_s is not None:
            self._left = min(self._burst, self._left + self._per_s * (now_s - self._at_s))
        self._at_s = now_s
        if self._left >= 1.0:
            self._left -= 1.0
            self.refused = 0
            return True
        if len(order.line) <= LONGEST_CRY and is_cry(order):
            return True
        self.refused += 1
        return False
