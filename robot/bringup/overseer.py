"""The process in the terminal: it runs an executive as its child, and the robot that one asks for.

The executive has the terminal; Ctrl-C reaches it once, as it is in the same group. When it dies,
the robot finishes its step and stands by itself, the executive is started again, and goes on. After
the last death that the table allows, the robot is lowered and its motors damp.
"""

from __future__ import annotations

import contextlib
import math
import os
import signal
import subprocess
import sys
import termios
from collections.abc import Callable, Generator
from pathlib import Path
from types import FrameType
from typing import Any, NamedTuple

import msgspec

from robot.bringup import lowering, private_folder
from robot.bringup.overseen import FRONT_FILE, RUN_FILE, STATE_FILE, Front, State, save
from robot.bringup.processes import EXECUTIVE, PROCESSES, Process
from robot.bringup.supervisor import Supervisor, command, describe_exit, environment
from robot.bus import run
from robot.clock import Clock, WallClock
from robot.errors import Failure, RobotError

POLL_S = 0.01
STOP_S = 8.0
SPARE_AFTER_S = 6.0
"""How long after an executive's start a spare is loaded: it would compete for the processor."""
CRASHED = 70
"""Exit status of an executive that ends by an exception nobody expected (EX_SOFTWARE)."""
BROKEN, STOPPED = 3, 1
WISHED = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
"""Signals that mean that somebody wants it to end."""

Tell = Callable[[str], None]


class Ended(NamedTuple):
    """How it ended: the exit status, and why where the executive could not say so itself."""

    status: int
    reason: str = ""


def oversee(
    entry: str,
    options: dict[str, Any],
    *,
    tell: Tell,
    clock: Clock | None = None,
    executive: Process = EXECUTIVE,
    processes: tuple[Process, ...] = PROCESSES,
) -> Ended:
    """Run a front end in an executive of its own, until that ends, or dies once too often.

    Args:
        entry: name of the front end.
        options: plain data.
        tell: says a line to people.
        clock: the wall's; another one in tests.
        executive: its row of the table.
        processes: of the robot.
    """
    private = private_folder.create()
    overseer = Overseer(
        Front(entry=entry, options=options), private, tell=tell, clock=clock or WallClock(),
        executive=executive, processes=processes,
    )  # fmt: skip
    try:
        return overseer.run()
    finally:
        private_folder.remove(private)


class Overseer:
    """One executive at a time, and one robot."""

    def __init__(
        self,
        front: Front,
        private: Path,
        *,
        tell: Tell,
        clock: Clock,
        executive: Process,
        processes: tuple[Process, ...],
    ) -> None:
        """Start nothing yet."""
        self._front = front
        self._private = private
        self._tell = tell
        self._clock = clock
        self._executive = executive
        self._processes = processes
        self._starts_s: list[float] = []
        self._crew: Supervisor | None = None
        self._state = State()
        self._wished = False
        self._child: subprocess.Popen[bytes] | None = None
        self._spare: subprocess.Popen[bytes] | None = None
        self._spare_due_s = math.inf

    def run(self) -> Ended:
        """Until an executive has ended by itself, or must not be started again."""
        with _terminal() as restore, self._signals():
            try:
                while True:
                    ended = self._one_executive()
                    if ended is None or ended.reason:
                        restore()
                    if ended is not None:
                        return ended
            finally:
                self._end_child()
                if self._crew is not None:
                    self._crew.close()

    def _one_executive(self) -> Ended | None:
        """Run an executive to its end; None to start another one."""
        save(self._private / FRONT_FILE, self._front)
        self._starts_s.append(self._clock.now_s())
        spare, self._spare = self._spare, None
        ready = spare is not None and spare.poll() is None
        child = self._child = spare if spare and ready else self._start(self._front.deaths)
        self._spare_due_s = self._clock.now_s() + SPARE_AFTER_S
        while child.poll() is None:
            self._look_after()
            self._prepare()
            self._clock.sleep_until(self._clock.now_s() + POLL_S)
        self._look_after()
        return self._judge(child.returncode)

    def _start(self, number: int) -> subprocess.Popen[bytes]:
        """Start the executive of that number; it waits until so many have died before it.

        Ctrl-C is held back from it until it can hear: a wish to stop must not be lost meanwhile.
        """
        before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
        try:
            return subprocess.Popen(
                [*command(self._executive, self._private), str(number)], env=environment()
            )
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)

    def _prepare(self) -> None:
        """Have a spare executive ready, loaded and waiting, once the robot is up."""
        up = self._crew is not None and self._state.failure is None
        if up and self._clock.now_s() > self._spare_due_s:
            self._spare_due_s = math.inf
            if self._executive.may_start_again(self._starts_s, self._clock.now_s()):
                self._spare = self._start(self._front.deaths + 1)

    def _judge(self, code: int) -> Ended | None:
        """What an executive's end means."""
        if code < 0 and (self._wished or -code in WISHED):
            return Ended(STOPPED)
        if code >= 0 and code != CRASHED:
            return Ended(code)
        died = "ended by a mistake" if code == CRASHED else describe_exit(code)
        if self._crew is None or self._state.failure is not None:
            return Ended(BROKEN, f"the executive {died}")
        if not self._executive.may_start_again(self._starts_s, self._clock.now_s()):
            often = self._executive.restarts + 1
            return self._give_up(f"the executive {died}, {often} times within a minute")
        self._tell(f"The executive {died}. The robot finishes its step and stands; going on ...")
        deaths = self._front.deaths + 1
        self._front = msgspec.structs.replace(self._front, deaths=deaths)
        return None

    def _give_up(self, why: str) -> Ended:
        """Lower the robot and let it damp."""
        self._tell(f"The executive is not started again: {why}. Lowering the robot ...")
        try:
            lowered = lowering.lower(run.load(self._private / RUN_FILE), clock=self._clock)
        except RobotError as error:
            lowered = f"the robot could not be lowered: {error}"
        return Ended(BROKEN, f"{why}; {lowered}")

    # --- the robot ---

    def _look_after(self) -> None:
        """Start the robot when it is asked for, and tell the executive how its processes are."""
        if self._crew is None:
            if not (self._private / RUN_FILE).exists():
                return
            wanted = run.load(self._private / RUN_FILE)
            self._crew = Supervisor(
                self._private / RUN_FILE,
                logs=Path(wanted.folder) / "logs",
                clock=self._clock,
                processes=self._processes,
            )
            try:
                self._crew.__enter__()
            except RobotError as error:
                self._report(Failure(code="internal", cause=str(error)))
        self._report(self._state.failure or self._crew.check())

    def _report(self, failure: Failure | None) -> None:
        crew = self._crew
        if crew is None:
            return
        pids = {one.name: crew.pid(one.name) for one in self._processes if crew.knows(one.name)}
        state = State(failure=failure, restarted=tuple(crew.restarted), pids=pids)
        if state != self._state:
            self._state = state
            save(self._private / STATE_FILE, state)

    # --- signals ---

    @contextlib.contextmanager
    def _signals(self) -> Generator[None]:
        """Ctrl-C and a closed terminal reach the executive by themselves; SIGTERM is passed on."""
        before = {number: signal.getsignal(number) for number in WISHED}

        def hear(number: int, _frame: FrameType | None) -> None:
            self._wished = True
            if number == signal.SIGTERM and self._child is not None:
                self._child.send_signal(signal.SIGTERM)

        for number, handler in before.items():
            if handler is not signal.SIG_IGN:  # as `nohup` wants it
                signal.signal(number, hear)
        try:
            yield
        finally:
            for number, handler in before.items():
                signal.signal(number, handler)

    def _end_child(self) -> None:
        """Leave no executive behind, whatever went wrong here."""
        if self._spare is not None:
            self._spare.kill()
            self._spare.wait()
        child = self._child
        if child is None or child.poll() is not None:
            return
        child.send_signal(signal.SIGTERM)
        try:
            child.wait(STOP_S)
        except subprocess.TimeoutExpired:
            child.kill()
            child.wait()


@contextlib.contextmanager
def _terminal() -> Generator[Callable[[], None]]:
    """Remember how the terminal is; what is yielded puts it back as it was, cursor and all."""
    try:
        modes = termios.tcgetattr(sys.stdin.fileno())
    except (termios.error, ValueError, OSError):
        yield lambda: None
        return

    def restore() -> None:
        with contextlib.suppress(termios.error, OSError):
            termios.tcsetattr(sys.stdin.fileno(), termios.TCSADRAIN, modes)
        if sys.stdout.isatty():
            os.write(sys.stdout.fileno(), b"\x1b[?25h\x1b[?2004l\r\n")

    yield restore
