"""What else this machine is busy with, so that no test fails because somebody else uses it.

A live test keeps time by the wall clock with processes of its own: on a machine that has other work
to do, the robot notices that it is not given its time, and stops, as it should. The share of the
machine that went to others is measured (Linux, `/proc`), not guessed from how a test went.
"""

import os
import statistics
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import Self

PERIOD_S = 0.5
TICKS_A_SECOND = os.sysconf("SC_CLK_TCK")

STEPS = 10_000


def in_paces(work: Callable[[], object], *, tries: int = 7, warm: bool = False) -> float:
    """How many times as long as a plain loop of 10,000 steps some work takes on this machine now.

    Both are measured in turns, in processor time of this thread, and the least of each counts:
    so neither the machine's make nor what else it does changes the figure much. A pace is some
    0.4 ms of a core that has nothing else to do. `warm`: whether the work was done once before, so
    that what is made the first time is not counted.
    """
    if not warm:
        work()
    took_s, pace_s = list[float](), list[float]()
    for _ in range(tries):
        pace_s.append(_pace_s())
        began_s = time.thread_time()
        work()
        took_s.append(time.thread_time() - began_s)
    return min(took_s) / min(pace_s)


PACE_S = 0.0004
"""What a pace takes on a core that has nothing else to do."""


def slowness() -> float:
    """How many times as much processor time as on a free core the same work takes now; 1 at least.

    Cores that are shared with other guests of a host count what they wait for one another.
    """
    return max(1.0, statistics.median(_pace_s() for _ in range(5)) / PACE_S)


def _pace_s() -> float:
    """What a plain loop takes now, in processor time of this thread."""
    began_s = time.thread_time()
    sum(n * n for n in range(STEPS))
    return time.thread_time() - began_s


class Others:
    """Measures, while it is open, how much of the machine went to others; a context manager.

    Others are processes that this one neither started nor inherited, and other guests of the host.
    """

    def __init__(self) -> None:
        self._ours = {os.getpid()}
        self._spent: dict[int, int] = {}
        self._foreign = 0
        self._over = threading.Event()
        self._watch = threading.Thread(target=self._look_on, daemon=True)
        self._begun = _machine()

    @property
    def share(self) -> float:
        """Of the machine's processor time since it was opened, 0 to 1."""
        total, stolen = (now - then for now, then in zip(_machine(), self._begun, strict=True))
        return (self._foreign + stolen) / max(1, total)

    def __enter__(self) -> Self:
        self._look(count=False)
        self._begun = _machine()
        self._watch.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._over.set()
        self._watch.join()
        self._look(count=True)

    def _look_on(self) -> None:
        while not self._over.wait(PERIOD_S):
            self._look(count=True)

    def _look(self, *, count: bool) -> None:
        for pid, (parent, spent) in sorted(_processes().items()):
            if parent in self._ours:
                self._ours.add(pid)  # for good: orphans get another parent
            elif count and pid not in self._ours:
                self._foreign += spent - self._spent.get(pid, 0)
            self._spent[pid] = spent


def _machine() -> tuple[int, int]:
    """Ticks of all cores since the start, and those that other guests of the host had."""
    ticks = [int(word) for word in Path("/proc/stat").read_text().split("\n", 1)[0].split()[1:9]]
    return sum(ticks), ticks[7]


def _processes() -> dict[int, tuple[int, int]]:
    """Every process: its parent, and the ticks of processor time that it has had."""
    found: dict[int, tuple[int, int]] = {}
    for folder in Path("/proc").iterdir():
        if folder.name.isdigit():
            with suppress(OSError):
                fields = (folder / "stat").read_text().rpartition(")")[2].split()
                found[int(folder.name)] = int(fields[1]), int(fields[11]) + int(fields[12])
    return found
