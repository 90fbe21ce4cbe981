"""When something happened, on a clock that all processes of a machine share: seconds since boot.

So a process can tell another one when it began: what people asked for at a terminal they asked for
before the process that hands it on was loaded.
"""

from __future__ import annotations

import os
import time
from contextlib import suppress
from pathlib import Path

_STARTED = 22
"""Which field of /proc/PID/stat says when a process began, in ticks (proc(5)), counted from 1."""


def now_s() -> float:
    """Now [s since boot], sleep of the machine included."""
    return time.clock_gettime(time.CLOCK_BOOTTIME)


def process_began_s() -> float | None:
    """When this process began [s since boot]; None where that cannot be found out.

    It is rounded down to a tick of the kernel's (10 ms), so it is never said to be too late.
    """
    with suppress(OSError, ValueError, IndexError):
        stat = Path("/proc/self/stat").read_text(encoding="utf-8", errors="replace")
        after_name = stat.rpartition(")")[2].split()  # a name may hold blanks and brackets
        return int(after_name[_STARTED - 3]) / os.sysconf("SC_CLK_TCK")
    return None
