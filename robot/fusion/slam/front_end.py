"""From sweep to sweep: where the lidar is with respect to the last few key frames.

Its frame drifts and never jumps. Every scan is matched to the key frames of the last metres, from
where odometry puts it; where that does not fit, a window about it is searched whole.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

import numpy as np

from robot.fusion.slam.matching import Match, match
from robot.fusion.slam.patch import Patch
from robot.fusion.slam.planar import between, compose, wrapped
from robot.fusion.slam.raster import CELL_M, Raster, search_points
from robot.fusion.slam.scan import Scan
from robot.se3 import Array

KEY_M = 0.25
KEY_RAD = np.radians(10.0)
"""A scan that is farther than this from the last key frame becomes one."""
RECENT = 15
"""Key frames that a scan is matched to."""
FITS = 0.7
"""A match that explains less of the scan is searched for in a window."""
LOST = 0.35
"""A match that explains less is not believed: odometry is."""
BETTER = 0.05
"""What a search finds must explain this much more of the scan to be preferred."""
FEWEST_POINTS = 12
STILL_M = 1e-3
STILL_RAD = 1e-3
STILL_RANGE_M = 0.03
"""A robot whose wheels and whose ranges moved less than this since its last scan stands still."""
SLIP_M = 0.02
SLIP_SHARE = 0.15
SLIP_RAD = np.radians(1.0)
SLIP_TURN_SHARE = 0.1
SLIP_RAD_PER_M = np.radians(2.0)
"""1 sigma of odometry between two scans: a floor, and what grows with the way and the turn."""
WINDOW_SIGMAS = 3.0
LEAST_WINDOW_M = 0.3
LARGEST_WINDOW_M = 2.0
LEAST_WINDOW_RAD = np.radians(6.0)
LARGEST_WINDOW_RAD = np.radians(45.0)


@dataclass(frozen=True, eq=False)
class Tracked:
    """Where a scan was found.

    Attributes:
        pose: in the front end's frame.
        key: whether it became a key frame.
        information: (3, 3), of the match; zero where there was none.
        blind: (3,) variances of the way since the last key frame that only odometry tells.
    """

    pose: Array
    key: bool
    information: Array
    blind: Array


class FrontEnd:
    """Follows a lidar.

    Attributes:
        pose: where it is in this frame, at the last scan.
    """

    def __init__(
        self,
        *,
        key_m: float = KEY_M,
        recent: int = RECENT,
        slip: float = 1.0,
        fits: float = FITS,
    ) -> None:
        """Begin at the origin.

        Args:
            key_m: a scan that is farther than this from the last key frame becomes one.
            recent: key frames that a scan is matched to.
            slip: how far odometry errs, against that of wheels; what it learns comes on top.
            fits: a match that explains less of the scan is searched for in a window.
        """
        self.pose = np.zeros(3)
        self._slip, self._fits = slip, fits
        self._key_m = key_m
        self._odometry: Array | None = None
        self._seen_m: Array | None = None
        self._recent: deque[tuple[Scan, Array]] = deque(maxlen=recent)
        self._patch: Patch | None = None
        self._raster: Raster | None = None
        self._lost = 0
        self._blind = np.zeros(3)
        self._noise = 1.0

    def track(self, scan: Scan, odometry: Array) -> Tracked:
        """Take the next scan, with the pose that odometry has at it."""
        moved = np.zeros(3) if self._odometry is None else between(self._odometry, odometry)
        self._odometry = odometry
        before_m, self._seen_m = self._seen_m, scan.seen_m
        if self._patch is None:
            return self._keep(scan, np.zeros((3, 3)))
        way_m, turn_rad = float(np.hypot(moved[0], moved[1])), abs(float(moved[2]))
        if (
            way_m < STILL_M
            and turn_rad < STILL_RAD
            and not self._lost
            and _alike(before_m, scan.seen_m)
        ):
            self.pose = compose(self.pose, moved)
            return Tracked(self.pose, key=False, information=np.zeros((3, 3)), blind=self._blind)
        sigmas = (
            np.array(
                [
                    SLIP_M + SLIP_SHARE * way_m,
                    SLIP_M + SLIP_SHARE * way_m,
                    SLIP_RAD + SLIP_TURN_SHARE * turn_rad + SLIP_RAD_PER_M * way_m,
                ]
            )
            * (1.0 + self._lost)
            * self._noise
            * self._slip
        )
        expected = compose(self.pose, moved)
        found = self._find(scan, expected, sigmas)
        sure = found is not None
        self.pose = expected if found is None else found.pose
        self._lost = 0 if sure else min(self._lost + 1, 10)
        information = np.zeros((3, 3)) if found is None else found.information
        if found is None:
            self._blind = self._blind + sigmas**2
        else:
            self._learn(found.pose - expected, sigmas / self._noise)
        last = self._recent[-1][1]
        apart = between(last, self.pose)
        if np.hypot(apart[0], apart[1]) > self._key_m or abs(apart[2]) > KEY_RAD:
            return self._keep(scan, information)
        return Tracked(self.pose, key=False, information=information, blind=self._blind)

    def _learn(self, innovation: Array, sigmas: Array) -> None:
        """How much worse odometry is than thought: a slow mean of normalised innovations."""
        innovation = np.array([innovation[0], innovation[1], wrapped(innovation[2])])
        size = float(np.sqrt(np.mean((innovation / sigmas) ** 2)))
        self._noise = float(np.clip(0.95 * self._noise + 0.05 * 1.5 * size, 1.0, 10.0))

    def _find(self, scan: Scan, expected: Array, sigmas: Array) -> Match | None:
        if self._patch is None or len(scan.points) < FEWEST_POINTS:
            return None
        prior = np.diag(1.0 / sigmas**2)
        points, normals = scan.points, scan.normals
        found = match(self._patch, points, normals, expected, prior=prior)
        if found.fit >= self._fits:
            return found
        if self._raster is None:
            self._raster = Raster(self._patch.filled(CELL_M), levels=3, reach_m=LARGEST_WINDOW_M)
        reach_m = float(np.clip(WINDOW_SIGMAS * sigmas[0], LEAST_WINDOW_M, LARGEST_WINDOW_M))
        reach_rad = float(np.clip(WINDOW_SIGMAS * sigmas[2], LEAST_WINDOW_RAD, LARGEST_WINDOW_RAD))
        found = self._search(scan, expected, found, reach_m, reach_rad)
        if found.fit < LOST:
            # Wheels that were lifted or restarted: any heading, if it fits well.
            turned = self._search(scan, expected, found, reach_m, np.pi)
            if turned.fit >= FITS:
                return turned
        return found if found.fit >= LOST else None

    def _search(
        self, scan: Scan, expected: Array, found: Match, reach_m: float, reach_rad: float
    ) -> Match:
        """The better one of a match and of what the best pose of a window comes to."""
        assert self._patch is not None
        assert self._raster is not None
        searched = self._raster.search(
            search_points(scan.points),
            expected,
            reach_m=reach_m,
            reach_rad=reach_rad,
            step_rad=np.radians(1.5),
            least=0.2,
        )
        if searched is None or not searched.complete:
            return found
        other = match(self._patch, scan.points, scan.normals, searched.pose)
        return other if other.fit > found.fit + BETTER else found

    def _keep(self, scan: Scan, information: Array) -> Tracked:
        self._recent.append((scan, self.pose))
        scans, poses = zip(*self._recent, strict=True)
        self._patch = Patch.of(scans, poses)
        self._raster = None
        blind, self._blind = self._blind, np.zeros(3)
        return Tracked(self.pose, key=True, information=information, blind=blind)


def _alike(before_m: Array | None, now_m: Array) -> bool:
    """Whether two sweeps show the same: their beams rarely differ."""
    if before_m is None or before_m.shape != now_m.shape:
        return False
    return float(np.mean(np.abs(before_m - now_m) > STILL_RANGE_M)) < 0.2
