"""Starts the processes of a robot, watches them, and leaves none behind."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path
from typing import Self

from robot.bringup.child import Child, describe_exit
from robot.bringup.processes import PROCESSES, STOP_ORDER, Process
from robot.clock import Clock
from robot.closing import Closing
from robot.errors import ProcessError
from robot.failures import Failure, failure
from robot.files.ordinary_files import make_below, open_ordinary, write_ordinary

LOG_TAIL_BYTES = 4096


class Supervisor(Closing):
    """A context manager over child processes, used from one long-lived thread (see `Child`).

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
        simulated: bool = True,
        pictures: bool = False,
        owned: bool = False,
    ) -> None:
        """Start nothing yet.

        Args:
            run_file: given to every process as its argument.
            logs: folder for `NAME.log` and `NAME.pid`.
            clock: wall clock.
            processes: the table.
            simulated: whether reality is; without, the rows for simulation are left out.
            pictures: whether somebody looks through the robot's camera; without, its row is.
            owned: whether a process of its own commands the motors; without, its row is.
        """
        self.restarted: list[str] = []
        self._logs = logs
        self._clock = clock
        self._children = {
            row.name: Child(row, run_file, log=self._log(row.name), clock=clock)
            for row in processes
            if row.needed(simulated=simulated, pictures=pictures, owned=owned)
        }
        self._failure: Failure | None = None

    def __enter__(self) -> Self:
        """Start every process. Raises ProcessError if one cannot be started."""
        try:
            make_below(self._logs.parent, self._logs)
            for child in self._children.values():
                self._start(child)
        except OSError as error:
            self.close()
            raise ProcessError(f"a process did not start: {error}") from error
        return self

    @property
    def pids(self) -> dict[str, int]:
        """Process ids of the children by name, of those that were started."""
        pids = {name: child.pid for name, child in self._children.items()}
        return {name: pid for name, pid in pids.items() if pid is not None}

    def pid(self, name: str) -> int:
        """Process id of a child. Raises KeyError if it was not started."""
        return self.pids[name]

    def check(self) -> Failure | None:
        """Look after the children; the first death that cannot be mended is what failed.

        The plant's death is told before that of what depends on it.
        """
        if self._failure is not None:
            return self._failure
        for child in self._children.values():
            if (status := child.status) is not None and not self._mended(child, status):
                if not child.row.is_vital:
                    continue
                self._failure = self._death(child, status)
                return self._failure
            child.prepare()
        return None

    def close(self) -> None:
        """Stop every process, in order. Idempotent."""
        order = {name: place for place, name in enumerate(STOP_ORDER)}
        for name in sorted(self.pids, key=lambda one: order.get(one, -1)):
            self._children[name].stop()
            (self._logs / f"{name}.pid").unlink(missing_ok=True)
        self._children.clear()

    def _start(self, child: Child) -> None:
        child.start()
        with suppress(OSError):  # it is for people; a full disk keeps no robot from starting
            write_ordinary(self._logs / f"{child.row.name}.pid", f"{child.pid}\n".encode())

    def _mended(self, child: Child, status: int) -> bool:
        """Start it again if its row still allows that."""
        if not child.may_start_again:
            return False
        died = f"the {child.row.name} {describe_exit(status)}"
        self.restarted.append(f"{died}; started again")
        self._start(child)
        return True

    def _death(self, child: Child, status: int) -> Failure:
        name = child.row.name
        tail = last_line(self._log(name))
        cause = f"the {name} process {describe_exit(status)}"
        return failure(
            child.row.death,
            f"{cause}: {tail}" if tail else cause,
            suggestion=f"see {self._log(name)}, then start again" if tail else UNSAID,
            process=name,
            exit_status=float(status),
            alive_s=round(child.age_s, 3),
        )

    def _log(self, name: str) -> Path:
        return self._logs / f"{name}.log"


UNSAID = (
    "it said nothing before that: if nobody killed it, see `dmesg` for memory, then start again"
)
"""What to do about a process whose log is empty, which is no use to look into."""


def last_line(log: Path) -> str:
    """The last line that a process said, for people."""
    try:
        with open_ordinary(log) as file:
            file.seek(max(0, os.fstat(file.fileno()).st_size - LOG_TAIL_BYTES))
            lines = file.read().decode(errors="replace").split("\n")
    except OSError:
        return ""
    return next((line.strip() for line in reversed(lines) if line.strip()), "")
