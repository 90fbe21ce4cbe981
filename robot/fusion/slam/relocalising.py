"""Where a robot is in a map that was made before, however it got there; or that it does not know.

One sweep can look the same in many places: with people before the lidar the best place of a whole
map was wrong in 27 of 36 cases, at scores of up to 0.99. So a place counts only when searches of
the whole map from several places along a way agree with odometry between them, and when no other
place of the map looks nearly as good. Until then the answer is "lost".
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from robot.fusion.slam.map_file import SavedMap
from robot.fusion.slam.matching import match
from robot.fusion.slam.patch import Patch
from robot.fusion.slam.planar import between, compose
from robot.fusion.slam.raster import Raster, search_points
from robot.fusion.slam.scan import Scan
from robot.se3 import Array

CELL_M = 0.2
LEVELS = 5
STEP_RAD = np.radians(2.0)
MOST = 1_500_000
SCORE = 0.6
FIT = 0.6
TRACKED = 0.5
"""A sweep that the map explains less of is not believed while the robot knows where it is."""
LOST_AFTER = 8
"""Sweeps in a row, moving, that are not believed before the robot is lost."""
AGAIN_M = 0.5
AGAIN_RAD = np.radians(30.0)
"""The map is searched again after a way or a turn."""
AGREEING = 3
AGREE_M = 0.4
AGREE_RAD = np.radians(6.0)
SLIP_SHARE = 0.1
ALIKE = 0.92
"""Another place that scores this much of the best one's could be it."""
MARGIN_M = 2.0


@dataclass(frozen=True, eq=False)
class Guess:
    """What a search of the whole map said, with odometry there and then."""

    pose: Array
    odometry: Array
    alone: bool


class Relocaliser:
    """Follows a lidar through a saved map.

    Attributes:
        pose: x, y [m], heading [rad] in the map; None while it is lost.
    """

    def __init__(self, saved: SavedMap) -> None:
        """Stand anywhere in a map."""
        self.pose: Array | None = None
        surface = saved.surface
        self._patch = Patch(surface[:, :2], surface[:, 2:4], surface[:, 4])
        low, high = saved.keys[:, :2].min(axis=0), saved.keys[:, :2].max(axis=0)
        self._middle = 0.5 * (low + high)
        self._reach_m = 0.5 * float((high - low).max()) + MARGIN_M
        self._raster = Raster(
            self._patch.filled(CELL_M),
            levels=LEVELS,
            reach_m=self._reach_m,
            cell_m=CELL_M,
            largest_m=2.0 * self._reach_m + 40.0,
        )
        self._odometry: Array | None = None
        self._guesses: list[Guess] = []
        self._missed = 0

    def locate(self, scan: Scan, odometry: Array) -> Array | None:
        """Take the next sweep, with the pose that odometry has at it; the pose, None when lost."""
        before, self._odometry = self._odometry, odometry
        if self.pose is not None and before is not None:
            self._follow(scan, between(before, odometry))
        elif self._moved(odometry):
            self._search(scan, odometry)
        return self.pose

    def _follow(self, scan: Scan, moved: Array) -> None:
        assert self.pose is not None
        expected = compose(self.pose, moved)
        sigma_m = 0.03 + 0.2 * float(np.hypot(moved[0], moved[1]))
        sigma_rad = np.radians(1.5) + 0.15 * abs(float(moved[2]))
        prior = np.diag([1 / sigma_m**2, 1 / sigma_m**2, 1 / sigma_rad**2])
        found = match(self._patch, scan.points, scan.normals, expected, prior=prior)
        if found.fit >= TRACKED:
            self.pose, self._missed = found.pose, 0
            return
        self.pose = expected
        self._missed += 1
        if self._missed >= LOST_AFTER:
            self.pose, self._missed = None, 0
            self._guesses.clear()

    def _moved(self, odometry: Array) -> bool:
        """Whether a search would see something new."""
        if not self._guesses:
            return True
        apart = between(self._guesses[-1].odometry, odometry)
        return bool(np.hypot(apart[0], apart[1]) > AGAIN_M or abs(apart[2]) > AGAIN_RAD)

    def _search(self, scan: Scan, odometry: Array) -> None:
        guess = self._guess(scan, odometry)
        if guess is None:
            self._guesses.clear()
            return
        if self._guesses and not _agree(self._guesses[-1], guess):
            self._guesses.clear()
        self._guesses.append(guess)
        recent = self._guesses[-AGREEING:]
        if len(recent) == AGREEING and sum(one.alone for one in recent) >= AGREEING - 1:
            self.pose = guess.pose
            self._guesses.clear()

    def _guess(self, scan: Scan, odometry: Array) -> Guess | None:
        """The best place of the whole map, if it explains the sweep."""
        points = search_points(scan.points)
        if len(points) < 20:
            return None
        center = np.array([*self._middle, 0.0])
        best = self._raster.search(
            points, center, reach_m=self._reach_m, reach_rad=np.pi, step_rad=STEP_RAD,
            least=SCORE, most=MOST,
        )  # fmt: skip
        if best is None or not best.complete:
            return None
        found = match(
            self._patch, scan.points, scan.normals, best.pose, gates_m=(0.5, 0.4, 0.25, 0.15)
        )
        if found.fit < FIT:
            return None
        other = self._raster.search(
            points, center, reach_m=self._reach_m, reach_rad=np.pi, step_rad=STEP_RAD,
            least=ALIKE * best.score, most=MOST, but=best.pose,
        )  # fmt: skip
        return Guess(found.pose, odometry, alone=other is None)


def _agree(first: Guess, second: Guess) -> bool:
    """Whether odometry tells of the same way as two places."""
    way = between(first.odometry, second.odometry)
    apart = between(compose(first.pose, way), second.pose)
    slip_m = SLIP_SHARE * float(np.hypot(way[0], way[1]))
    return bool(np.hypot(apart[0], apart[1]) < AGREE_M + slip_m and abs(apart[2]) < AGREE_RAD)
