"""Whether the robot stands so that its controlled sit can begin, by what it feels alone."""

from __future__ import annotations

import math

import numpy as np

from robot.drivers.body_sample import BodySample
from robot.model.body import BodyModel
from robot.owner.sit import Squat
from robot.physics import GRAVITY_M_S2

NEAR_RAD = 0.35
"""Legs that are further from every posture of the squat do not squat from here."""
BEARS_SHARE = 0.2
"""Of the weight, on each foot: else it is in a step."""
TILT_RAD, TURNS_RAD_S = 0.35, 1.5
"""By which the base leans, at which it turns, at most. Sitting down, the IMU feels 0.1 and 0.4."""
CARRIED_SHARE = 0.5
"""Of the weight, on both feet together: else it hangs, or lies."""
QUIET_RAD_S = 0.5
"""Of its legs: at rest they turn with 0.1 at most; in a walk one of their joints is faster."""


def stands(sample: BodySample, body: BodyModel, squat: Squat) -> bool:
    """Whether both feet bear it, it is upright and quiet, and its legs are near the squat."""
    bearing_n = sample.force.ankle_wrench[:, 2]
    if float(bearing_n.min()) < BEARS_SHARE * GRAVITY_M_S2 * body.mass_kg:
        return False
    return _is_upright(sample) and squat.place(sample.motors.q)[1] < NEAR_RAD


def is_on_its_feet(sample: BodySample, body: BodyModel) -> bool:
    """Whether it is upright and one foot or both bear it, as in a step."""
    bearing_n = sample.force.ankle_wrench[:, 2].clip(min=0.0)
    weight_n = GRAVITY_M_S2 * body.mass_kg
    return float(bearing_n.sum()) > CARRIED_SHARE * weight_n and _is_upright(sample)


def is_quiet(sample: BodySample, squat: Squat) -> bool:
    """Whether its legs are at rest."""
    return float(np.abs(sample.motors.qd[squat.legs]).max()) < QUIET_RAD_S


def _is_upright(sample: BodySample) -> bool:
    accel, gyro = sample.imu.accel_m_s2, sample.imu.gyro_rad_s
    if float(accel[2]) < math.cos(TILT_RAD) * float(np.linalg.norm(accel)):
        return False
    return float(np.abs(gyro).max()) <= TURNS_RAD_S
