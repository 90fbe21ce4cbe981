"""Simulated walks recorded as a real robot's own senses would record them, flaws and all.

`record` walks the simulated robot and keeps the truth; `spoil` makes of that what imperfect sensors
say. The result has the fields of `robot.fusion.state_estimator.legged_log`.
"""

from __future__ import annotations

import math
from typing import Any

import msgspec
import numpy as np

from benchmarks.rig import Rig
from robot.control.loop import BUS_PERIOD_S
from robot.messages import Walk
from robot.se3 import SE3, Array

LOG_TICKS = 5
LOG_S = LOG_TICKS * BUS_PERIOD_S
ALONE, ALONE_S = 0.1, 0.45
"""Share of the weight below which a foot is in the air, and how long one usually is."""
REST_S = 3.0
COMMAND_S = 0.1
HOLD_S = 0.6
Fields = dict[str, Any]

WALKS: dict[str, tuple[tuple[float, float, float, float], ...]] = {
    "forward": ((20.0, 0.25, 0.0, 0.0),),
    "slow": ((30.0, 0.08, 0.0, 0.0),),
    "in place": ((20.0, 0.01, 0.0, 0.0),),
    "curve": ((20.0, 0.2, 0.0, 0.25),),
    "aside and back": ((10.0, 0.0, 0.1, 0.0), (10.0, -0.15, 0.0, 0.0)),
}
"""Name to (duration [s], forward [m/s], left [m/s], turn [rad/s]) one after another."""


class Flaws(msgspec.Struct, frozen=True, kw_only=True):
    """What is wrong with sensors and legs (1 sigma where a size is drawn; direction always is).

    `give_rad_per_nm`: how far a joint's encoder is from its link under torque. `twist_rad`: how far
    a foot turns on the floor, always the same way, while it stands alone.
    """

    gyro_bias_rad_s: float = math.radians(0.4)
    gyro_noise_rad_s: float = 0.004
    accel_bias_m_s2: float = 0.1
    accel_noise_m_s2: float = 0.06
    mounting_rad: float = math.radians(1.0)
    encoder_offset_rad: float = 0.005
    encoder_noise_rad: float = 0.0004
    give_rad_per_nm: float = 3e-4
    force_noise_n: float = 5.0
    force_bias_n: float = 6.0
    twist_rad: float = 0.0


def record(walk: str, *, seed: int = 0, friction: float = 0.8, softness_s: float = 0.02) -> Fields:
    """Walk, and keep the truth at 100 Hz.

    Args:
        walk: one of `WALKS`.
        seed: of everything random.
        friction: of soles on the floor; at 0.4 a foot slips now and then.
        softness_s: time constant of contact with the floor; 0.04 is a carpet's.
    """
    rig = Rig(seed=seed)
    model = rig.plant.model
    for geom in range(model.ngeom):
        body = int(model.geom_bodyid[geom])
        feet = [int(model.body(foot.body).id) for foot in rig.robot.feet.values()]
        if body in (0, *feet):
            model.geom_friction[geom, 0] = friction
            model.geom_solref[geom, 0] = softness_s
    rows: list[tuple[Any, ...]] = []
    plan = [(REST_S, 0.0, 0.0, 0.0), *WALKS[walk], (REST_S, 0.0, 0.0, 0.0)]
    clock_s = 0.0
    for duration_s, forward, left, turn in plan:
        clock_s += duration_s
        while rig.time_s < clock_s:
            if forward or left or turn:
                rig.send(Walk, forward_m_s=forward, left_m_s=left, turn_rad_s=turn, hold_s=HOLD_S)
            rows += _watch(rig, COMMAND_S)
    joints = [motor.joint for motor in rig.robot.motors.values()]
    names = ("t", "joint_pos", "torque", "imu_gyro", "imu_acc", "force", "p", "rpy")
    fields = dict(zip(names, (np.array(column) for column in zip(*rows, strict=True)), strict=True))
    return {**fields, "joint_names": np.array(joints), "fell": not rig.upright}


def _watch(rig: Rig, duration_s: float) -> list[tuple[Any, ...]]:
    rows: list[tuple[Any, ...]] = []
    plant, loop = rig.plant, rig.loop
    for _ in range(round(duration_s / (LOG_TICKS * BUS_PERIOD_S))):
        gyro, accel = np.zeros(3), np.zeros(3)
        for _ in range(LOG_TICKS):
            sample = plant.read()
            plant.write(loop.tick(sample))
            plant.step(round(BUS_PERIOD_S / 0.001))
            gyro += plant.data.sensor(rig.robot.sensors.imu.gyro).data / LOG_TICKS
            accel += plant.data.sensor(rig.robot.sensors.imu.accelerometer).data / LOG_TICKS
        X_WB = rig.X_WB
        rows.append((
            rig.time_s, plant.data.qpos[plant.motors.q_index].copy(),
            plant.data.actuator_force.copy(), gyro, accel, _forces(rig), X_WB.p, _rpy(X_WB),
        ))  # fmt: skip
    return rows


def _forces(rig: Rig) -> Array:
    return rig.plant.read().force.ankle_wrench[:, 2].copy()


def _rpy(X: SE3) -> tuple[float, float, float]:
    R = X.rotation()
    return (
        math.atan2(R[2, 1], R[2, 2]),
        math.atan2(-R[2, 0], math.hypot(R[0, 0], R[1, 0])),
        math.atan2(R[1, 0], R[0, 0]),
    )


def spoil(truth: Fields, flaws: Flaws, *, seed: int) -> Fields:
    """What imperfect sensors recorded of it."""
    rng = np.random.default_rng([seed, 77])
    n = len(truth["t"])
    mounting = _turned(rng, flaws.mounting_rad)
    gyro = truth["imu_gyro"] @ mounting.T + _direction(rng) * flaws.gyro_bias_rad_s
    accel = truth["imu_acc"] @ mounting.T + _direction(rng) * flaws.accel_bias_m_s2
    joints = truth["joint_pos"].shape[1]
    positions = truth["joint_pos"] + flaws.give_rad_per_nm * truth["torque"]
    positions = positions + flaws.encoder_offset_rad * rng.standard_normal(joints)
    positions = positions + flaws.encoder_noise_rad * rng.standard_normal((n, joints))
    _twist(positions, truth, flaws.twist_rad)
    force = truth["force"] + flaws.force_bias_n * rng.standard_normal(2)
    force = force + flaws.force_noise_n * rng.standard_normal((n, 2))
    return {
        "t": truth["t"] - truth["t"][0],
        "joint_names": truth["joint_names"],
        "joint_pos": positions,
        "imu_gyro": gyro + flaws.gyro_noise_rad_s * rng.standard_normal((n, 3)),
        "imu_acc": accel + flaws.accel_noise_m_s2 * rng.standard_normal((n, 3)),
        "l_foot_fz": force[:, 0],
        "r_foot_fz": force[:, 1],
        "gt_base_pos": truth["p"],
        "gt_base_rpy": truth["rpy"],
    }


def _twist(positions: Array, truth: Fields, twist_rad: float) -> None:
    """Let each foot that stands alone turn on the floor, which its hip's yaw seems to say."""
    share = truth["force"] / np.median(truth["force"].sum(axis=1))
    names = [str(name) for name in truth["joint_names"]]
    for side, name in enumerate(("left_hip_yaw", "right_hip_yaw")):
        column, twisted = names.index(name), 0.0
        for k in range(len(positions)):
            alone = share[k, 1 - side] < ALONE
            twisted += twist_rad * LOG_S / ALONE_S if alone else 0.0
            if share[k, side] < ALONE:
                twisted *= 1.0 - LOG_S / 0.05
            positions[k, column] += twisted


def _direction(rng: np.random.Generator) -> Array:
    """A random unit vector, shape (3,)."""
    vector = rng.standard_normal(3)
    return vector / np.linalg.norm(vector)


def _turned(rng: np.random.Generator, angle_rad: float) -> Array:
    x, y, z = (math.sin(0.5 * angle_rad) * _direction(rng)).tolist()
    return SE3((0.0, 0.0, 0.0), (math.cos(0.5 * angle_rad), x, y, z)).rotation()
