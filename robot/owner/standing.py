"""Whether the robot stands so that its controlled sit can begin, by what it feels alone."""

from __future__ import annotations

import math
from collections import deque

import numpy as np

from robot.drivers.body_sample import BodySample
from robot.model.body import BodyModel
from robot.owner.sit import Squat
from robot.physics import GRAVITY_M_S2
from robot.se3 import Array

NEAR_RAD = 0.35
"""Legs that are further from every posture of the squat do not squat from here."""
BEARS_SHARE = 0.2
"""Of the weight, on each foot: else it is in a step."""
TILT_RAD, TURNS_RAD_S = 0.35, 1.5
"""By which the base leans, at which it turns, at most. Sitting down, the IMU feels 0.1 and 0.4."""
CARRIED_SHARE = 0.5
"""Of the weight, on both feet together: else it hangs, or lies."""
EVEN_SHARE = 0.38
"""Of what both feet bear, on each, where nothing is about to move: the weight goes to one foot
before anything is seen to."""
REST_S, LOOKS_S, MOVED_RAD = 0.4, 0.05, 0.01
"""Legs at rest have moved by less than this since any look in so long: before the first step of a
walk the weight goes from side to side, slower than the speeds of a robot at rest are noisy."""


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


def is_even(sample: BodySample) -> bool:
    """Whether both feet bear about as much."""
    bearing_n = sample.force.ankle_wrench[:, 2]
    return float(bearing_n.min()) > EVEN_SHARE * float(bearing_n.sum())


def _is_upright(sample: BodySample) -> bool:
    accel, gyro = sample.imu.accel_m_s2, sample.imu.gyro_rad_s
    if float(accel[2]) < math.cos(TILT_RAD) * float(np.linalg.norm(accel)):
        return False
    return float(np.abs(gyro).max()) <= TURNS_RAD_S


class Rest:
    """Whether legs are at rest, by where they were a moment ago."""

    def __init__(self) -> None:
        """Nothing was seen yet: they are."""
        self._seen: deque[tuple[float, Array]] = deque()

    def look(self, now_s: float, legs_rad: Array) -> bool:
        """Whether they are, by all that was seen in `REST_S`; legs_rad: of their motors."""
        seen = self._seen
        while seen and now_s - seen[0][0] > REST_S:
            seen.popleft()
        if not seen or now_s - seen[-1][0] >= LOOKS_S:
            seen.append((now_s, legs_rad.copy()))
        return all(float(np.abs(legs_rad - before).max()) < MOVED_RAD for _, before in seen)
