"""The motors of a joint map, emulated in a process of their own."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Self

from robot.bringup import private_folder
from robot.clock import WallClock
from robot.closing import Closing
from robot.errors import ProcessError
from sim.devices import families
from sim.devices.main import READY, STILL, SWINGING

STOPS_WITHIN_S = 3.0
POLL_S = 0.005
PROGRAM = "sim.devices.main"


class EmulatedMotors(Closing):
    """A child process with a socket for each bus, or a terminal for each port of servos.

    It ends when this is closed, or dies.

    Attributes:
        channels: paths of the sockets or terminals, by bus or port.
    """

    def __init__(self, file: Path, *, flaws: Mapping[str, str], is_still: bool = False) -> None:
        """Look at the map. Raises ConfigError as `bench.build`."""
        self._file, self._flaws, self._is_still = file, flaws, is_still
        wanted, family, emulated = families.loaded(file)
        emulated.build(wanted, flaws=flaws)
        self._lines, self._path = tuple(wanted.channels), family.path
        self._folder: private_folder.PrivateFolder | None = None
        self._child: subprocess.Popen[bytes] | None = None
        self.channels: Mapping[str, str] = {}

    def __enter__(self) -> Self:
        """Start it, and wait until its sockets are there. Raises ProcessError if it ends."""
        self._folder = private_folder.create()
        sockets = [self._path(self._folder.path, index) for index in range(len(self._lines))]
        self.channels = dict(zip(self._lines, map(str, sockets), strict=True))
        flaws = [f"{joint}={flaw}" for joint, flaw in self._flaws.items()]
        motion = STILL if self._is_still else SWINGING
        self._child = subprocess.Popen(
            [sys.executable, "-m", PROGRAM, str(os.getpid()), str(self._file),
             str(self._folder.path), motion, *flaws],
            stdin=subprocess.DEVNULL, start_new_session=True,
        )  # fmt: skip
        clock = WallClock()
        while not (self._folder.path / READY).exists():
            if self._child.poll() is not None:
                self.close()
                raise ProcessError("the emulated motors did not start; the lines above say why")
            clock.sleep_until(clock.now_s() + POLL_S)
        return self

    def close(self) -> None:
        """End it."""
        child, self._child = self._child, None
        if child is not None:
            child.terminate()
            try:
                child.wait(STOPS_WITHIN_S)
            except subprocess.TimeoutExpired:
                child.kill()
                child.wait()
        folder, self._folder = self._folder, None
        if folder is not None:
            private_folder.remove(folder)
