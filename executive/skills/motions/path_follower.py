"""Following a planned base path: where to go next, as a twist.

The velocity is along the path a little ahead of the nearest point, plus a pull back onto it; as the
body can step sideways and backwards, it need not look that way. Meanwhile it turns to the heading
that the path has further ahead, and goes the slower the more there is to turn.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from typing import NamedTuple

from robot.model.gait import Walking
from robot.planning.requests import Stance
from robot.se3 import SE3, wrap_angle

SEARCH_M = 0.60
SAME_PLACE_M = 0.02
METRES_PER_RADIAN = 0.3


class Velocity(NamedTuple):
    """Velocity in the heading frame of the base."""

    forward_m_s: float
    left_m_s: float
    turn_rad_s: float


class Stretch:
    """A polyline walked without turning on the spot, measured along its length."""

    def __init__(self, stances: Sequence[Stance], speeds_m_s: Sequence[float]) -> None:
        """Make it from at least two stances at different places, with the speed to each but one."""
        self.stances, self._speeds_m_s = list(stances), list(speeds_m_s)
        self.at_m = [0.0]
        for a, b in itertools.pairwise(stances):
            self.at_m.append(self.at_m[-1] + math.dist(a[:2], b[:2]))

    @property
    def length_m(self) -> float:
        """Length of the whole run."""
        return self.at_m[-1]

    @property
    def top_m_s(self) -> float:
        """The greatest of its cruising speeds."""
        return max(self._speeds_m_s)

    def stance(self, along_m: float) -> Stance:
        """The stance at a distance along the run, its ends beyond them."""
        if along_m <= 0.0:
            return self.stances[0]
        for i in range(1, len(self.at_m)):
            if along_m <= self.at_m[i]:
                (ax, ay, a_yaw), (bx, by, b_yaw) = self.stances[i - 1], self.stances[i]
                part = (along_m - self.at_m[i - 1]) / (self.at_m[i] - self.at_m[i - 1])
                yaw_rad = a_yaw + part * wrap_angle(b_yaw - a_yaw)
                return (ax + part * (bx - ax), ay + part * (by - ay), wrap_angle(yaw_rad))
        return self.stances[-1]

    def speed_m_s(self, from_m: float, to_m: float) -> float:
        """The least of the cruising speeds between two distances along."""
        spans = zip(self.at_m, self.at_m[1:], self._speeds_m_s, strict=False)
        passed = [v for begin_m, end_m, v in spans if end_m > from_m and begin_m < to_m]
        return min(passed, default=self._speeds_m_s[-1])

    def nearest_m(self, x_m: float, y_m: float, *, from_m: float, to_m: float) -> float:
        """Distance along of the nearest point between two distances.

        Where the path comes near itself the window keeps us on our branch.
        """
        best = (math.inf, min(from_m, self.length_m))
        for i in range(1, len(self.at_m)):
            low_m, high_m = max(from_m, self.at_m[i - 1]), min(to_m, self.at_m[i])
            if low_m > high_m:
                continue
            (ax, ay, _), (bx, by, _) = self.stances[i - 1], self.stances[i]
            span_m = self.at_m[i] - self.at_m[i - 1]
            along_m = ((x_m - ax) * (bx - ax) + (y_m - ay) * (by - ay)) / span_m
            along_m = min(max(self.at_m[i - 1] + along_m, low_m), high_m)
            px, py, _ = self.stance(along_m)
            best = min(best, (math.hypot(x_m - px, y_m - py), along_m))
        return best[1]


class Turn(NamedTuple):
    """A turn on the spot to a heading, from another."""

    from_rad: float
    to_rad: float


class Follower:
    """Velocities that lead the body along a path; remembers how far along it is."""

    def __init__(
        self,
        start: Stance,
        waypoints: Sequence[Stance],
        *,
        walking: Walking,
        speeds_m_s: Sequence[float],
    ) -> None:
        """Follow waypoints, to each at its cruising speed, within the limits of the gait."""
        self.walking = walking
        self._legs = _legs(start, waypoints, speeds_m_s)
        self._along_m = 0.0
        self._turned_rad = 0.0
        self._turning = False
        self.total_m = max(self.remaining_m, 1e-9)

    @property
    def remaining_m(self) -> float:
        """What is still to be walked; a turn counts `METRES_PER_RADIAN`."""
        left_m = sum(_cost_m(leg) for leg in self._legs) - self._along_m
        return left_m - METRES_PER_RADIAN * self._turned_rad

    @property
    def way_left_m(self) -> float:
        """What is still to be walked, turns left out."""
        return sum(leg.length_m for leg in self._legs if isinstance(leg, Stretch)) - self._along_m

    @property
    def done(self) -> bool:
        """Nothing is left: the last leg's end is near."""
        return not self._legs

    def ahead(self, span_m: float, *, step_m: float = 0.1) -> list[tuple[float, float]]:
        """Points of the path over the next `span_m`, beyond turns too."""
        points: list[tuple[float, float]] = []
        along_m = self._along_m
        for leg in self._legs:
            while isinstance(leg, Stretch) and along_m < leg.length_m and span_m > 0.0:
                points.append(leg.stance(along_m)[:2])
                along_m += step_m
                span_m -= step_m
            along_m = 0.0
        return points

    def twist(self, X_WS: SE3) -> Velocity:
        """The twist for where the body is now; moves on along the path."""
        x_m, y_m, _ = X_WS.p
        self._advance(x_m, y_m, X_WS.yaw_rad)
        if not self._legs:
            return Velocity(0.0, 0.0, 0.0)
        leg = self._legs[0]
        if isinstance(leg, Turn):
            return turn_towards(wrap_angle(leg.to_rad - X_WS.yaw_rad), self.walking)
        does = self.walking.following
        off_rad = wrap_angle(leg.stance(self._along_m + does.turn_ahead_m)[2] - X_WS.yaw_rad)
        self._turning = abs(off_rad) > (
            does.turn_done_rad if self._turning else does.turn_first_rad
        )
        if self._turning:
            return turn_towards(off_rad, self.walking)
        left_over_m = leg.length_m - self._along_m
        bend = leg.stance(self._along_m + does.bend_ahead_m)
        bend_rad = abs(wrap_angle(bend[2] - X_WS.yaw_rad))
        cruise_m_s = leg.speed_m_s(self._along_m, self._along_m + does.slow_ahead_m)
        speed_m_s = min(
            cruise_m_s,
            does.least_m_s + does.slow_down_1_s * left_over_m,
            self._in_bends_m_s(leg, max(bend_rad, abs(off_rad))),
        )
        vx, vy = self._velocity(leg, x_m, y_m, speed_m_s)
        c, s = math.cos(X_WS.yaw_rad), math.sin(X_WS.yaw_rad)
        return self._within_limits(c * vx + s * vy, c * vy - s * vx, off_rad)

    def _in_bends_m_s(self, leg: Stretch, bend_rad: float) -> float:
        """Most speed for what there is to turn; who is slow for want of room is slow enough.

        Slowed down for both a walk went through a doorway around the corner at 0.18 m/s.
        """
        return leg.top_m_s / (1.0 + self.walking.following.slow_in_bends_1_rad * bend_rad)

    def _velocity(
        self, leg: Stretch, x_m: float, y_m: float, speed_m_s: float
    ) -> tuple[float, float]:
        """Velocity in W: along the run, and back onto it [m/s]."""
        does = self.walking.following
        here_x, here_y, _ = leg.stance(self._along_m)
        ahead_x, ahead_y = self._ahead(leg)
        ahead_m = max(math.hypot(ahead_x, ahead_y), 1e-9)
        pull_x, pull_y = here_x - x_m, here_y - y_m
        pull_m_s = does.pull_1_s * math.hypot(pull_x, pull_y)
        pull = does.pull_1_s * min(1.0, does.pull_m_s / max(pull_m_s, 1e-9))
        along = speed_m_s / ahead_m
        return along * ahead_x + pull * pull_x, along * ahead_y + pull * pull_y

    def _ahead(self, leg: Stretch) -> tuple[float, float]:
        """From here to a little further along; further still where that is back here.

        A way begins behind a body that went on while it was planned, and doubles back there.
        """
        ahead_m = self.walking.following.ahead_m
        from_x, from_y, _ = leg.stance(min(self._along_m, leg.length_m - ahead_m))
        for span_m in (ahead_m, 2.0 * ahead_m):
            to_x, to_y, _ = leg.stance(self._along_m + span_m)
            if math.hypot(to_x - from_x, to_y - from_y) > 0.5 * ahead_m:
                break
        return to_x - from_x, to_y - from_y

    def _advance(self, x_m: float, y_m: float, yaw_rad: float) -> None:
        """Drop the legs that are done."""
        does = self.walking.following
        while self._legs:
            leg = self._legs[0]
            if isinstance(leg, Turn):
                whole_rad = abs(wrap_angle(leg.to_rad - leg.from_rad))
                left_rad = abs(wrap_angle(leg.to_rad - yaw_rad))
                self._turned_rad = max(self._turned_rad, whole_rad - left_rad)
                if left_rad > does.turn_done_rad:
                    return
            else:
                self._along_m = leg.nearest_m(
                    x_m, y_m, from_m=self._along_m, to_m=self._along_m + SEARCH_M
                )
                if leg.length_m - self._along_m > does.done_m:
                    return
            self._legs.pop(0)
            self._along_m = self._turned_rad = 0.0

    def _within_limits(self, forward_m_s: float, left_m_s: float, off_rad: float) -> Velocity:
        """Scale a velocity, keeping its direction, until the gait can do it."""
        gait = self.walking
        most_m_s = gait.max_forward_m_s if forward_m_s > 0.0 else gait.max_backward_m_s
        aside_m_s = gait.following.aside * gait.max_sideways_m_s
        scale = max(1.0, abs(forward_m_s) / most_m_s, abs(left_m_s) / aside_m_s)
        turn_rad_s = _clamp(gait.following.turn_1_s * off_rad, gait.max_turn_rad_s)
        return Velocity(forward_m_s / scale, left_m_s / scale, turn_rad_s)


def turn_towards(yaw_error_rad: float, walking: Walking) -> Velocity:
    """The twist that turns on the spot by an angle."""
    turn_rad_s = walking.following.turn_1_s * yaw_error_rad
    return Velocity(0.0, 0.0, _clamp(turn_rad_s, walking.max_turn_rad_s))


def _legs(
    start: Stance, waypoints: Sequence[Stance], speeds_m_s: Sequence[float]
) -> list[Stretch | Turn]:
    """Group stances into runs, split where the body turns on the spot."""
    legs: list[Stretch | Turn] = []
    run, speeds = [start], list[float]()
    for stance, speed_m_s in zip(waypoints, speeds_m_s, strict=True):
        if math.dist(stance[:2], run[-1][:2]) > SAME_PLACE_M:
            run.append(stance)
            speeds.append(speed_m_s)
            continue
        if len(run) > 1:
            legs.append(Stretch(run, speeds))
        if abs(wrap_angle(stance[2] - run[-1][2])) > 1e-3:
            legs.append(Turn(run[-1][2], stance[2]))
        run, speeds = [stance], []
    if len(run) > 1:
        legs.append(Stretch(run, speeds))
    return legs


def _cost_m(leg: Stretch | Turn) -> float:
    if isinstance(leg, Stretch):
        return leg.length_m
    return METRES_PER_RADIAN * abs(wrap_angle(leg.to_rad - leg.from_rad))


def _clamp(value: float, limit: float) -> float:
    return min(max(value, -limit), limit)
