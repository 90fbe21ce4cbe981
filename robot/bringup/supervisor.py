"""Starts the processes of a robot, watches them, and leaves none behind."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Self

import robot
from robot.bringup.processes import PROCESSES, STOP_ORDER, Process
from robot.clock import Clock
from robot.closing import Closing
from robot.errors import Failure, ProcessError, failure

STOP_S = 3.0
SPARE_AFTER_S = 4.0
"""How long after a start a spare is loaded: it would compete for the processor."""
POLL_S = 0.01
LOG_TAIL_BYTES = 4096
# A worker pool of a numerical library would only steal time from the 500 Hz loop.
ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}


@dataclass
class _Child:
    """A process that runs or has run."""

    entry: Process
    popen: subprocess.Popen[bytes]
    log: Path
    starts_s: list[float] = field(default_factory=list[float])
    spare: subprocess.Popen[bytes] | None = None


class Supervisor(Closing):
    """A context manager over child processes.

    Every child leads its own session (Ctrl-C in the terminal reaches the parent only, which stops
    them in order), logs to a file, and is tied to this process by `robot.bus.lifeline`: when this
    one dies in whatever way, so do they. Use it from one long-lived thread, because the kernel's
    tie is to the thread that started them.

    Attributes:
        restarted: what was started again, in order, a sentence each.
    """

    def __init__(
        self,
        run_file: Path,
        *,
        logs: Path,
        clock: Clock,
        processes: tuple[Process, ...] = PROCESSES,
    ) -> None:
        """Start nothing yet.

        Args:
            run_file: given to every process as its argument, followed by this process's id.
            logs: folder for `NAME.log` and `NAME.pid`.
            clock: wall clock.
            processes: what to run.
        """
        self.restarted: list[str] = []
        self._run_file = run_file
        self._logs = logs
        self._clock = clock
        self._processes = processes
        self._children: dict[str, _Child] = {}
        self._failure: Failure | None = None

    def __enter__(self) -> Self:
        """Start every process. Raises ProcessError if one cannot be started."""
        self._logs.mkdir(parents=True, exist_ok=True)
        try:
            for entry in self._processes:
                self._start(entry)
        except OSError as error:
            self.close()
            raise ProcessError(f"a process did not start: {error}") from error
        return self

    def pid(self, name: str) -> int:
        """Process id of a child."""
        return self._children[name].popen.pid

    def knows(self, name: str) -> bool:
        """Whether there is a child of that name."""
        return name in self._children

    def check(self) -> Failure | None:
        """Look after the children; the first death that cannot be mended is what failed.

        The plant's death is told before that of what depends on it.
        """
        if self._failure is not None:
            return self._failure
        for child in list(self._children.values()):
            if child.popen.poll() is not None and not self._mended(child):
                self._failure = self._death(child)
                return self._failure
            self._prepare(self._children[child.entry.name])
        return None

    def close(self) -> None:
        """Ask every process to stop, in order; kill what does not within `STOP_S`. Idempotent."""
        order = {name: place for place, name in enumerate(STOP_ORDER)}
        for name in sorted(self._children, key=lambda one: order.get(one, -1)):
            child, spare = self._children[name].popen, self._children[name].spare
            if spare is not None:  # first, lest its turn comes
                self._signal(spare, signal.SIGKILL)
                spare.wait()
            self._signal(child, signal.SIGTERM)
            self._wait(child)
            self._signal(child, signal.SIGKILL)
            child.wait()
            (self._logs / f"{name}.pid").unlink(missing_ok=True)
        self._children.clear()

    def _start(self, entry: Process) -> None:
        """Start a process, or let its spare be the one; that has begun to work by itself."""
        log = self._logs / f"{entry.name}.log"
        known = self._children.get(entry.name)
        spare = known.spare if known else None
        ready = spare is not None and spare.poll() is None
        popen = spare if spare and ready else self._spawn(entry, log)
        with suppress(OSError):  # it is for people; a full disk keeps no robot from starting
            (self._logs / f"{entry.name}.pid").write_text(f"{popen.pid}\n")
        starts_s = known.starts_s if known else []
        self._children[entry.name] = _Child(entry, popen, log, [*starts_s, self._clock.now_s()])

    def _spawn(self, entry: Process, log: Path) -> subprocess.Popen[bytes]:
        with log.open("ab") as output:
            return subprocess.Popen(
                command(entry, self._run_file),
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                env=environment(),
                start_new_session=True,
            )

    def _prepare(self, child: _Child) -> None:
        """Have a spare ready where the table wants one and it may be needed."""
        entry, now_s = child.entry, self._clock.now_s()
        due = entry.spare and child.spare is None and now_s > child.starts_s[-1] + SPARE_AFTER_S
        if due and entry.may_start_again(child.starts_s, now_s):
            child.spare = self._spawn(entry, child.log)

    def _mended(self, child: _Child) -> bool:
        """Start it again if its table entry still allows that."""
        if not child.entry.may_start_again(child.starts_s, self._clock.now_s()):
            return False
        died = f"the {child.entry.name} {describe_exit(child.popen.returncode)}"
        self.restarted.append(f"{died}; started again")
        self._start(child.entry)
        return True

    def _death(self, child: _Child) -> Failure:
        name, code = child.entry.name, child.popen.returncode
        tail = last_line(child.log)
        cause = f"the {name} process {describe_exit(code)}"
        return failure(
            child.entry.death,
            f"{cause}: {tail}" if tail else cause,
            suggestion=f"see {child.log}, then start again",
            process=name,
            exit_status=float(code),
            alive_s=round(self._clock.now_s() - child.starts_s[-1], 3),
        )

    def _signal(self, child: subprocess.Popen[bytes], number: signal.Signals) -> None:
        """Signal a child's whole session, so that nothing it started stays behind either."""
        try:
            os.killpg(child.pid, number)
        except ProcessLookupError:
            return

    def _wait(self, child: subprocess.Popen[bytes]) -> None:
        until_s = self._clock.now_s() + STOP_S
        while child.poll() is None and self._clock.now_s() < until_s:
            self._clock.sleep_until(self._clock.now_s() + POLL_S)


def command(entry: Process, run_file: Path) -> list[str]:
    """How a process of the table is started by this one."""
    return [sys.executable, "-m", entry.module, str(run_file), str(os.getpid())]


def environment() -> dict[str, str]:
    """What a process of the table is started with: this package, wherever it lies."""
    root = str(Path(robot.__file__).parent.parent)
    paths = [root, *filter(None, [os.environ.get("PYTHONPATH")])]
    return {**os.environ, **ONE_THREAD, "PYTHONPATH": os.pathsep.join(paths)}


def describe_exit(code: int) -> str:
    """An exit status in words."""
    if code >= 0:
        return f"ended with status {code}"
    try:
        return f"was killed by {signal.Signals(-code).name}"
    except ValueError:
        return f"was killed by signal {-code}"


def last_line(log: Path) -> str:
    """The last line that a process said, for people."""
    try:
        with log.open("rb") as file:
            file.seek(max(0, log.stat().st_size - LOG_TAIL_BYTES))
            lines = file.read().decode(errors="replace").split("\n")
    except OSError:
        return ""
    return next((line.strip() for line in reversed(lines) if line.strip()), "")
