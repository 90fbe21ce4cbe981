"""`python -m benchmarks.can_buses`: joints on emulated CAN buses, commanded at a rate, live.

The motors and their wires are emulated by another process; the driver sends and hears through
python-can. Late: a reply that did not come within its period. CPU: of the driver alone, a cycle.
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
from robot.drivers.motors.can import joint_map
from robot.drivers.motors.can.driver import FAMILY, CanMotors
from robot.drivers.motors.can.joint_map import JointMap
from robot.drivers.motors.can.ports import PythonCan
from sim.devices.emulated import EmulatedMotors

JOINT = (
    "{{bus: bus{bus}, model: DM8009, id: {id}, lower_rad: -2, upper_rad: 2, "
    "velocity_limit_rad_s: 20, torque_limit_nm: 40}}"
)
SETTLE = 100


def map_text(buses: int, joints: int, rate_hz: int) -> str:
    """A joint map: so many buses, so many joints on each."""
    lines = [f"rate_hz: {rate_hz}", "buses:"]
    lines += [f"  bus{bus}: {{channel: can{bus}}}" for bus in range(buses)]
    lines.append("joints:")
    lines += [
        f"  joint{bus}_{number}: " + JOINT.format(bus=bus, id=number + 1)
        for bus in range(buses)
        for number in range(joints)
    ]
    return "\n".join(lines) + "\n"


def measure(joints: JointMap, cycles: int) -> dict[str, float]:
    """Command and read, cycle by cycle."""
    clock, n = WallClock(), len(joints.joints)
    with CanMotors(joints, clock, ports=lambda: PythonCan(joints.buses, clock)) as driver:
        zero = np.zeros(n)
        ticks: list[float] = []
        worst_ms = 0.0
        used_s = wrote_s = 0.0
        lost = late = 0
        for cycle in range(-SETTLE, cycles):
            if cycle == 0:
                lost, late = driver.reception.lost, driver.late
                used_s = wrote_s = worst_ms = 0.0
                ticks.clear()
            target = np.full(n, 0.3 * np.sin(0.01 * cycle))
            begin_s = time.thread_time()
            command = MotorCommand(clock.now_s(), target, zero, zero, zero + 20.0, zero + 1.0)
            driver.write(command)
            wrote_s += time.thread_time() - begin_s
            state = driver.read()
            used_s += time.thread_time() - begin_s
            worst_ms = max(worst_ms, 1000.0 * float(state.age_s.max()))
            ticks.append(state.stamp_s)
        jitter = np.abs(np.diff(ticks) - joints.period_s) * 1e6
        return {
            "late replies": (driver.reception.lost - lost) / (cycles * n),
            "late periods": driver.late - late,
            "oldest reply ms": worst_ms,
            "driver CPU ms a cycle": 1000.0 * used_s / cycles,
            "of it write ms": 1000.0 * wrote_s / cycles,
            "period jitter p50 us": float(np.percentile(jitter, 50)),
            "period jitter p99 us": float(np.percentile(jitter, 99)),
            "alarms": len(driver.alarms.on),
        }


def main(
    *,
    buses: Annotated[int, typer.Option(help="how many")] = 6,
    joints: Annotated[int, typer.Option(help="on each")] = 5,
    rate_hz: Annotated[int, typer.Option(help="of each joint")] = 500,
    seconds: Annotated[float, typer.Option(help="for so long")] = 20.0,
) -> None:
    """Measure."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "can.yaml"
        file.write_text(map_text(buses, joints, rate_hz))
        with EmulatedMotors(file, flaws={}) as emulated:
            found = FAMILY.elsewhere(joint_map.load(file), emulated.channels)
            print(
                f"{buses} buses, {joints} joints each, {rate_hz} Hz; load {found.load('bus0'):.0%}"
            )
            for name, value in measure(found, int(seconds * rate_hz)).items():
                print(f"  {name:24} {value:.4g}")


if __name__ == "__main__":
    typer.run(main)
