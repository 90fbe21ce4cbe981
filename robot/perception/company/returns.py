"""Clusters of a planar scan that the map does not explain and that may be somebody's legs or trunk.

At the height of a hip and with 2 degrees from beam to beam a leg has one return at 4 m: its shape
tells nothing, unlike in scans that are fine (`robot.perception.people`). That the map does not know
it does.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from robot.messages import LidarScan
from robot.perception.company.mapped import MappedSolids
from robot.se3 import SE3, Array

FARTHEST_M = 6.0
GAP_M = 0.26
"""Between the returns of one: both legs of a stride are one person."""
WIDEST_M = 0.85
WITHIN_M = 0.08
"""From the mean of the returns to the middle of somebody."""
TRUNK_M = 0.17
"""Between the middle of somebody and what they stand beside, at the least."""
LOW_M, HIGH_M = 0.15, 1.6
NOISE_M, NOISE_SHARE = 0.05, 0.012
"""1 sigma of a middle: of the stride, and of the beams' distance from one another."""


class Returns(NamedTuple):
    """A cluster of strange returns.

    Attributes:
        p_W: its middle [m], shape (2,).
        sigma_m: 1 sigma of that.
        beams: how many.
        width_m: between the outermost of them.
        range_m: from the lidar.
        is_free: whether there is room for somebody's trunk between it and what the map knows.
    """

    p_W: Array
    sigma_m: float
    beams: int
    width_m: float
    range_m: float
    is_free: bool


class Sweep(NamedTuple):
    """A scan in the world: where the beams that came back ended.

    Attributes:
        stamp_s: of the scan.
        eye_W: the lidar on the floor [m], shape (2,).
        bearings_rad: of the beams in W, -pi to pi, rising, shape (n,).
        ranges_m: across the floor, shape (n,).
        clusters: of what is strange.
    """

    stamp_s: float
    eye_W: Array
    bearings_rad: Array
    ranges_m: Array
    clusters: tuple[Returns, ...]
    empty_rad: Array
    """Bearings of the beams that did not come back, shape (m,): nothing there, or the robot."""


def sweep(scan: LidarScan, X_WL: SE3, solids: MappedSolids) -> Sweep:
    """Take one scan of a lidar at X_WL."""
    ranges_m: Array = np.array(scan.ranges_m)
    numbers = np.arange(len(ranges_m), dtype=np.float64)
    angles: Array = scan.angle_min_rad + scan.angle_step_rad * numbers
    there = np.isfinite(ranges_m)
    missing: Array = X_WL.yaw_rad + angles[~there]
    ranges_m, angles = ranges_m[there], angles[there]
    beams_L = ranges_m[:, None] * np.stack(
        [np.cos(angles), np.sin(angles), np.zeros(len(angles))], axis=1
    )
    points = beams_L @ X_WL.rotation().T + np.array(X_WL.p)
    eye = np.array(X_WL.p[:2])
    off = points[:, :2] - eye
    bearings = np.arctan2(off[:, 1], off[:, 0])
    order = np.argsort(bearings)
    points, bearings, off = points[order], bearings[order], off[order]
    flat_m = np.hypot(off[:, 0], off[:, 1])
    keep = (flat_m < FARTHEST_M) & (points[:, 2] > LOW_M) & (points[:, 2] < HIGH_M)
    keep[keep] = solids.strange(points[keep], flat_m[keep])
    clusters = _clusters(points[keep], eye, abs(scan.angle_step_rad), solids)
    return Sweep(scan.stamp_s, eye, bearings, flat_m, clusters, missing)


def _clusters(
    points_W: Array, eye: Array, step_rad: float, solids: MappedSolids
) -> tuple[Returns, ...]:
    """Runs of strange returns around the lidar; the last may go on in the first."""
    if not len(points_W):
        return ()
    points, z_m = points_W[:, :2], float(points_W[:, 2].mean())
    ranges_m = np.linalg.norm(points - eye, axis=1)
    gaps_m = np.linalg.norm(np.diff(points, axis=0, append=points[:1]), axis=1)
    nearer_m = np.minimum(ranges_m, np.roll(ranges_m, -1))
    ends = np.flatnonzero(gaps_m > np.maximum(GAP_M, 1.6 * step_rad * nearer_m))
    if not len(ends):
        groups = [points]
    else:
        turned = np.roll(points, -(int(ends[-1]) + 1), axis=0)
        cuts = np.sort((ends - ends[-1] - 1) % len(points)) + 1
        groups = [group for group in np.split(turned, cuts) if len(group)]
    found: list[Returns] = []
    for group in groups:
        width_m = float(np.linalg.norm(np.ptp(group, axis=0)))
        if width_m > WIDEST_M:
            continue
        mean = group.mean(axis=0)
        range_m = max(float(np.linalg.norm(mean - eye)), 0.1)
        at = mean + WITHIN_M * (mean - eye) / range_m
        is_free = bool(solids.apart(np.array([[*at, z_m]]), TRUNK_M)[0])
        sigma_m = NOISE_M + NOISE_SHARE * range_m
        found.append(Returns(at, sigma_m, len(group), width_m, range_m, is_free))
    return tuple(found)


def sees_through(swept: Sweep, p_W: Array, *, half_m: float, beyond_m: float) -> bool:
    """Whether all beams about a point go on well past it: at least two, and none ends at it."""
    off = p_W - swept.eye_W
    range_m = float(np.hypot(*off))
    if range_m < 0.3 or range_m > FARTHEST_M:
        return False
    half_rad = math.atan2(half_m, range_m)
    off_rad = swept.bearings_rad - math.atan2(off[1], off[0])
    near = np.abs(np.mod(off_rad + math.pi, math.tau) - math.pi) < half_rad
    return int(near.sum()) >= 2 and bool((swept.ranges_m[near] > range_m + beyond_m).all())
