"""`--ros2`: the bridge beside a robot that is up, as a process of its own.

It reads the robot's own bus and gives orders through the robot's socket, as another terminal does;
so it can be slow, be stopped or die. One that dies is started again, a few times.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import threading
from collections.abc import Callable, Generator
from contextlib import contextmanager, suppress
from pathlib import Path

import msgspec

import robot
from executive.frontends.service.ros2_plan import Plan
from robot.closing import Closing
from robot.errors import ConfigError, Problem
from robot.files.ordinary_files import make_below, open_to_append

MODULE = "executive.frontends.ros2.main"
LOG = "ros2.log"
MOST_STARTS, AGAIN_S = 5, 2.0
END_S = 3.0
_ROUTER = re.compile(r"tcp/(\[[0-9a-fA-F:.]{2,45}\]|[A-Za-z0-9._-]{1,253}):([0-9]{1,5})")


def check(router: str, *, fast: bool) -> None:
    """Refuse what cannot be bridged, before anything moves.

    Raises:
        ConfigError: time is simulated, or that is no endpoint of a router.
    """
    if fast:
        cure = "leave out --fast, or --ros2"
        raise ConfigError([Problem("--ros2 is for a robot that keeps time", suggestion=cure)])
    found = _ROUTER.fullmatch(router)
    if found is None or not 0 < int(found[2]) < 1 << 16:
        cure = "tcp/HOST:PORT, as tcp/192.168.1.7:7447"
        problem = Problem(f"--ros2-router {router!r} is no endpoint of a router", suggestion=cure)
        raise ConfigError([problem])


@contextmanager
def bridged(plan: Plan | None, *, logs: Path, out: Callable[[str], None]) -> Generator[None]:
    """Bridge to ROS 2 inside the block, and say so; or just go on, where there is no plan.

    Args:
        plan: what the process is told.
        logs: folder of the run, into whose `logs` its output goes.
        out: says a line to people.
    """
    if plan is None:
        yield
        return
    with _Bridge(plan, logs, out):
        where = f"by {plan.router}, ROS_DOMAIN_ID {plan.domain}"
        spaced = f", below {plan.namespace}" if plan.namespace else ""
        out(f"ROS 2 machines can see and command it {where}{spaced}.")
        yield


class _Bridge(Closing):
    """One process at a time, looked after by a thread."""

    def __init__(self, plan: Plan, folder: Path, out: Callable[[str], None]) -> None:
        self._plan = plan
        self._folder = folder
        self._out = out
        self._closing = threading.Event()
        self._lock = threading.Lock()
        self._process: subprocess.Popen[bytes] | None = None
        # its starting thread must outlive it: it dies with that (`tie_to_parent`)
        self._thread = threading.Thread(target=self._look_after, name="ros2", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """End it."""
        self._closing.set()
        with self._lock:
            process = self._process
        if process is not None:
            process.terminate()
            try:
                process.wait(END_S)
            except subprocess.TimeoutExpired:
                process.kill()
        self._thread.join(END_S)

    def _look_after(self) -> None:
        for start in range(1, MOST_STARTS + 1):
            ended = self._run_once()
            if self._closing.is_set():
                return
            again = "it is started again" if start < MOST_STARTS else "it is not started again"
            self._out(f"The bridge to ROS 2 has ended ({ended}): {again}; see logs/{LOG}.")
            if self._closing.wait(AGAIN_S):
                return

    def _run_once(self) -> str:
        """Run it until it ends; returns how it did."""
        try:
            with self._lock:
                if self._closing.is_set():
                    return ""
                process = self._process = self._started()
            if process.stdin is not None:
                with suppress(OSError), process.stdin as told:
                    told.write(msgspec.json.encode(self._plan))
            return f"status {process.wait()}"
        except OSError as error:
            return error.strerror or str(error)

    def _started(self) -> subprocess.Popen[bytes]:
        logs = self._folder / "logs"
        make_below(self._folder, logs)
        log = open_to_append(logs / LOG)
        try:
            return subprocess.Popen(
                [sys.executable, "-P", "-m", MODULE, str(os.getpid())],
                stdin=subprocess.PIPE,
                stdout=log,
                stderr=log,
                process_group=0,  # Ctrl-C is for the robot
                env={**os.environ, "PYTHONPATH": str(Path(robot.__file__).parent.parent)},
            )
        finally:
            os.close(log)
