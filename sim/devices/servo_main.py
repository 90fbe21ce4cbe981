"""Emulated servos as a process: `-m sim.devices.servo_main PARENT MAP FOLDER MOTION JOINT=FLAW...`.

MOTION is `still` or `swinging`.
"""

from __future__ import annotations

import sys
from pathlib import Path

from robot.bus.lifeline import Stop, tie_to_parent
from robot.clock import WallClock
from robot.drivers.motors.dynamixel import joint_map
from robot.drivers.motors.dynamixel.emulated import terminal_path
from sim.devices import servo_bench
from sim.devices.main import READY, STILL, STOP_SEEN_EVERY_S
from sim.devices.serial_server import SerialServer


def main(parent_pid: str, file: str, folder: str, motion: str, *flaws: str) -> None:
    """Load, build, run, close."""
    tie_to_parent(int(parent_pid))
    clock, stop = WallClock(), Stop()
    wanted = joint_map.load(file)
    pairs = dict(flaw.split("=", 1) for flaw in flaws)
    built = servo_bench.build(wanted, now_s=clock.now_s(), flaws=pairs, is_still=motion == STILL)
    paths = [terminal_path(Path(folder), index) for index in range(len(wanted.ports))]
    with SerialServer(list(zip(paths, built.lines.values(), strict=True)), clock) as server:
        (Path(folder) / READY).touch()
        while not stop:
            server.serve(clock.now_s() + STOP_SEEN_EVERY_S)


if __name__ == "__main__":
    main(*sys.argv[1:])
