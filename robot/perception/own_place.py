"""The robot's own word of where it is: each scan of its lidar becomes a fix, or "I am lost"."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from robot.errors import ConfigError, Problem
from robot.fusion.history import BodyHistory
from robot.fusion.lidar_place.levelled import levelled
from robot.fusion.lidar_place.lidar_place import SEARCHING, LidarPlace, Whereabouts
from robot.fusion.slam import map_file
from robot.messages import LidarScan, PoseFix
from robot.se3 import SE3

NO_MAP = "a robot that finds itself by its lidar needs a map to do so in"
CURE = "executive.runs.lidar_maps makes one of a world (docs/localisation.md)"


class OwnPlace:
    """Makes fixes of scans.

    Attributes:
        lost: why the robot does not know where it is, "" while it does.
    """

    def __init__(self, map: Path | None, history: BodyHistory) -> None:
        """Read the map.

        Args:
            map: the file.
            history: of the body.

        Raises:
            ConfigError: there is no map, or it is none.
        """
        if map is None:
            raise ConfigError([Problem(NO_MAP, suggestion=CURE)])
        self.lost = SEARCHING
        self._history = history
        self._place = LidarPlace(map_file.load(map))

    def see(self, scan: LidarScan, X_NL: SE3) -> PoseFix | None:
        """The fix of a scan, taken by a lidar at X_NL; None while the robot is lost."""
        X_NB = self._history.base_at(scan.stamp_s)
        if X_NB is None:
            return None
        sweep = levelled(scan, X_NL)
        where = self._place.see(sweep, scan.stamp_s, restarts=self._history.restarts)
        self.lost = where.lost
        return _fix(where, X_NB, scan.stamp_s)


def _fix(where: Whereabouts, X_NB: SE3, stamp_s: float) -> PoseFix | None:
    """Height, roll and pitch are those of odometry: legs and gravity tell them better."""
    if where.X_WN is None:
        return None
    x_m, y_m, yaw_rad = where.X_WN.tolist()
    covariance = np.asarray(where.covariance, dtype=float)
    return PoseFix(
        stamp_s=stamp_s,
        X_WB=SE3.from_xy_yaw(x_m, y_m, yaw_rad) @ X_NB,
        source="estimate",
        covariance=tuple(covariance.ravel().tolist()),
    )
