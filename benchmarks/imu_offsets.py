"""`python -m benchmarks.imu_offsets`: walking with a gyro that is off, by size and direction.

The accelerometer is off by 0.03 m/s², the IMU askew by a degree, both drawn from the seed. What the
controller believes is held against the simulator's truth.
"""

from __future__ import annotations

import math
from typing import Annotated

import numpy as np
import typer

from benchmarks.markdown import table
from benchmarks.rig import Rig
from robot.messages import Walk
from robot.reality.faults import OffsetImu
from robot.se3 import wrap_angle
from sim.faults import apply

DIRECTIONS = {
    "forward": (1.0, 0.0, 0.0), "left": (0.0, 1.0, 0.0), "up": (0.0, 0.0, 1.0),
    "back": (-1.0, 0.0, 0.0), "right": (0.0, -1.0, 0.0), "down": (0.0, 0.0, -1.0),
    "forward left up": (0.577, 0.577, 0.577), "back left down": (-0.577, 0.577, -0.577),
}  # fmt: skip
SIZES_DEG_S = (0.2, 0.5, 1.0)
ACCEL_M_S2, ASKEW_DEG = 0.03, 1.0
SPEED_M_S, REST_S, LOOK_S = 0.4, 1.0, 0.25
HEAD = ["gyro off by", "walked", "tilt: RMS, max deg", "heading deg", "position m", "found deg/s"]


def walk(size_deg_s: float, direction: str, *, duration_s: float, seed: int) -> list[str]:
    """One walk, as a row of the table."""
    rng, rig = np.random.default_rng([seed, 12]), Rig(seed=seed)
    gyro = size_deg_s * np.array(DIRECTIONS[direction])
    x, y, z = (ACCEL_M_S2 * _direction(rng)).tolist()
    roll, pitch, yaw = (ASKEW_DEG * _direction(rng)).tolist()
    fault = OffsetImu(
        gyro_deg_s=(float(gyro[0]), float(gyro[1]), float(gyro[2])),
        accel_m_s2=(x, y, z),
        askew_deg=(roll, pitch, yaw),
    )
    apply(rig.plant, fault)
    up, begin_s, tilts = rig.run(REST_S), rig.time_s + 0.0, list[float]()
    while up and rig.time_s < begin_s + duration_s:
        rig.send(Walk, forward_m_s=SPEED_M_S, hold_s=1.0)
        up = rig.run(LOOK_S)
        believed = rig.X_WN @ rig.loop.state().X_NB
        across = np.cross(rig.X_WB.rotation()[2], believed.rotation()[2])
        tilts.append(math.degrees(math.asin(min(1.0, float(np.linalg.norm(across))))))
    believed, state = rig.X_WN @ rig.loop.state().X_NB, rig.loop.state()
    off_deg = abs(math.degrees(wrap_angle(believed.yaw_rad - rig.X_WB.yaw_rad)))
    found = "-"
    if state.imu is not None:
        found = ", ".join(f"{math.degrees(rate):.2f}" for rate in state.imu.gyro_rad_s)
    return [
        f"{size_deg_s:g} deg/s {direction}",
        f"{rig.time_s - begin_s:.1f} s" if up else f"fell at {rig.time_s - begin_s:.1f} s",
        f"{math.sqrt(float(np.mean(np.square(tilts)))):.2f}, {max(tilts):.2f}",
        f"{off_deg:.2f}",
        f"{math.dist(believed.p[:2], rig.X_WB.p[:2]):.2f}",
        found,
    ]


def main(
    *,
    duration_s: Annotated[float, typer.Option("--for", help="seconds of each walk")] = 60.0,
    seed: Annotated[int, typer.Option(help="of noise, and of what else is off")] = 1,
) -> None:
    """Measure, and print a table."""
    rows = [
        walk(size, direction, duration_s=duration_s, seed=seed)
        for size in SIZES_DEG_S
        for direction in DIRECTIONS
    ]
    print(table(HEAD, rows))


def _direction(rng: np.random.Generator) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    vector = rng.standard_normal(3)
    return vector / np.linalg.norm(vector)


if __name__ == "__main__":
    typer.run(main)
