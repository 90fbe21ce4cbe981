"""Emulated motors as a process: `-m sim.devices.main PARENT MAP FOLDER MOTION JOINT=FLAW...`.

MOTION is `still` or `swinging`.
"""

from __future__ import annotations

import sys
from pathlib import Path

from robot.bus.lifeline import Stop, tie_to_parent
from robot.clock import WallClock
from sim.devices import families

STOP_SEEN_EVERY_S = 0.1
STILL, SWINGING = "still", "swinging"
READY = "ready"
"""A file that says that all sockets are there."""


def main(parent_pid: str, file: str, folder: str, motion: str, *flaws: str) -> None:
    """Load, build, run, close."""
    tie_to_parent(int(parent_pid))
    clock, stop = WallClock(), Stop()
    wanted, family, emulated = families.loaded(Path(file))
    pairs = dict(flaw.split("=", 1) for flaw in flaws)
    built = emulated.build(wanted, now_s=clock.now_s(), flaws=pairs, is_still=motion == STILL)
    paths = [family.path(Path(folder), index) for index in range(len(wanted.channels))]
    with emulated.serve(paths, built, clock) as server:
        (Path(folder) / READY).touch()
        while not stop:
            server.serve(clock.now_s() + STOP_SEEN_EVERY_S)


if __name__ == "__main__":
    main(*sys.argv[1:])
