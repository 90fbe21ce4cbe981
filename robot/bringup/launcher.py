"""The process in the terminal: it runs an executive as its child, and the robot that one asks for.

The executive has the terminal; Ctrl-C reaches it once, as it is in the same group. When it dies,
the robot finishes its step and stands by itself, the executive is started again, and goes on. Who
says stop in between is heard here, and the next one stops before it does anything else. After
the last death that the table allows, the robot is lowered and its motors damp.

Nobody could stop a robot whose executive is suspended, so Ctrl-Z is answered with words.
"""

from __future__ import annotations

import contextlib
import math
import os
import signal
import sys
import termios
from collections.abc import Callable, Generator
from pathlib import Path
from types import FrameType
from typing import Any, NamedTuple

import msgspec

from robot.bringup import flags, lowering, private_folder
from robot.bringup.child import POLL_S, Child, describe_exit
from robot.bringup.mailbox import (
    FRONT_FILE,
    RUN_FILE,
    STATE_FILE,
    Front,
    State,
    save,
)
from robot.bringup.processes import EXECUTIVE, PROCESSES, Process
from robot.bringup.supervisor import Supervisor
from robot.bus import run
from robot.clock import Clock, WallClock
from robot.errors import ProcessError, RobotError
from robot.exit_status import ExitStatus
from robot.failures import Failure

WISHED = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
"""Signals that mean that somebody wants it to end."""
PASS_ON_S = 0.5
"""After this the executive is told of a wish that it may not have heard of, as it came here alone.

One that has heard of it takes the second word for the same wish (`SIGTERM`, however often).
"""

STOP_HEARD = "Stop is heard: the robot stands, and nothing goes on when the next executive is up."
NOT_SUSPENDED = "Ctrl-Z does not suspend a robot: nobody could stop it then. Ctrl-C stops it."

_LOCAL, _KEYS = 3, 6
"""Places in what `termios.tcgetattr` returns."""

Tell = Callable[[str], None]


class Ended(NamedTuple):
    """How it ended: the exit status, and why where the executive could not say so itself."""

    status: int
    reason: str = ""
    wished: bool = False
    """Whether somebody ended it by a signal, before it could say a word."""


def launch(
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

    Raises:
        ProcessError: if there is no place for what the processes share.
    """
    clock = clock or WallClock()
    private = private_folder.create()
    child = Child(executive, private.path, log=None, clock=clock)
    front = Front(entry=entry, options=options)
    try:
        return Launcher(
            front, private.path, child, tell=tell, clock=clock, processes=processes
        ).run()
    finally:
        private_folder.remove(private)


class Launcher:
    """One executive at a time, and one robot."""

    def __init__(
        self,
        front: Front,
        private: Path,
        executive: Child,
        *,
        tell: Tell,
        clock: Clock,
        processes: tuple[Process, ...],
    ) -> None:
        """Start nothing yet.

        Raises:
            ProcessError: there is no room for what a stop is told by.
        """
        self._flags = flags.make(private)
        self._front = front
        self._private = private
        self._executive = executive
        self._tell = tell
        self._clock = clock
        self._processes = processes
        self._robot: Supervisor | None = None
        self._state = self._told = State()
        self._died = ""
        self._pass_on_s = math.inf
        self._passed_on = self._unheeded = self._stop_heard = False

    def run(self) -> Ended:
        """Until an executive has ended by itself, or must not be started again."""
        terminal = _Terminal()
        with self._signals():
            try:
                while True:
                    ended = self._one_executive()
                    if ended is None:
                        terminal.hear_stops()  # first: who reads the notice presses Ctrl-C
                        self._tell(self._died)
                        continue
                    if ended.reason or self._front.deaths:
                        terminal.restore()
                    return ended
            finally:
                self._executive.stop()
                if self._robot is not None:
                    self._robot.close()

    def _one_executive(self) -> Ended | None:
        """Run an executive to its end; None to start another one."""
        try:
            save(self._private / FRONT_FILE, self._front)
            self._executive.start()
        except (OSError, RobotError) as error:
            if not self._is_up():
                raise
            return self._give_up(f"the next executive cannot be started: {error}")
        while (status := self._executive.status) is None:
            self._look_after()
            self._pass_on()
            self._answer_keys()
            if self._is_up():
                self._executive.prepare()
            self._clock.sleep_until(self._clock.now_s() + POLL_S)
        self._look_after()
        return self._judge(status)

    def _judge(self, status: int) -> Ended | None:
        """What an executive's end means."""
        wished = self._pass_on_s < math.inf
        if status < 0 and (wished or -status in WISHED):
            return Ended(ExitStatus.FAILED, wished=True)
        if status == ExitStatus.CRASHED and wished:
            return Ended(ExitStatus.FAILED)
        if status >= 0 and status != ExitStatus.CRASHED:
            return Ended(status)
        died = "ended by a mistake" if status == ExitStatus.CRASHED else describe_exit(status)
        if not self._is_up():
            return Ended(ExitStatus.BROKEN, f"the executive {died}")
        if not self._executive.may_start_again:
            often = self._executive.row.restarts + 1
            return self._give_up(f"the executive {died}, {often} times within a minute")
        self._died = f"The executive {died}. The robot finishes its step and stands; going on ..."
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
        return Ended(ExitStatus.BROKEN, f"{why}; {lowered}")

    # --- the robot ---

    def _is_up(self) -> bool:
        """Whether there is a robot, and nothing of it is lost."""
        return self._robot is not None and self._state.failure is None

    def _look_after(self) -> None:
        """Start the robot when it is asked for, and tell the executive how its processes are."""
        if self._robot is None:
            if not (self._private / RUN_FILE).exists():
                return
            wanted = run.load(self._private / RUN_FILE)
            self._robot = Supervisor(
                self._private / RUN_FILE,
                logs=Path(wanted.folder) / "logs",
                clock=self._clock,
                processes=self._processes,
                simulated=wanted.simulated,
                pictures=wanted.pictures,
                owned=wanted.owned,
            )
            try:
                self._robot.__enter__()
            except RobotError as error:
                self._report(self._robot, Failure(code="internal", cause=str(error)))
        self._report(self._robot, self._state.failure or self._robot.check())

    def _report(self, robot: Supervisor, failure: Failure | None) -> None:
        state = State(failure=failure, restarted=tuple(robot.restarted), pids=robot.pids)
        self._state = state
        if state != self._told:
            with contextlib.suppress(ProcessError):  # a full disk ends no robot: told when it can
                save(self._private / STATE_FILE, state)
                self._told = state

    # --- signals ---

    @property
    def _is_deaf(self) -> bool:
        """Whether the executive takes over from one that died, and does not hear people yet."""
        deaths = self._front.deaths
        return deaths > 0 and not self._flags.hears(deaths)

    def _answer_keys(self) -> None:
        """Say what becomes of keys that reach nobody but this process."""
        if self._unheeded:
            self._unheeded = False
            self._tell(NOT_SUSPENDED)
        if self._stop_heard:
            self._stop_heard = False
            self._tell(STOP_HEARD)
        elif self._front.deaths and not self._is_deaf and self._flags.take_stop():
            self._pass_on_s = self._clock.now_s()  # it began to hear in that very moment

    def _pass_on(self) -> None:
        """Tell the executive, once, that somebody wants it to end."""
        if not self._passed_on and self._clock.now_s() >= self._pass_on_s and not self._is_deaf:
            self._passed_on = True
            self._executive.signal(signal.SIGTERM)

    @contextlib.contextmanager
    def _signals(self) -> Generator[None]:
        """Note who wants it to end, or to be suspended.

        Ctrl-C and a closed terminal reach the executive by themselves, a signal to this process
        alone does not, and one that comes while the executive is started may not. To one that takes
        over Ctrl-C is a stop, as it was at the terminal of the one before.
        """
        before = {number: signal.getsignal(number) for number in (*WISHED, signal.SIGTSTP)}

        def hear(number: int, _frame: FrameType | None) -> None:
            if number == signal.SIGTSTP:
                self._unheeded = True
                return
            now_s = self._clock.now_s()
            if self._is_deaf:
                self._flags.leave_stop()
                self._stop_heard = True
                if number == signal.SIGINT:
                    return
            at_once = number == signal.SIGTERM
            self._pass_on_s = min(self._pass_on_s, now_s if at_once else now_s + PASS_ON_S)

        for number, handler in before.items():
            if handler is not signal.SIG_IGN:  # as `nohup` wants it
                signal.signal(number, hear)
        try:
            yield
        finally:
            for number, handler in before.items():
                signal.signal(number, handler)


AFRESH = b"\x1b[?25h\x1b[?2004l\r\n\x1b[J"
"""The cursor is seen, pastes are plain, and of the lines that lived below it nothing is left."""


class _Terminal:
    """The terminal between two executives, and after the last: as it was, cursor and all."""

    def __init__(self) -> None:
        """Remember how it is; nothing, where there is none."""
        try:
            self._modes = termios.tcgetattr(sys.stdin.fileno())
        except (termios.error, ValueError, OSError):
            self._modes = None

    def restore(self) -> None:
        """Put it back as it was."""
        if self._modes is not None:
            self._set(termios.TCSADRAIN, self._modes)

    def hear_stops(self) -> None:
        """Let Ctrl-C be a signal, where the dead executive read it as a key.

        All else stays as it was left, so that what is typed waits for the next executive as keys:
        a terminal that gathers lines would swallow Ctrl-D and the like.
        """
        if self._modes is None:
            return
        with contextlib.suppress(termios.error, OSError):
            modes = termios.tcgetattr(sys.stdin.fileno())
            if not modes[_LOCAL] & termios.ICANON:
                modes[_LOCAL] |= termios.ISIG
                modes[_KEYS][termios.VQUIT] = modes[_KEYS][termios.VSUSP] = b"\0"
                self._set(termios.TCSANOW, modes)

    def _set(self, when: int, modes: list[Any]) -> None:
        with contextlib.suppress(termios.error, OSError):
            termios.tcsetattr(sys.stdin.fileno(), when, modes)
        if sys.stdout.isatty():
            os.write(sys.stdout.fileno(), AFRESH)
