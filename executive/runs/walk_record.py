"""What a walk without a task leaves in a folder, so that it is looked at, recorded and filmed."""

from __future__ import annotations

import time
from pathlib import Path

import msgspec

from executive.blackboard import BODY, GOAL, NOW, WORLD, Blackboard
from executive.engine.loop import Wakeable
from executive.engine.motion_watch import MotionWatch
from executive.engine.sensed_watch import SensedWatch
from executive.journal import motion, sensed
from executive.journal.files import BackgroundFile, LineFile
from executive.journal.journal import Journal
from executive.runs import run_folder
from executive.runs.runtimes import Opened, Setup
from executive.runs.velocity_walk import Walked
from robot import shots
from robot.closing import Closing

MOST_WAITING = 1200
"""Of lines for a disk that takes none: a minute."""


class WalkRecord(Closing):
    """A context manager; `look` after every tick."""

    def __init__(self, setup: Setup, robot: Opened, folder: Path, *, text: str) -> None:
        """Write what it was started with."""
        runtime = robot.runtime
        live = isinstance(runtime, Wakeable)
        kind = BackgroundFile if live else LineFile
        self._clock, self._link = runtime.clock, runtime.link
        self._journal = Journal(folder, wall_s=time.time, background=live)
        self._lines = [
            kind(folder / name, capacity=MOST_WAITING)
            for name in (motion.FILE, sensed.FILE, shots.DEPTH_FILE)
        ]
        board = Blackboard()
        self._sense = board.claim("sense")
        board.claim("task").set(GOAL, text)
        self._mover = MotionWatch(board, self._link, self._lines[0])
        self._watcher = SensedWatch(
            board, self._link, setup.where.description,
            lines=self._lines[1], depths=self._lines[2],
        )  # fmt: skip
        header = run_folder.header(setup, text=text)
        run_folder.save(folder, "run.json", header)
        self._journal.write(self._clock.now_s(), "run", **msgspec.to_builtins(header))

    def look(self) -> None:
        """Write what is new."""
        now_s = self._clock.now_s()
        self._sense.set(NOW, now_s)
        self._sense.set(BODY, self._link.body())
        self._sense.set(WORLD, self._link.world())
        self._mover.update(now_s)
        self._watcher.update(now_s)

    def end(self, walked: Walked) -> None:
        """Write how it ended."""
        reason = walked.failure
        told = {"code": "done"} if reason is None else msgspec.to_builtins(reason)
        self._journal.write(
            self._clock.now_s(), "outcome", **told, took_s=walked.walked_s, recoveries=0
        )

    def close(self) -> None:
        """Close the files."""
        for lines in self._lines:
            lines.close()
        self._journal.close()
