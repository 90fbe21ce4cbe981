"""The swing foot: a minimum-jerk quintic towards a landing that may move, replanned every tick."""

from __future__ import annotations

import math

from robot.control.walking import stumble
from robot.control.walking.footsteps import Sole
from robot.model.gait import Walking
from robot.se3 import wrap_angle

FREEZE_S = 0.08  # before the end: a landing moved later only shakes the foot, until it falls
LANDING_FILTER_S = 0.04  # for the same reason
LEAST_M_S = 0.1  # slower, a foot that is behind is not held by anything


class Swing:
    """Keeps the reference of one foot in the air: x, y, yaw by quintics, z by a fixed profile.

    Attributes:
        position, velocity, acceleration: of (x, y, yaw), each (3,).
        z, vz, az: height of the sole above the floor [m] and its derivatives.
        landing: where it is going to, filtered.
        urgent: whether it is to catch the body: better a little early than late.
        raises: how often it was lifted over what held it.
        blocked: whether something holds it, before which it comes down.
    """

    def __init__(self, start: Sole, landing: Sole, duration_s: float, walking: Walking) -> None:
        """Start at rest on the floor at `start`."""
        self.position = [start.x, start.y, start.yaw]
        self.velocity = [0.0, 0.0, 0.0]
        self.acceleration = [0.0, 0.0, 0.0]
        self.duration_s = duration_s
        self.height_m = walking.step_height_m
        self.profile = walking.swing_foot
        self.time_s = 0.0
        self.urgent = False
        self.raises, self.blocked = 0, False
        self.z, self.vz, self.az = 0.0, 0.0, 0.0
        yaw = start.yaw + wrap_angle(landing.yaw - start.yaw)
        self.landing = [landing.x, landing.y, yaw]

    def aim(self, landing: Sole, dt_s: float) -> None:
        """Move the landing towards `landing` through a low pass; frozen shortly before the end."""
        if self.duration_s - self.time_s < FREEZE_S or self.blocked:
            return
        yaw = self.landing[2] + wrap_angle(landing.yaw - self.landing[2])
        gain = dt_s / (LANDING_FILTER_S + dt_s)
        for k, value in enumerate((landing.x, landing.y, yaw)):
            self.landing[k] += gain * (value - self.landing[k])

    def heed(self, foot: Sole) -> None:
        """Look at where the foot is; one that something holds goes back, and over it."""
        vx, vy, _ = self.velocity
        speed = math.hypot(vx, vy)
        if self.blocked or speed < LEAST_M_S:
            return
        ux, uy = vx / speed, vy / speed
        if ux * (self.position[0] - foot.x) + uy * (self.position[1] - foot.y) < stumble.BEHIND_M:
            return
        over = self.time_s < stumble.OVER_SHARE * self.duration_s
        self.blocked = not over or self.raises == stumble.MOST_RAISES
        back_m = stumble.BACK_M
        self.position[:2] = foot.x - back_m * ux, foot.y - back_m * uy
        self._rest()
        if self.blocked:
            self.landing[:2] = self.position[:2]
        else:
            self.raises += 1
            self.height_m += stumble.RAISE_M

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
        for k in range(3):
            self.position[k], self.velocity[k], self.acceleration[k] = minimum_jerk(
                self.position[k],
                self.velocity[k],
                self.acceleration[k],
                goal=self.landing[k],
                left_s=left_s,
                dt_s=dt_s,
            )

    def _height(self, dt_s: float) -> None:
        """Up to the apex, down to the floor, and on at a slow constant speed if it is late.

        A step that lands before its time falls short: the foot is still on its way.
        """
        foot = self.profile
        lift_s = min(foot.longest_s, foot.rising * self.duration_s)
        drop_s = min(foot.longest_s, (1.0 - foot.rising) * self.duration_s)
        before_s = self.time_s - dt_s
        goal, rate = self.height_m, 0.0
        if before_s < lift_s - dt_s:
            left_s = lift_s - before_s
        elif before_s < self.duration_s - drop_s - dt_s:
            left_s = 0.1
        elif before_s < self.duration_s - dt_s:
            left_s = self.duration_s - before_s
            goal, rate = (-foot.press_m, 0.0) if self.urgent else (-foot.touch_m, -foot.touch_m_s)
        else:
            self.z -= foot.touch_m_s * dt_s
            self.vz, self.az = -foot.touch_m_s, 0.0
            return
        self.z, self.vz, self.az = minimum_jerk(
            self.z, self.vz, self.az, goal=goal, left_s=left_s, dt_s=dt_s, rate=rate
        )


def minimum_jerk(
    p: float, v: float, a: float, *, goal: float, left_s: float, dt_s: float, rate: float = 0.0
) -> tuple[float, float, float]:
    """State after `dt_s` on the quintic from (p, v, a) to `goal` in `left_s`, there at `rate`.

    Replanned every tick it stays smooth however goal and time change (Flash & Hogan, 1985).
    """
    t, T = dt_s, left_s
    p, v = p + rate * T, v - rate  # seen from what moves at `rate` and is at the goal in the end
    d = goal - p
    c3 = (20 * d - 12 * v * T - 3 * a * T * T) / (2 * T**3)
    c4 = (-30 * d + 16 * v * T + 3 * a * T * T) / (2 * T**4)
    c5 = (12 * d - 6 * v * T - a * T * T) / (2 * T**5)
    return (
        p + t * (v + t * (0.5 * a + t * (c3 + t * (c4 + t * c5)))) + rate * (t - T),
        v + rate + t * (a + t * (3 * c3 + t * (4 * c4 + t * 5 * c5))),
        a + t * (6 * c3 + t * (12 * c4 + t * 20 * c5)),
    )
