"""Waiting for other processes and threads, with a limit instead of a guess."""

import time
from collections.abc import Callable


def eventually(true: Callable[[], object], *, within_s: float = 5.0) -> bool:
    """Whether a condition comes true in time; looks every millisecond."""
    until_s = time.monotonic() + within_s
    while time.monotonic() < until_s:
        if true():
            return True
        time.sleep(0.001)
    return bool(true())
