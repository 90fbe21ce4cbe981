"""Waiting for other processes and threads until something is so."""

import time
from collections.abc import Callable

HANG_S = 240.0
"""How long until a test is taken to hang: no promise, and far beyond what a busy machine needs."""


RESTS = 4.0
"""A rest is as many times as long as the look before it: whoever looks leaves the others a core."""

SHORTEST_REST_S, LONGEST_REST_S = 0.001, 0.1


def eventually(true: Callable[[], object], *, within_s: float = HANG_S) -> bool:
    """Whether a condition comes true before patience ends."""
    until_s = time.monotonic() + within_s
    while (began_s := time.monotonic()) < until_s:
        if true():
            return True
        looked_s = time.monotonic() - began_s
        time.sleep(min(max(SHORTEST_REST_S, RESTS * looked_s), LONGEST_REST_S))
    return bool(true())
