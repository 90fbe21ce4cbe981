"""Follows a robot through a map: what odometry says of the way, corrected by each scan.

A Kalman filter of x, y and heading whose measurement is the matching itself: the scan is laid on
the map with what is expected as one more measurement (`robot.fusion.slam.matching`), so that what
the walls leave open, as along a bare corridor, stays with odometry, and its uncertainty grows.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from robot.fusion.slam.matching import match
from robot.fusion.slam.numerics import inverse_of
from robot.fusion.slam.patch import Patch
from robot.fusion.slam.planar import between, compose, wrapped
from robot.fusion.slam.scan import Scan
from robot.se3 import Array

REST_M, REST_RAD = 2e-4, np.radians(0.01)
"""1 sigma of odometry between two scans while it stands: a pose averages over about 5 s of them."""
SLIP_M, SLIP_RAD = 1.5e-3, np.radians(0.1)
WAY_M_RTM, TURN_RAD_RTRAD, WAY_RAD_RTM = 0.06, np.radians(2.0), np.radians(1.0)
"""The same while it walks: a floor, and what grows with the root of the way and of the turn. A walk
of 22 m in `real` drifts by 0.1 to 0.5 m and turns by up to 3.6 degrees (docs/realities.md): where
walls tell nothing of a direction, 1 sigma of it is 0.25 m after 17 m."""
STILL_M, STILL_RAD = 1e-3, np.radians(0.1)
"""Less than this between two scans is swaying, not walking."""
FITS = 0.6
"""A scan of which the map explains less does not count."""
FEWEST = 15
"""Points, of a scan that says anything."""
GATES_M = (0.3, 0.2, 0.12, 0.08)
"""How far a point may be from its wall, by iteration: what is farther is no part of the map."""
OPEN_SHARE = 0.03
"""A direction of which a match says less than this part of what it says of the other is open: along
a bare corridor, the noise of the walls' normals alone makes 0.004 to 0.011."""
TRUSTED = 0.5
"""Of a match's information is believed: what the map is off by, all scans of a place share."""


@dataclass(frozen=True, eq=False)
class Followed:
    """What came of a scan: whether it could say anything, whether the map explains it, how much."""

    told: bool
    fits: bool
    fit: float


class PlaceFilter:
    """Where the lidar is in the map.

    Attributes:
        pose: x, y [m], heading [rad], of the lidar's level frame in the map.
        covariance: (3, 3), of its errors in the map's axes.
    """

    def __init__(self, patch: Patch) -> None:
        """Follow in a map; nothing is known before `begin`."""
        self.pose: Array = np.zeros(3)
        self.covariance: Array = np.eye(3)
        self._patch = patch
        self._odometry: Array = np.zeros(3)

    def begin(self, pose: Array, odometry: Array, sigmas: Array) -> None:
        """Be at a pose, while odometry is at another, sure to within `sigmas` (3,)."""
        self.pose, self._odometry = np.array(pose), np.array(odometry)
        self.covariance = np.diag(np.square(sigmas))

    def predict(self, odometry: Array) -> None:
        """Go the way that odometry went since it was asked last."""
        moved = between(self._odometry, odometry)
        self._odometry = np.array(odometry)
        before, self.pose = self.pose, compose(self.pose, moved)
        way_m, turn_rad = float(np.hypot(moved[0], moved[1])), abs(float(moved[2]))
        if way_m < STILL_M and turn_rad < STILL_RAD:
            sigma_m, sigma_rad = REST_M, REST_RAD
        else:
            sigma_m = SLIP_M + WAY_M_RTM * math.sqrt(way_m)
            turned_rad = TURN_RAD_RTRAD * math.sqrt(turn_rad)
            sigma_rad = SLIP_RAD + turned_rad + WAY_RAD_RTM * math.sqrt(way_m)
        arm = self.pose[:2] - before[:2]
        carried = np.eye(3)
        carried[0, 2], carried[1, 2] = -arm[1], arm[0]
        noise = np.diag([sigma_m**2, sigma_m**2, sigma_rad**2])
        self.covariance = carried @ self.covariance @ carried.T + noise

    def doubt(self, sigma_m: float, sigma_rad: float) -> None:
        """Be less sure: something happened that odometry does not tell."""
        self.covariance = self.covariance + np.diag([sigma_m**2, sigma_m**2, sigma_rad**2])

    def correct(self, scan: Scan) -> Followed:
        """Take a scan at the predicted pose; the pose moves only if the map explains it."""
        if len(scan.points) < FEWEST:
            return Followed(told=False, fits=False, fit=0.0)
        prior = inverse_of(self.covariance) / TRUSTED
        found = match(
            self._patch, scan.points, scan.normals, self.pose, prior=prior, gates_m=GATES_M
        )
        if found.fit < FITS:
            return Followed(told=True, fits=False, fit=found.fit)
        told = _told(found.information)
        change = found.pose - self.pose
        change[2] = wrapped(change[2])
        self.pose = self.pose + told @ change
        self.pose[2] = wrapped(self.pose[2])
        information = told @ found.information @ told
        self.covariance = inverse_of(TRUSTED * (information + prior))
        return Followed(told=True, fits=True, fit=found.fit)


def _told(information: Array) -> Array:
    """What takes the open direction, if there is one, out of a change of the pose, (3, 3)."""
    shares, directions = np.linalg.eigh(information[:2, :2])
    kept = np.eye(3)
    if shares[0] < OPEN_SHARE * shares[1]:
        along = directions[:, 0]
        kept[:2, :2] -= np.outer(along, along)
    return kept
