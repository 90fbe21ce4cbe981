"""Runs an executive on a runtime until its task is over; the same in `fast` and in `live`."""

from __future__ import annotations

import signal
from collections.abc import Callable, Generator, Mapping
from contextlib import contextmanager
from types import FrameType
from typing import Protocol, runtime_checkable

from executive.app import RATE_HZ, Executive
from robot.clock import Clock
from robot.errors import Failure
from robot.link import BodyLink
from robot.messages import Damp, LoopTiming

PERIOD_S = 1.0 / RATE_HZ


class Runtime(Protocol):
    """A robot in a world, fast or live (`robot.bringup`): time passes in `advance`."""

    @property
    def link(self) -> BodyLink:
        """The handle on the body."""
        ...

    @property
    def clock(self) -> Clock:
        """The runtime's time."""
        ...

    def advance(self, duration_s: float) -> None:
        """Let time pass."""
        ...

    def failure(self) -> Failure | None:
        """Why the run cannot go on, None while it can."""
        ...


@runtime_checkable
class Timed(Protocol):
    """A runtime that knows how well its loops keep their time."""

    @property
    def timing(self) -> Mapping[str, LoopTiming]:
        """The newest report of each process."""
        ...


class Interrupts:
    """Counts Ctrl-C: the first asks for a safe stop, the second for damping at once."""

    def __init__(self) -> None:
        """None yet."""
        self.count = 0

    @contextmanager
    def listen(self) -> Generator[None]:
        """Count SIGINT and SIGTERM inside the block; the third Ctrl-C raises KeyboardInterrupt."""
        before = {name: signal.getsignal(name) for name in (signal.SIGINT, signal.SIGTERM)}
        for name in before:
            signal.signal(name, self._heard)
        try:
            yield
        finally:
            for name, handler in before.items():
                signal.signal(name, handler)

    def _heard(self, _number: int, _frame: FrameType | None) -> None:
        self.count += 1
        if self.count > 2:
            raise KeyboardInterrupt


def run(
    runtime: Runtime,
    executive: Executive,
    *,
    interrupts: Interrupts,
    on_tick: Callable[[], None] = lambda: None,
) -> None:
    """Tick until `executive.outcome` is set.

    Args:
        runtime: the body and its time.
        executive: with a task begun.
        interrupts: looked at every tick.
        on_tick: called after every tick, to show people what goes on.
    """
    stopping = False
    while executive.outcome is None:
        runtime.advance(PERIOD_S)
        now_s = runtime.clock.now_s()
        lost = runtime.failure()
        if lost is not None:
            executive.abandon(lost, now_s)
        elif interrupts.count > 1:
            link = runtime.link
            link.send(Damp(id=link.next_id(), stamp_s=now_s))
            runtime.advance(PERIOD_S)
            executive.abandon(None, now_s)
        else:
            if interrupts.count and not stopping:
                stopping = True
                executive.stop("stopped on request")
            executive.tick(now_s)
        on_tick()
