"""Following a path on the floor: pure pursuit for a body that can also step sideways.

See [Coulter1992], "Implementation of the pure pursuit path tracking algorithm", for the pursuit
of a point ahead on the path. What is added: the body turns on the spot when it looks far off the
path, and steps sideways back onto it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from robot.model.description import Walking
from robot.se3 import SE3, wrap_angle

LOOKAHEAD_M = 0.40
TURN_ON_THE_SPOT_RAD = 0.70
WALK_AGAIN_RAD = 0.25
TURN_GAIN_1_S = 1.8
CROSS_TRACK_GAIN_1_S = 0.8
SEARCH_M = 0.60
SLOW_NEAR_GOAL_1_S = 0.8
LEAST_SPEED_M_S = 0.10


class Twist(NamedTuple):
    """Velocity in the heading frame of the base."""

    forward_m_s: float
    left_m_s: float
    turn_rad_s: float


class Polyline:
    """A path on the floor by its points in W [m], measured along its length."""

    def __init__(self, points_m: Sequence[tuple[float, float]]) -> None:
        """Make it from at least one point; doubled points are dropped."""
        if not points_m:
            raise ValueError("a path needs at least one point")
        self.points_m = [points_m[0]]
        self.at_m = [0.0]
        for point in points_m[1:]:
            step_m = math.dist(point, self.points_m[-1])
            if step_m > 1e-6:
                self.points_m.append(point)
                self.at_m.append(self.at_m[-1] + step_m)

    @property
    def length_m(self) -> float:
        """Length of the whole path."""
        return self.at_m[-1]

    def point(self, along_m: float) -> tuple[float, float]:
        """The point at a distance along the path, its ends beyond them."""
        if along_m <= 0.0:
            return self.points_m[0]
        for i in range(1, len(self.at_m)):
            if along_m <= self.at_m[i]:
                (ax, ay), (bx, by) = self.points_m[i - 1], self.points_m[i]
                part = (along_m - self.at_m[i - 1]) / (self.at_m[i] - self.at_m[i - 1])
                return (ax + part * (bx - ax), ay + part * (by - ay))
        return self.points_m[-1]

    def nearest(
        self, x_m: float, y_m: float, *, from_m: float = 0.0, to_m: float = math.inf
    ) -> tuple[float, float]:
        """Distance along of the nearest point between two distances, and how far left of it we are.

        Where the path comes near itself the window keeps us on our branch.
        """
        best = (math.inf, min(from_m, self.length_m), 0.0)
        for i in range(1, len(self.at_m)):
            low_m, high_m = max(from_m, self.at_m[i - 1]), min(to_m, self.at_m[i])
            if low_m > high_m:
                continue
            (ax, ay), (bx, by) = self.points_m[i - 1], self.points_m[i]
            span_m = self.at_m[i] - self.at_m[i - 1]
            ux, uy = (bx - ax) / span_m, (by - ay) / span_m
            along_m = self.at_m[i - 1] + (x_m - ax) * ux + (y_m - ay) * uy
            along_m = min(max(along_m, low_m), high_m)
            px, py = self.point(along_m)
            left_m = ux * (y_m - ay) - uy * (x_m - ax)
            best = min(best, (math.hypot(x_m - px, y_m - py), along_m, left_m))
        return best[1], best[2]


class Follower:
    """Twists that lead the body along a path; remembers how far along it is."""

    def __init__(
        self, points_m: Sequence[tuple[float, float]], walking: Walking, *, speed_m_s: float
    ) -> None:
        """Follow a path at a cruising speed, within the limits of the gait."""
        self.path = Polyline(points_m)
        self.walking = walking
        self.speed_m_s = min(speed_m_s, walking.max_forward_m_s)
        self.along_m = 0.0
        self._turning = True

    @property
    def remaining_m(self) -> float:
        """Length of path still ahead."""
        return self.path.length_m - self.along_m

    def ahead(self, span_m: float, *, step_m: float = 0.1) -> list[tuple[float, float]]:
        """Points of the path over the next `span_m`."""
        count = int(min(span_m, self.remaining_m) / step_m)
        return [self.path.point(self.along_m + i * step_m) for i in range(count + 1)]

    def twist(self, X_WB: SE3) -> Twist:
        """The twist for where the body is now; moves on along the path."""
        x_m, y_m, _ = X_WB.p
        self.along_m, left_of_m = self.path.nearest(
            x_m, y_m, from_m=self.along_m, to_m=self.along_m + SEARCH_M
        )
        aim_x, aim_y = self.path.point(self.along_m + LOOKAHEAD_M)
        off_rad = wrap_angle(math.atan2(aim_y - y_m, aim_x - x_m) - X_WB.yaw_rad)
        if math.hypot(aim_x - x_m, aim_y - y_m) < 0.05:
            off_rad = 0.0
        self._turning = abs(off_rad) > (WALK_AGAIN_RAD if self._turning else TURN_ON_THE_SPOT_RAD)
        turn_rad_s = _clamp(TURN_GAIN_1_S * off_rad, self.walking.max_turn_rad_s)
        if self._turning:
            return Twist(0.0, 0.0, turn_rad_s)
        straight = 1.0 - 0.8 * min(1.0, abs(off_rad) / TURN_ON_THE_SPOT_RAD)
        forward_m_s = straight * min(
            self.speed_m_s, LEAST_SPEED_M_S + SLOW_NEAR_GOAL_1_S * self.remaining_m
        )
        left_m_s = _clamp(-CROSS_TRACK_GAIN_1_S * left_of_m, 0.5 * self.walking.max_sideways_m_s)
        return Twist(forward_m_s, left_m_s, turn_rad_s)


def turn_towards(yaw_error_rad: float, walking: Walking) -> Twist:
    """The twist that turns on the spot by an angle."""
    return Twist(0.0, 0.0, _clamp(TURN_GAIN_1_S * yaw_error_rad, walking.max_turn_rad_s))


def _clamp(value: float, limit: float) -> float:
    return min(max(value, -limit), limit)
