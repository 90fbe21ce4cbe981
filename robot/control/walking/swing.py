"""The swing foot: a minimum-jerk quintic towards a landing that may move, replanned every tick."""

from __future__ import annotations

import math

import numpy as np

from robot.control.walking.footsteps import Sole
from robot.se3 import Array, wrap_angle

LATE_DESCENT_M_S = 0.10
FREEZE_S = 0.08
LANDING_FILTER_S = 0.04
LIFT_SHARE = 0.45
PRESS_M = 0.006  # the height profile ends below the floor, so that the foot meets it in time
LONGEST_LIFT_S = 0.6


class Swing:
    """Keeps the reference of one foot in the air: x, y, yaw by quintics, z by a fixed profile.

    Attributes:
        position, velocity, acceleration: of (x, y, yaw), each (3,).
        z, vz, az: height of the sole above the floor [m] and its derivatives.
        landing: where it is going to, filtered.
    """

    def __init__(self, start: Sole, landing: Sole, duration_s: float, height_m: float) -> None:
        """Start at rest on the floor at `start`."""
        self.position: Array = np.array([start.x, start.y, start.yaw])
        self.velocity: Array = np.zeros(3)
        self.acceleration: Array = np.zeros(3)
        self.duration_s = duration_s
        self.height_m = height_m
        self.time_s = 0.0
        self.z, self.vz, self.az = 0.0, 0.0, 0.0
        yaw = start.yaw + wrap_angle(landing.yaw - start.yaw)
        self.landing: Array = np.array([landing.x, landing.y, yaw])

    def aim(self, landing: Sole, dt_s: float) -> None:
        """Move the landing towards `landing` through a low pass; frozen shortly before the end."""
        if self.duration_s - self.time_s < FREEZE_S:
            return
        yaw = float(self.landing[2]) + wrap_angle(landing.yaw - float(self.landing[2]))
        gain = dt_s / (LANDING_FILTER_S + dt_s)
        self.landing += gain * (np.array([landing.x, landing.y, yaw]) - self.landing)

    def advance(self, dt_s: float) -> None:
        """Move the reference on by `dt_s`."""
        self.time_s += dt_s
        left_s = self.duration_s - self.time_s
        if left_s > 0.02:
            self._quintic(dt_s, left_s + dt_s)
        elif left_s > 0.0:
            self.position += (self.landing - self.position) * min(1.0, dt_s / (left_s + dt_s))
            self.velocity[:] = 0.0
            self.acceleration[:] = 0.0
        else:
            self.velocity[:] = 0.0
            self.acceleration[:] = 0.0
        self._height(dt_s)

    def _quintic(self, dt_s: float, left_s: float) -> None:
        """One tick along the minimum-jerk curve from here to rest at the landing."""
        p, v, a, T = self.position, self.velocity, self.acceleration, left_s
        d = self.landing - p
        c3 = (20 * d - 12 * v * T - 3 * a * T * T) / (2 * T**3)
        c4 = (-30 * d + 16 * v * T + 3 * a * T * T) / (2 * T**4)
        c5 = (12 * d - 6 * v * T - a * T * T) / (2 * T**5)
        t = dt_s
        self.position = p + v * t + 0.5 * a * t**2 + c3 * t**3 + c4 * t**4 + c5 * t**5
        self.velocity = v + a * t + 3 * c3 * t**2 + 4 * c4 * t**3 + 5 * c5 * t**4
        self.acceleration = a + 6 * c3 * t + 12 * c4 * t**2 + 20 * c5 * t**3

    def _height(self, dt_s: float) -> None:
        """Up to the apex, down to the floor, and on at a slow constant speed if it is late."""
        lift_s = min(LONGEST_LIFT_S, LIFT_SHARE * self.duration_s)
        drop_s = min(LONGEST_LIFT_S, (1.0 - LIFT_SHARE) * self.duration_s)
        drop_from_s = self.duration_s - drop_s
        if self.time_s < lift_s:
            self.z, self.vz, self.az = self._blend(self.time_s / lift_s, lift_s)
        elif self.time_s < drop_from_s:
            self.z, self.vz, self.az = self.height_m, 0.0, 0.0
        elif self.time_s < self.duration_s:
            z, vz, az = self._blend((self.time_s - drop_from_s) / drop_s, drop_s)
            scale = 1.0 + PRESS_M / self.height_m
            self.z, self.vz, self.az = self.height_m - scale * z, -scale * vz, -scale * az
        else:
            self.z -= LATE_DESCENT_M_S * dt_s
            self.vz, self.az = -LATE_DESCENT_M_S, 0.0

    def _blend(self, share: float, duration_s: float) -> tuple[float, float, float]:
        """Minimum-jerk 0 -> height."""
        s, h = share, self.height_m
        return (
            h * (10 * s**3 - 15 * s**4 + 6 * s**5),
            h * (30 * s**2 - 60 * s**3 + 30 * s**4) / duration_s,
            h * (60 * s - 180 * s**2 + 120 * s**3) / duration_s**2,
        )

    def sole(self) -> Sole:
        """Where the landing is aimed at now."""
        x, y, yaw = (float(value) for value in self.landing)
        return Sole(x, y, yaw)

    def distance_m(self) -> float:
        """Horizontal way still to go."""
        return math.hypot(*(self.landing[:2] - self.position[:2]))
