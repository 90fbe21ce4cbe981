"""`python -m benchmarks.ethernet_boards`: motors behind Ethernet on emulated boards, at a rate.

The boards are emulated by another process, on UDP sockets of this machine. Late: a reply that did
not come within its period. CPU: of the driver alone, a cycle.
"""

from __future__ import annotations

import tempfile
import time
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from robot.clock import WallClock
from robot.drivers.motor_bus import MotorCommand
from robot.drivers.motors.ethernet import joint_map
from robot.drivers.motors.ethernet.driver import FAMILY, EthernetMotors
from robot.drivers.motors.ethernet.ports import UdpPorts
from sim.devices.emulated import EmulatedMotors

JOINT = (
    "{{board: board{board}, model: LIMB-40, id: {id}, lower_rad: -2, upper_rad: 2, "
    "velocity_limit_rad_s: 20, torque_limit_nm: 40}}"
)
SETTLE = 200


def map_text(boards: int, joints: int, *, rate_hz: int) -> str:
    """A map: so many boards, so many joints on each."""
    lines = [f"rate_hz: {rate_hz}", "watchdog_s: 0.1", "boards:"]
    lines += [f"  board{b}: {{address: 10.0.7.{b + 1}, number: {b + 1}}}" for b in range(boards)]
    lines.append("joints:")
    lines += [
        f"  joint{board}_{number}: " + JOINT.format(board=board, id=number)
        for board in range(boards)
        for number in range(joints)
    ]
    return "\n".join(lines) + "\n"


def measure(driver: EthernetMotors, cycles: int) -> dict[str, float]:
    """Command and read, cycle by cycle."""
    n, clock = len(driver.joints.joints), WallClock()
    with driver:
        zero = np.zeros(n)
        used_s = wrote_s = 0.0
        lost = late = 0
        for cycle in range(-SETTLE, cycles):
            if cycle == 0:
                lost, late = driver.reception.lost, driver.late
                used_s = wrote_s = 0.0
            target = np.full(n, 0.3 * np.sin(0.01 * cycle))
            begin_s = time.thread_time()
            driver.write(MotorCommand(clock.now_s(), target, zero, zero, zero + 20.0, zero + 1.0))
            wrote_s += time.thread_time() - begin_s
            driver.read()
            used_s += time.thread_time() - begin_s
        return {
            "late replies": (driver.reception.lost - lost) / (cycles * n),
            "late periods": driver.late - late,
            "CPU ms a cycle": 1000.0 * used_s / cycles,
            "of it write ms": 1000.0 * wrote_s / cycles,
            "alarms": len(driver.alarms.on),
        }


def main(
    *,
    boards: Annotated[int, typer.Option(help="how many")] = 5,
    joints: Annotated[int, typer.Option(help="on each")] = 6,
    rate_hz: Annotated[int, typer.Option(help="of each joint")] = 500,
    seconds: Annotated[float, typer.Option(help="for so long")] = 20.0,
) -> None:
    """Measure."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "ethernet.yaml"
        file.write_text(map_text(boards, joints, rate_hz=rate_hz))
        found = joint_map.load(file)
        print(f"{boards} boards, {joints} joints each, {rate_hz} Hz; {found.load('board0'):.1%}")
        with EmulatedMotors(file, flaws={}) as emulated:
            there = FAMILY.elsewhere(found, emulated.channels)
            driver = EthernetMotors(there, WallClock(), ports=lambda: UdpPorts(there.boards))
            for name, value in measure(driver, int(seconds * rate_hz)).items():
                print(f"  {name:18} {value:.4g}")


if __name__ == "__main__":
    typer.run(main)
