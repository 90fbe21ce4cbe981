"""Runs an executive on a runtime until its task is over; the same in `fast` and in `live`."""

from __future__ import annotations

import signal
from collections.abc import Callable, Generator, Mapping, Sequence
from contextlib import contextmanager
from types import FrameType
from typing import Protocol, runtime_checkable

from executive.engine.executive import RATE_HZ, Executive
from robot.clock import Clock, Waker
from robot.failures import Failure
from robot.link import BodyLink
from robot.messages import Damp, LoopTiming
from robot.reality.faults import Fault

PERIOD_S = 1.0 / RATE_HZ
STANDING_S = 0.1
"""How often `until` is asked while time stands still."""
PATIENCE_S = 2.0
"""A wish that no tick has heeded for so long comes to something that takes much longer."""


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

    def inject(self, fault: Fault) -> None:
        """Let a fault happen (`executive.runs.faults`); raises ConfigError where that cannot be."""
        ...


@runtime_checkable
class Timed(Protocol):
    """A runtime that knows how well its loops keep their time."""

    @property
    def timing(self) -> Mapping[str, LoopTiming]:
        """The newest report of each process."""
        ...


@runtime_checkable
class Wakeable(Protocol):
    """A runtime on the wall clock, whose `advance` can be cut short."""

    def wake(self) -> None:
        """Let `advance` return at once; from any thread, and from a signal handler."""
        ...


@runtime_checkable
class Mended(Protocol):
    """A runtime that starts parts of itself again."""

    @property
    def restarted(self) -> Sequence[str]:
        """What was started again so far, in order, a sentence each."""
        ...


def _nothing() -> None:
    """Wake nobody."""


class BrokenOff(KeyboardInterrupt):
    """Ctrl-C that came while one computation kept a simulated robot, and everything, waiting."""


class Interrupts:
    """Counts Ctrl-C: the first asks for a safe stop, the second for damping at once.

    The third leaves with KeyboardInterrupt, wherever it comes. Signals are counted where they
    arrive, by the interpreter's wake-up pipe: two that come during one long call are two.

    SIGTERM and SIGHUP ask for the same safe stop, and for no more however often they come: a shell
    and the kernel each tell of one closed terminal, and only a person who presses again is in
    a hurry.

    A `fast` robot ticks in the thread that computes its plans and builds its world. Where the next
    tick is longer than some time in coming, `listen` breaks off what keeps it (`patience_s`).
    """

    def __init__(self) -> None:
        """None yet."""
        self.unseen = False
        """Whether no tick has looked since the last one came."""
        self.count = 0
        self.pressed = 0
        """As `count`, but never from zero again."""
        self.leaving = False
        """Whether SIGTERM or SIGHUP came: whoever sent it wants the program to end."""
        self.heeded = False
        """Whether the stop that the first one asks for has been asked for."""
        self.on_press: Callable[[], None] = _nothing
        self._keys = 0

    def press(self, times: int = 1) -> None:
        """Count as if Ctrl-C had been pressed; raises KeyboardInterrupt from the third on."""
        self._keys += times
        self.count = max(self.count, self._keys)
        self.pressed += times
        self.on_press()
        if self.count > 2:
            raise KeyboardInterrupt

    def wish(self) -> None:
        """Count as if somebody wanted it to end, which is one wish however often it is told."""
        self.count = max(self.count, 1)
        self.pressed += 1
        self.on_press()

    def clear(self) -> None:
        """What was asked for has been done; count from zero."""
        self.count = self._keys = 0
        self.heeded = False

    @contextmanager
    def listen(self, *, patience_s: float | None = None) -> Generator[None]:
        """Count SIGINT, SIGTERM and SIGHUP inside the block; in the main thread only.

        Args:
            patience_s: raise `BrokenOff` where one has been waiting for a tick so long; None: let
                it wait. SIGALRM is in use then.
        """
        numbers = {signal.SIGINT, signal.SIGTERM}
        if signal.getsignal(signal.SIGHUP) is not signal.SIG_IGN:  # as `nohup` wants it
            numbers.add(signal.SIGHUP)
        pipe = Waker()

        def heard(_number: int, _frame: FrameType | None) -> None:
            arrived = [number for number in pipe.drain() if number in numbers]
            presses = arrived.count(signal.SIGINT)
            if presses < len(arrived):
                self.leaving = True
                self.wish()
            if presses:  # else they were counted with the signal before
                self.press(presses)

        def noted(number: int, frame: FrameType | None) -> None:
            if patience_s is not None and not self.unseen:
                signal.setitimer(signal.ITIMER_REAL, patience_s)
            self.unseen = True
            heard(number, frame)

        def waited(_number: int, _frame: FrameType | None) -> None:
            if self.unseen:
                self.unseen = False
                raise BrokenOff

        handlers = {number: signal.signal(number, noted) for number in numbers}
        if patience_s is not None:
            handlers[signal.SIGALRM] = signal.signal(signal.SIGALRM, waited)
        wakeup_fd = signal.set_wakeup_fd(pipe.fd, warn_on_full_buffer=False)
        try:
            yield
        finally:
            if patience_s is not None:
                signal.setitimer(signal.ITIMER_REAL, 0.0)
            signal.set_wakeup_fd(wakeup_fd)
            for number, handler in handlers.items():
                signal.signal(number, handler)


def run(
    runtime: Runtime,
    executive: Executive,
    *,
    interrupts: Interrupts,
    on_tick: Callable[[], None] = _nothing,
    until: Callable[[], bool] | None = None,
) -> None:
    """Tick until `executive.outcome` is set, or until `until` says so, or the robot is lost.

    Requests and Ctrl-C cut the wait for the next tick short, so they act at once. While a
    `fast` robot is paused and somebody is there to let it go on, its time stands still.

    Args:
        runtime: the body and its time.
        executive: with a job submitted, unless there is `until`.
        interrupts: looked at every tick.
        on_tick: called after every tick, to show people what goes on.
        until: ends the loop between ticks; called every tick.
    """
    over = until or (lambda: executive.outcome is not None)
    waker = Waker()
    wake = runtime.wake if isinstance(runtime, Wakeable) else waker.wake
    executive.on_request = interrupts.on_press = wake
    told = len(_restarted(runtime))
    try:
        while not over():
            if not isinstance(runtime, Wakeable) and executive.awaits_operator:
                if not waker.wait(STANDING_S):
                    continue
            else:
                runtime.advance(PERIOD_S)
            for text in _restarted(runtime)[told:]:
                executive.journal.write(runtime.clock.now_s(), "warning", text=text)
                told += 1
            going_on = _tick(runtime, executive, interrupts)
            on_tick()
            if not going_on:
                return
    except BrokenOff:
        _damp(runtime)
        executive.abandon(None, runtime.clock.now_s())
    except KeyboardInterrupt:
        _damp(runtime)
        raise
    finally:
        executive.on_request = interrupts.on_press = _nothing


def _restarted(runtime: Runtime) -> Sequence[str]:
    return runtime.restarted if isinstance(runtime, Mended) else ()


def _tick(runtime: Runtime, executive: Executive, interrupts: Interrupts) -> bool:
    """One tick, or the end of all jobs; whether it goes on."""
    interrupts.unseen = False
    now_s = runtime.clock.now_s()
    lost = runtime.failure()
    if lost is not None:
        executive.abandon(lost, now_s)
        return False
    if interrupts.count > 1:
        _damp(runtime)
        runtime.advance(PERIOD_S)
        executive.abandon(None, now_s)
        return False
    if interrupts.count and not interrupts.heeded:
        interrupts.heeded = True
        executive.stop("stopped on request")
    executive.tick(now_s)
    if interrupts.heeded and executive.state != "stopping":
        interrupts.clear()  # it stands: the next one is a first one again
    return True


def _damp(runtime: Runtime) -> None:
    """Let the motors go soft."""
    link = runtime.link
    link.send(Damp(id=link.next_id(), stamp_s=runtime.clock.now_s()))
