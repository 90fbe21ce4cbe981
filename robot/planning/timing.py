"""When to be where on a path of joint values: as fast as velocity and acceleration limits allow.

The path is a polyline with its corners rounded by parabolas. Along its length s, a forward and a
backward pass bound ds/dt [Bobrow1985 in its simplest form: the acceleration limit is split between
the path's curvature and the change of speed]; a moving average over time then bounds the jerk.
The samples are meant for a cubic spline at rest at both ends.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from robot.planning import numerics
from robot.se3 import Array

STEP_RAD = 0.02
SAMPLE_S = 0.05
SMOOTHING_S = 0.08
CURVE_SHARE, SPEED_SHARE = 0.55, 0.75
"""Parts of the acceleration limit for curvature and for changing speed (worst sum 1.3, rarely met
together; `time_path` slows down until the spline itself is inside the limits)."""


@dataclass(frozen=True, slots=True)
class Timed:
    """Times [s], shape (k,), the first 0, and positions, shape (k, n)."""

    times_s: Array
    positions_rad: Array

    def sampled(self, count: int, *, derivative: int = 0) -> Array:
        """The spline (or its derivative) at `count` even times, shape (count, n)."""
        at = numerics.even(0.0, float(self.times_s[-1]), count)
        return numerics.spline(self.times_s, self.positions_rad, at, derivative=derivative)


def rounded(corners: Array, cuts: Array) -> Array:
    """Points every `STEP_RAD` along a polyline whose corner i is cut off `cuts[i]` before it."""
    points: list[Array] = [corners[0]]
    for i in range(1, len(corners) - 1):
        before, corner, after = corners[i - 1 : i + 2]
        p, q = _towards(corner, before, cuts[i]), _towards(corner, after, cuts[i])
        count = max(4, int(2 * cuts[i] / STEP_RAD) + 1)
        t = np.linspace(0.0, 1.0, count)[:, None]
        points += list((1 - t) ** 2 * p + 2 * t * (1 - t) * corner + t**2 * q)
    points.append(corners[-1])
    return _even(np.array(points))


def time_path(path: Array, *, velocity: Array, acceleration: Array) -> Timed:
    """Times for a dense path, shape (k, n), within limits of shape (n,) [rad/s], [rad/s2]."""
    slower = 1.0
    timed = _sampled(path, velocity, acceleration)
    for _ in range(6):
        excess = _excess(timed, velocity, acceleration)
        if excess <= 1.0 + 1e-6:
            return timed
        slower = min(slower * 0.97, slower / excess)
        timed = _sampled(path, slower * velocity, slower**2 * acceleration)
    stretch = max(1.0, _excess(timed, velocity, acceleration))
    return Timed(stretch * timed.times_s, timed.positions_rad)


def _excess(timed: Timed, velocity: Array, acceleration: Array) -> float:
    """By how much slower it has to be to stay inside the limits; 1 or less if it is inside.

    The spline's acceleration is linear between its knots, so it is greatest at one of them.
    """
    knots = len(timed.times_s)
    speed = np.max(np.abs(timed.sampled(4 * knots, derivative=1)) / velocity)
    effort = np.max(np.abs(timed.sampled(knots, derivative=2)) / acceleration)
    return max(float(speed), float(np.sqrt(effort)))


def _sampled(path: Array, velocity: Array, acceleration: Array) -> Timed:
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    if length[-1] < 1e-9:
        return Timed(np.array([0.0, SAMPLE_S]), np.stack([path[0], path[-1]]))
    tangent = np.abs(np.gradient(path, length, axis=0))
    bend = np.abs(np.gradient(np.gradient(path, length, axis=0), length, axis=0))
    with np.errstate(divide="ignore"):
        cap = np.minimum(
            np.min(velocity / np.maximum(tangent, 1e-9), axis=1),
            np.sqrt(np.min(CURVE_SHARE * acceleration / np.maximum(bend, 1e-9), axis=1)),
        )
    push = np.min(SPEED_SHARE * acceleration / np.maximum(tangent, 1e-9), axis=1)
    rate = _passes(cap, push, np.diff(length))
    steps = 2.0 * np.diff(length) / np.maximum(rate[1:] + rate[:-1], 1e-6)
    times = np.concatenate([[0.0], np.cumsum(steps)])
    return _smoothed(path, length, times, rate)


def _passes(cap: Array, push: Array, step: Array) -> Array:
    """Greatest rate along the path, at rest at both ends."""
    rate = cap.tolist()
    push_list, step_list = push.tolist(), step.tolist()
    rate[0] = rate[-1] = 0.0
    last = len(rate) - 1
    for i in range(last):
        limit = (rate[i] ** 2 + 2.0 * min(push_list[i], push_list[i + 1]) * step_list[i]) ** 0.5
        rate[i + 1] = min(rate[i + 1], limit)
    for i in range(last, 0, -1):
        limit = (rate[i] ** 2 + 2.0 * min(push_list[i], push_list[i - 1]) * step_list[i - 1]) ** 0.5
        rate[i - 1] = min(rate[i - 1], limit)
    return np.array(rate)


def _smoothed(path: Array, length: Array, times: Array, rate: Array) -> Timed:
    """Sample the progress finely, average it over a window, and sample the path there."""
    fine = 0.01
    window = max(1, round(SMOOTHING_S / fine))
    total = times[-1] + fine * (window - 1)
    ticks = int(np.ceil(total / fine))
    clock = numerics.even(-(window - 1) * fine, ticks * fine, ticks + window)
    progress = _progress(clock, times, length, rate)
    progress = np.convolve(progress, np.full(window, 1.0 / window), mode="valid")
    clock = numerics.even(0.0, (len(progress) - 1) * fine, len(progress))
    end = int(np.argmax(progress >= length[-1] - 1e-9)) or len(progress) - 1
    count = max(3, int(np.ceil(clock[end] / SAMPLE_S)) + 1)
    at = numerics.even(0.0, float(clock[end]), count)
    s = np.interp(at, clock, progress)
    s[0], s[-1] = 0.0, length[-1]
    positions = np.stack([np.interp(s, length, path[:, j]) for j in range(path.shape[1])], axis=1)
    return Timed(at, positions)


def _progress(clock: Array, times: Array, length: Array, rate: Array) -> Array:
    """Length along the path at given times; the rate changes evenly within each step."""
    i = np.clip(np.searchsorted(times, clock, side="right") - 1, 0, len(times) - 2)
    span = np.maximum(times[i + 1] - times[i], 1e-12)
    t = np.clip(clock - times[i], 0.0, span)
    return length[i] + rate[i] * t + 0.5 * (rate[i + 1] - rate[i]) / span * t**2


def _towards(corner: Array, end: Array, distance: float) -> Array:
    """The point `distance` from a corner, at most half-way to `end`."""
    leg = end - corner
    return corner + leg * min(0.5, distance / max(float(np.linalg.norm(leg)), 1e-9))


def _even(points: Array) -> Array:
    """The same line with points every `STEP_RAD` at most, and no two together."""
    points = _apart(points)
    gaps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    length = np.concatenate([[0.0], np.cumsum(gaps)])
    count = max(5, int(np.ceil(length[-1] / STEP_RAD)) + 1)
    at = numerics.even(0.0, float(length[-1]), count)
    even = [np.interp(at, length, points[:, j]) for j in range(points.shape[1])]
    return _apart(np.stack(even, axis=1))  # a way there and back meets itself where it turns


def _apart(points: Array) -> Array:
    """The points without those that are where the one before is."""
    gaps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    return points[np.concatenate([[True], gaps > 1e-9])]
