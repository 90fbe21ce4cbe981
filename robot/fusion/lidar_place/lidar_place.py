"""Where the robot is, by lidar, odometry and its own map; or that it does not know, and why."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from robot.fusion.lidar_place.finder import Finder, Guess
from robot.fusion.lidar_place.levelled import Levelled
from robot.fusion.lidar_place.place_filter import PlaceFilter
from robot.fusion.slam.map_file import SavedMap
from robot.fusion.slam.patch import Patch
from robot.fusion.slam.planar import between, compose, inverse
from robot.se3 import Array

UPRIGHT_RAD = np.radians(8.0)
BAND_M = 0.08
"""A lidar that leans more, or is farther from the height at which the map was made, sees other
edges than the map's: odometry has to do."""
BLIND_M_RTS, BLIND_RAD_RTS = 0.065, np.radians(2.0)
"""How unsure a robot gets that sees nothing that tells, though it stands: lost after 15 s."""
MISSES = 8
"""Scans in a row that the map does not explain before the robot is lost: 0.8 s."""
LOST_M, LOST_RAD = 0.25, np.radians(8.0)
"""1 sigma in the worst direction from which on nothing is to be walked or grasped by the pose."""
AGAIN_S, LATER_S = 0.4, 2.0
"""Between two searches of the whole map, while they find something and while they do not."""
AGREEING = 3
AGREE_M, AGREE_RAD = 0.15, np.radians(4.0)
FOUND = np.array([0.05, 0.05, np.radians(2.0)])
"""1 sigma of a pose that was found."""
LEFT_M, LEFT_RAD = 0.3, np.radians(10.0)
"""1 sigma of where it is by what it believed, once odometry has begun anew (a fall, a controller
that died)."""
SEARCHING = "I am looking for where I am"
MISFIT = "I am lost: what I see is not what the map has where I believed to be"
UNSURE = "I am lost: for too long I saw nothing that tells where I am"


@dataclass(frozen=True, eq=False)
class Whereabouts:
    """What is known after a scan.

    Attributes:
        X_WN: x, y [m], heading [rad] of the odometry frame in the map, (3,); None while it is lost.
        covariance: (3, 3), of the lidar's x, y and heading in the map.
        fit: which part of the scan the map explains; 0 where none was laid on it.
        lost: why it does not know; "" while it does.
    """

    X_WN: Array | None
    covariance: Array
    fit: float
    lost: str


class LidarPlace:
    """Follows the robot through its own map.

    Attributes:
        losses: how often it was lost after it had known where it was.
    """

    def __init__(self, saved: SavedMap) -> None:
        """Be anywhere in a map."""
        self.losses = 0
        patch = Patch(saved.surface[:, :2], saved.surface[:, 2:4], saved.surface[:, 4])
        self._filter, self._finder = PlaceFilter(patch), Finder(saved, patch)
        self._height_m = saved.height_m
        self._lost = SEARCHING
        self._misses = 0
        self._guesses: list[tuple[Guess, Array]] = []
        self._seen_s = self._searched_s = -np.inf
        self._restarts = 0
        self._fresh = True

    def see(self, sweep: Levelled, stamp_s: float, *, restarts: int = 0) -> Whereabouts:
        """Take the next scan.

        Args:
            sweep: the scan, with odometry at its stamp.
            stamp_s: its stamp.
            restarts: how often odometry has begun anew, in a frame that has nothing to do with
                the one before it.
        """
        since_s = min(1.0, max(0.0, stamp_s - self._seen_s))
        self._seen_s = stamp_s
        if restarts != self._restarts:
            self._begin_anew(sweep, restarts)
        if self._lost:
            self._search(sweep, stamp_s)
            fit = 0.0
        else:
            fit = self._follow(sweep, since_s)
        pose = None
        if not self._lost:
            pose = compose(self._filter.pose, inverse(sweep.odometry))
        return Whereabouts(pose, self._filter.covariance, fit, self._lost)

    def _begin_anew(self, sweep: Levelled, restarts: int) -> None:
        self._restarts = restarts
        self._guesses.clear()
        state = self._filter
        sigmas = np.sqrt(np.diag(state.covariance))
        state.begin(state.pose, sweep.odometry, np.hypot(sigmas, [LEFT_M, LEFT_M, LEFT_RAD]))
        if not self._lost:
            self._lose(UNSURE)

    def _follow(self, sweep: Levelled, since_s: float) -> float:
        """Keep up; returns which part of the scan the map explains."""
        state = self._filter
        state.predict(sweep.odometry)
        told, fit = False, 0.0
        if self._is_level(sweep):
            followed = state.correct(sweep.scan)
            told, fit = followed.told, followed.fit
            if followed.fits:
                self._misses = 0
            elif told:
                self._misses += 1
        if not told:
            share = math.sqrt(since_s)
            state.doubt(BLIND_M_RTS * share, BLIND_RAD_RTS * share)
        if self._misses >= MISSES:
            self._lose(MISFIT)
        elif self._is_unsure():
            self._lose(UNSURE)
        return fit

    def _is_level(self, sweep: Levelled) -> bool:
        elsewhere = abs(sweep.height_m - self._height_m) >= BAND_M  # NaN is no height of its own
        return sweep.tilt_rad < UPRIGHT_RAD and not elsewhere

    def _is_unsure(self) -> bool:
        covariance = self._filter.covariance
        worst_m = float(np.sqrt(np.linalg.eigvalsh(covariance[:2, :2])[-1]))
        return worst_m > LOST_M or float(np.sqrt(covariance[2, 2])) > LOST_RAD

    def _lose(self, why: str) -> None:
        self._lost, self._misses, self._fresh = why, 0, True
        self.losses += 1
        self._guesses.clear()

    def _search(self, sweep: Levelled, stamp_s: float) -> None:
        """Look for the scan in the whole map, now and then, until some in a row say the same."""
        patience_s = AGAIN_S if self._guesses or self._fresh else LATER_S
        if stamp_s - self._searched_s < patience_s or not self._is_level(sweep):
            return
        self._searched_s = stamp_s
        guess, self._fresh = self._finder.look(sweep.scan), False
        if guess is None or not guess.sure:
            self._guesses.clear()
            return
        if self._guesses and not _agree(*self._guesses[-1], guess, sweep.odometry):
            self._guesses.clear()
        self._guesses.append((guess, sweep.odometry))
        if len(self._guesses) >= AGREEING:
            self._filter.begin(guess.pose, sweep.odometry, FOUND)
            self._filter.correct(sweep.scan)
            self._lost = ""
            self._guesses.clear()


def _agree(first: Guess, then: Array, second: Guess, now: Array) -> bool:
    """Whether odometry, at two poses, tells of the same way as two places."""
    apart = between(compose(first.pose, between(then, now)), second.pose)
    return bool(np.hypot(apart[0], apart[1]) < AGREE_M and abs(apart[2]) < AGREE_RAD)
