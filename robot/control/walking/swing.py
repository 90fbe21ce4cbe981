"""The swing foot: a minimum-jerk quintic towards a landing that may move, replanned every tick."""

from __future__ import annotations

from robot.control.walking.footsteps import Sole
from robot.se3 import wrap_angle

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
        self.position = [start.x, start.y, start.yaw]
        self.velocity = [0.0, 0.0, 0.0]
        self.acceleration = [0.0, 0.0, 0.0]
        self.duration_s = duration_s
        self.height_m = height_m
        self.time_s = 0.0
        self.z, self.vz, self.az = 0.0, 0.0, 0.0
        yaw = start.yaw + wrap_angle(landing.yaw - start.yaw)
        self.landing = [landing.x, landing.y, yaw]

    def aim(self, landing: Sole, dt_s: float) -> None:
        """Move the landing towards `landing` through a low pass; frozen shortly before the end."""
        if self.duration_s - self.time_s < FREEZE_S:
            return
        yaw = self.landing[2] + wrap_angle(landing.yaw - self.landing[2])
        gain = dt_s / (LANDING_FILTER_S + dt_s)
        for k, value in enumerate((landing.x, landing.y, yaw)):
            self.landing[k] += gain * (value - self.landing[k])

    def advance(self, dt_s: float) -> None:
        """Move the reference on by `dt_s`."""
        self.time_s += dt_s
        left_s = self.duration_s - self.time_s
        if left_s > 0.02:
            self._quintic(dt_s, left_s + dt_s)
        elif left_s > 0.0:
            share = min(1.0, dt_s / (left_s + dt_s))
            for k in range(3):
                self.position[k] += share * (self.landing[k] - self.position[k])
            self._rest()
        else:
            self._rest()
        self._height(dt_s)

    def _rest(self) -> None:
        self.velocity = [0.0, 0.0, 0.0]
        self.acceleration = [0.0, 0.0, 0.0]

    def _quintic(self, dt_s: float, left_s: float) -> None:
        """One tick along the minimum-jerk curve from here to rest at the landing."""
        t, T = dt_s, left_s
        for k in range(3):
            p, v, a = self.position[k], self.velocity[k], self.acceleration[k]
            d = self.landing[k] - p
            c3 = (20 * d - 12 * v * T - 3 * a * T * T) / (2 * T**3)
            c4 = (-30 * d + 16 * v * T + 3 * a * T * T) / (2 * T**4)
            c5 = (12 * d - 6 * v * T - a * T * T) / (2 * T**5)
            self.position[k] = p + t * (v + t * (0.5 * a + t * (c3 + t * (c4 + t * c5))))
            self.velocity[k] = v + t * (a + t * (3 * c3 + t * (4 * c4 + t * 5 * c5)))
            self.acceleration[k] = a + t * (6 * c3 + t * (12 * c4 + t * 20 * c5))

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
