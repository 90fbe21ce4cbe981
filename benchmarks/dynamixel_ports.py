"""`python -m benchmarks.dynamixel_ports`: servos on emulated serial ports, commanded at a rate.

Servos and lines are emulated by another process, behind pseudo terminals, and bytes take the time
that they do at the bit rate. Missed: an answer that did not come within its period. CPU: of the
driver alone, a cycle. With `--simulated`, all in one process and simulated time: no computer is too
slow then, and what is missed is the driver's own doing.
"""

from __future__ import annotations

import tempfile
import time
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from robot.clock import Clock, SimulatedClock, WallClock
from robot.drivers.motor_bus import MotorCommand
from robot.drivers.motors.dynamixel import joint_map
from robot.drivers.motors.dynamixel.driver import FAMILY, DynamixelMotors
from robot.drivers.motors.dynamixel.joint_map import ServoMap
from robot.drivers.motors.dynamixel.ports import SerialPorts
from sim.devices.emulated import EmulatedMotors
from sim.devices.servo_bench import DirectPorts, build

JOINT = (
    "{{port: port{port}, model: XM430-W350, id: {id}, lower_rad: -2, upper_rad: 2, "
    "velocity_limit_rad_s: 4, torque_limit_nm: 3}}"
)
SETTLE = 100


def map_text(ports: int, joints: int, *, rate_hz: int, baud_hz: int) -> str:
    """A servo map: so many ports, so many joints on each."""
    lines = [f"rate_hz: {rate_hz}", "watchdog_s: 0.1", "ports:"]
    lines += [f"  port{port}: {{device: tty{port}, baud_hz: {baud_hz}}}" for port in range(ports)]
    lines.append("joints:")
    lines += [
        f"  joint{port}_{number}: " + JOINT.format(port=port, id=number + 1)
        for port in range(ports)
        for number in range(joints)
    ]
    return "\n".join(lines) + "\n"


def measure(driver: DynamixelMotors, clock: Clock, cycles: int) -> dict[str, float]:
    """Command and read, cycle by cycle."""
    n = len(driver.joints.joints)
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
            driver.write(MotorCommand(clock.now_s(), target, zero, zero, zero + 8.0, zero + 0.5))
            wrote_s += time.thread_time() - begin_s
            driver.read()
            used_s += time.thread_time() - begin_s
        return {
            "missed answers": (driver.reception.lost - lost) / (cycles * n),
            "late periods": driver.late - late,
            "CPU ms a cycle": 1000.0 * used_s / cycles,
            "of it write ms": 1000.0 * wrote_s / cycles,
            "alarms": len(driver.alarms.on),
        }


def simulated(joints: ServoMap, cycles: int) -> dict[str, float]:
    """In simulated time; CPU is that of the emulation too."""
    clock = SimulatedClock(1.0)
    bench = build(joints, now_s=1.0)
    driver = DynamixelMotors(joints, clock, ports=lambda: DirectPorts(bench, clock))
    found = measure(driver, clock, cycles)
    span_s = clock.now_s() - 1.0
    found["busiest wire"] = max(line.busy_s for line in bench.lines.values()) / span_s
    return found


def main(
    *,
    ports: Annotated[int, typer.Option(help="how many")] = 1,
    joints: Annotated[int, typer.Option(help="on each")] = 20,
    rate_hz: Annotated[int, typer.Option(help="of each joint")] = 200,
    baud_hz: Annotated[int, typer.Option(help="of a port")] = 2_000_000,
    seconds: Annotated[float, typer.Option(help="for so long")] = 20.0,
    is_simulated: Annotated[bool, typer.Option("--simulated", help="no wall clock")] = False,
) -> None:
    """Measure."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "dynamixel.yaml"
        file.write_text(map_text(ports, joints, rate_hz=rate_hz, baud_hz=baud_hz))
        found = joint_map.load(file)
        print(f"{ports} ports, {joints} servos each, {rate_hz} Hz; load {found.load('port0'):.0%}")
        cycles = int(seconds * rate_hz)
        if is_simulated:
            told = simulated(found, cycles)
        else:
            with EmulatedMotors(file, flaws={}) as emulated:
                moved = FAMILY.elsewhere(found, emulated.channels)
                clock = WallClock()
                driver = DynamixelMotors(moved, clock, ports=lambda: SerialPorts(moved.ports))
                told = measure(driver, clock, cycles)
        for name, value in told.items():
            print(f"  {name:18} {value:.4g}")


if __name__ == "__main__":
    typer.run(main)
