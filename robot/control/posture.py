"""Whether the robot stands, falls or lies: by the estimated base, and by the joints."""

from __future__ import annotations

import math

import numpy as np

from robot.failures import Failure, failure
from robot.fusion.base_state import BaseStateEstimator
from robot.kinematics.dynamics import Dynamics
from robot.se3 import Array

STEADY_RAD_S = 1.0


class Posture:
    """How the trunk is now; looks at the estimate and at the newest kinematics when it is asked."""

    def __init__(self, estimator: BaseStateEstimator, dynamics: Dynamics) -> None:
        """Look at these two."""
        self._estimator = estimator
        self._dynamics = dynamics
        body = dynamics.body
        self._base = body.base_body
        self._limits = body.description.balance.falling
        self._low_m = self._limits.low * body.description.walking.base_height_m

    @property
    def tilt_rad(self) -> float:
        """Angle between the base's z axis and the vertical."""
        _, x, y, _ = self._estimator.quat_wxyz
        return math.acos(max(-1.0, min(1.0, 1.0 - 2.0 * (x * x + y * y))))

    @property
    def side(self) -> str:
        """Onto which side the trunk falls or lies."""
        return towards(self._estimator.X_NB().rotation()[2])

    @property
    def upright(self) -> bool:
        """Whether it is on its feet."""
        return self.tilt_rad < self._limits.upright_rad and self._height_m > self._low_m

    @property
    def lies(self) -> bool:
        """Whether damped legs have let the body down; by the joints, wherever it is."""
        base = float(self._dynamics.data.xpos[self._base, 2])
        lower = min(float(sole[2]) for sole in self._dynamics.sole_position)
        return base - lower < self._low_m or self.tilt_rad > self._limits.upright_rad

    @property
    def _height_m(self) -> float:
        return float(self._estimator.p[2])

    def falling(self, *, rising: bool) -> str:
        """Why it cannot be held up any more, empty while it can; who rises may be low."""
        tilt_rad, height_m = self.tilt_rad, self._height_m
        if tilt_rad <= self._limits.tilt_rad and (rising or height_m >= self._low_m):
            return ""
        return (
            f"the robot falls {self.side}: the trunk leans "
            f"{math.degrees(tilt_rad):.0f} degrees, {height_m:.2f} m above the floor"
        )

    def fallen(self, why: str) -> Failure:
        """The failure of a robot that is down."""
        return failure(
            "fallen", why, tilt_rad=self.tilt_rad, height_m=self._height_m, side=self.side
        )


def steady(gyro_rad_s: Array) -> bool:
    """Whether a trunk turns slowly: it does not on its way down, where gravity cannot be felt."""
    return float(np.abs(gyro_rad_s).max()) <= STEADY_RAD_S


def towards(up_B: Array) -> str:
    """Onto which side a trunk falls or lies; `up_B` is the world's up in the base's axes, (3,)."""
    x, y, _ = (float(value) for value in up_B)
    if abs(x) > abs(y):
        return "on its back" if x > 0.0 else "on its front"
    return "on its left side" if y < 0.0 else "on its right side"
