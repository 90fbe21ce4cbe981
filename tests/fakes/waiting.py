"""Waiting for other processes and threads until something is so."""

import time
from collections.abc import Callable

HANG_S = 240.0
"""How long until a test is taken to hang: no promise, and far beyond what a busy machine needs."""


def eventually(true: Callable[[], object], *, within_s: float = HANG_S) -> bool:
    """Whether a condition comes true before patience ends; looks every millisecond."""
    until_s = time.monotonic() + within_s
    while time.monotonic() < until_s:
        if true():
            return True
        time.sleep(0.001)
    return bool(true())
