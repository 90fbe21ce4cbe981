"""A process of the table as a child of this one: started, kept a spare of, and stopped."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Generator
from contextlib import contextmanager, suppress
from pathlib import Path

import robot
from robot.bringup.processes import Process
from robot.clock import Clock
from robot.files.ordinary_files import open_to_append

POLL_S = 0.01
# Deaths come in groups, and until the next spare is loaded one more lets the robot fall. Not at
# once: what takes over needs the processor first.
NEXT_SPARE_S = 0.5
# A worker pool of a numerical library would only steal time from the 500 Hz loop.
ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}


class Child:
    """One row of the table at work.

    It is tied to this process by `robot.bus.lifeline`: when this one dies in whatever way, so does
    it. Use it from one long-lived thread, because the kernel's tie is to the thread that started
    it.

    Attributes:
        row: of the table.
    """

    def __init__(self, row: Process, file: Path, *, log: Path | None, clock: Clock) -> None:
        """Start nothing yet.

        Args:
            row: of the table.
            file: given to the process as its argument, followed by this process's id.
            log: takes what it writes, and it leads a session of its own. None: it has the terminal
                of this process, its streams and its Ctrl-C.
            clock: wall clock.
        """
        self.row = row
        self._file = file
        self._log = log
        self._clock = clock
        self._starts_s: list[float] = []
        self._process: subprocess.Popen[bytes] | None = None
        self._spares: list[subprocess.Popen[bytes]] = []

    @property
    def pid(self) -> int | None:
        """Its process id; None before it was started."""
        return self._process.pid if self._process else None

    @property
    def status(self) -> int | None:
        """Its exit status, negative for a signal; None while it runs, and before."""
        return self._process.poll() if self._process else None

    @property
    def age_s(self) -> float:
        """How long ago it was started."""
        return self._clock.now_s() - self._starts_s[-1]

    @property
    def spares(self) -> int:
        """How many more are loaded, or about to be."""
        return len(self._spares)

    @property
    def may_start_again(self) -> bool:
        """Whether its row still allows that."""
        return self.row.may_start_again(self._starts_s, self._clock.now_s())

    def start(self) -> None:
        """Start it, or let its spare be the one. Raises OSError if it cannot be started."""
        ready = [spare for spare in self._spares if spare.poll() is None]
        self._process = ready.pop(0) if ready else self._spawn()
        self._spares = ready
        self._let_the_first_go_on()
        self._starts_s.append(self._clock.now_s())

    def prepare(self) -> None:
        """Have a spare loaded where the row wants one, if it is time and it may be needed."""
        after_s = self.row.spare_after_s
        if after_s is None:
            return
        self._let_the_first_go_on()
        if len(self._starts_s) > 1 and not self._spares:
            after_s = min(after_s, NEXT_SPARE_S)
        left = self.row.restarts_left(self._starts_s, self._clock.now_s())
        wanted = len(self._spares) < min(self.row.spares, left)
        if wanted and self.age_s > after_s * (1 + len(self._spares)):
            self._spares.append(self._spawn(behind=bool(self._spares)))

    def signal(self, number: signal.Signals) -> None:
        """Signal it, and what it started; one that is gone hears nothing."""
        if self._process is not None:
            self._send(self._process, number)

    def stop(self) -> None:
        """Ask it to stop; kill it if it does not in time. Nothing is left, the spare included."""
        for spare in reversed(self._spares):  # first, lest their turn comes
            self._send(spare, signal.SIGKILL)
            spare.wait()
            _end_input(spare)
        if self._process is None:
            return
        self._send(self._process, signal.SIGTERM)
        until_s = self._clock.now_s() + self.row.stop_s
        while self._process.poll() is None and self._clock.now_s() < until_s:
            self._clock.sleep_until(self._clock.now_s() + POLL_S)
        self._send(self._process, signal.SIGKILL)
        self._process.wait()

    def _let_the_first_go_on(self) -> None:
        """Of those that wait, one waits for the death alone: they take turns as they are listed."""
        first = next((spare for spare in self._spares if spare.poll() is None), None)
        if first is not None:
            _end_input(first)

    def _spawn(self, *, behind: bool = False) -> subprocess.Popen[bytes]:
        """Start one; `behind` another spare it waits until its standard input ends."""
        command = [sys.executable, "-P", "-m", self.row.module, str(self._file), str(os.getpid())]
        if self._log is None:
            number = str(len(self._starts_s))  # by which a spare knows its turn
            with _held_back(signal.SIGINT, signal.SIGTERM, signal.SIGTSTP):
                return subprocess.Popen([*command, number], env=_environment())
        with os.fdopen(open_to_append(self._log), "ab") as output:
            return subprocess.Popen(
                command,
                stdin=subprocess.PIPE if behind else subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                env=_environment(),
                start_new_session=True,
            )

    def _send(self, process: subprocess.Popen[bytes], number: signal.Signals) -> None:
        """To its whole session, so that nothing it started stays behind, if it has one."""
        if self._log is None:
            process.send_signal(number)
            return
        with suppress(ProcessLookupError):
            os.killpg(process.pid, number)


def _end_input(process: subprocess.Popen[bytes]) -> None:
    """Tell it by that that nobody is before it any more."""
    if process.stdin is not None:
        process.stdin.close()


def describe_exit(status: int) -> str:
    """An exit status in words."""
    if status >= 0:
        return f"ended with status {status}"
    try:
        return f"was killed by {signal.Signals(-status).name}"
    except ValueError:
        return f"was killed by signal {-status}"


@contextmanager
def _held_back(*numbers: signal.Signals) -> Generator[None]:
    """A child inherits them so, until it can hear: a wish to stop is not lost while it loads."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, numbers)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _environment() -> dict[str, str]:
    """This package, wherever it lies, and one thread."""
    root = str(Path(robot.__file__).parent.parent)
    paths = [root, *filter(None, [os.environ.get("PYTHONPATH")])]
    return {**os.environ, **ONE_THREAD, "PYTHONPATH": os.pathsep.join(paths)}
