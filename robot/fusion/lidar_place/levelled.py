"""A scan laid into the plane: a lidar on a body that sways is neither level nor where it was."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from robot.fusion.slam.planar import turn
from robot.fusion.slam.scan import Scan, scan_of
from robot.messages import LidarScan
from robot.se3 import SE3, Array

FLOOR_M = 0.15
"""Hits lower than this are the floor, or on it."""
BAND_M = 0.15
"""Hits that a tilt carried farther from the height of the lidar show other edges than the map's."""
LARGEST_M = 1e3
"""Of a range; larger ones, and inf, are no returns."""


@dataclass(frozen=True, eq=False)
class Levelled:
    """What a scan shows in the plane.

    Attributes:
        scan: its points in the level frame: at the lidar, turned as it is, with z up.
        odometry: x, y [m], heading [rad] of that frame in the odometry frame.
        height_m: of the lidar over the floor of the odometry frame.
        tilt_rad: of the lidar.
    """

    scan: Scan
    odometry: Array
    height_m: float
    tilt_rad: float


def planar(X: SE3) -> Array:
    """x, y [m] and heading [rad] of a pose, shape (3,)."""
    return np.array([X.p[0], X.p[1], X.yaw_rad])


def levelled(taken: LidarScan, X_NL: SE3) -> Levelled:
    """Lay a scan into the plane.

    Args:
        taken: the sweep.
        X_NL: pose of the lidar in the odometry frame, whose z is up, at the scan's stamp.
    """
    ranges_m = np.array(taken.ranges_m, dtype=float)
    scan = scan_of(ranges_m, taken.angle_min_rad, taken.angle_step_rad, range_max_m=LARGEST_M)
    rotation, height_m = X_NL.rotation(), X_NL.p[2]
    # From the lidar's own frame to the level one; its third row is how much higher a hit is.
    level = turn(X_NL.yaw_rad) @ rotation[:2, :2]
    above_m = scan.points @ rotation[2, :2]
    kept = (np.abs(above_m) < BAND_M) & (height_m + above_m > FLOOR_M)
    scan = replace(
        scan,
        points=scan.points[kept] @ level.T,
        normals=_units(scan.normals[kept] @ level.T),
        spans_m=scan.spans_m[kept],
    )
    tilt_rad = math.acos(max(-1.0, min(1.0, float(rotation[2, 2]))))
    return Levelled(scan, planar(X_NL), float(height_m), tilt_rad)


def _units(vectors: Array) -> Array:
    """Vectors (n, 2) of length one; those without a length stay zero."""
    length = np.hypot(vectors[:, 0], vectors[:, 1])[:, None]
    return np.where(length > 1e-6, vectors / np.maximum(length, 1e-6), 0.0)
