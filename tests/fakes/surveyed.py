"""A building that was walked through once, and its map; a robot in it, which may be carried off."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from robot.fusion.lidar_place.levelled import Levelled, levelled
from robot.fusion.lidar_place.lidar_place import LidarPlace, Whereabouts
from robot.fusion.lidar_place.mapping import walked_map
from robot.fusion.slam.map_file import SavedMap
from robot.fusion.slam.planar import between, compose
from robot.messages import LidarScan
from robot.se3 import SE3, Array
from tests.fakes import buildings
from tests.fakes.buildings import Lidar, box

LIDAR = Lidar(beams=180, first_rad=-np.pi, step_rad=np.pi / 90, noise_m=0.02)
HEIGHT_M = 0.64
PERIOD_S = 0.1
DROPOUTS = 0.02


def loop(poses: list[tuple[float, float]], step_m: float = 0.04) -> Array:
    """Poses along straight lines from corner to corner, looking where it goes."""
    found: list[tuple[float, float, float]] = []
    for (x1, y1), (x2, y2) in pairwise(poses):
        count = max(1, round(np.hypot(x2 - x1, y2 - y1) / step_m))
        heading = float(np.arctan2(y2 - y1, x2 - x1))
        for k in range(count):
            share = k / count
            found.append((x1 + share * (x2 - x1), y1 + share * (y2 - y1), heading))
    return np.array(found)


ROUND = loop([(1.5, 1.5), (2.0, 4.0), (4.5, 3.8), (6.0, 3.6), (6.0, 1.0), (4.0, 0.8), (1.5, 1.5)])
"""A way through `buildings.room`."""


def taken(
    walls: Array, pose: Array, *, rng: np.random.Generator, stamp_s: float = 0.0
) -> LidarScan:
    """A sweep with noise and beams that come back empty."""
    ranges = buildings.ranges_m(walls, pose, LIDAR) + rng.normal(0.0, LIDAR.noise_m, LIDAR.beams)
    ranges[rng.random(LIDAR.beams) < DROPOUTS] = np.inf
    return LidarScan(
        stamp_s=stamp_s, angle_min_rad=LIDAR.first_rad, angle_step_rad=LIDAR.step_rad,
        ranges_m=tuple(ranges.tolist()),
    )  # fmt: skip


def at(odometry: Array) -> SE3:
    """X_NL of a level lidar."""
    x, y, yaw = odometry.tolist()
    return SE3.from_xy_yaw(x, y, yaw, z_m=HEIGHT_M)


def sweeps(walls: Array, true: Array, odometry: Array, *, seed: int) -> list[Levelled]:
    """What the lidar shows along a way."""
    rng = np.random.default_rng(seed)
    return [
        levelled(taken(walls, pose, rng=rng), at(said))
        for pose, said in zip(true, odometry, strict=True)
    ]


def mapped(walls: Array, true: Array, *, seed: int = 0, scale: float = 0.4) -> SavedMap:
    """The map that a walk makes."""
    odometry = buildings.drifting(true, seed=seed, scale=scale)
    stamps_s = [PERIOD_S * k for k in range(len(true))]
    return walked_map(sweeps(walls, true, odometry, seed=seed), stamps_s, true[0])


class Walker:
    """A robot whose odometry drifts, and its word of where it is."""

    def __init__(self, saved: SavedMap, walls: Array, pose: Array, *, seed: int = 1) -> None:
        self.place, self.walls, self.true = LidarPlace(saved), walls, np.array(pose)
        self.odometry = np.array([3.0, -2.0, 1.0])
        self.rng = np.random.default_rng(seed)
        self.stamp_s = 0.0
        self.blind = False
        self.people: list[Array] = []

    def go(self, moved: Array) -> Whereabouts:
        """Move by a pose (3,), odometry erring, and take a scan."""
        self.true = compose(self.true, moved)
        said = moved.copy()
        said[:2] *= 1.02
        said[2] += 0.02 * np.hypot(moved[0], moved[1])
        self.odometry = compose(self.odometry, said)
        self.stamp_s += PERIOD_S
        if self.blind:
            empty = (np.inf,) * LIDAR.beams
            scan = LidarScan(
                stamp_s=self.stamp_s, angle_min_rad=LIDAR.first_rad,
                angle_step_rad=LIDAR.step_rad, ranges_m=empty,
            )  # fmt: skip
        else:
            walls = np.concatenate([self.walls, *self.people]) if self.people else self.walls
            scan = taken(walls, self.true, rng=self.rng, stamp_s=self.stamp_s)
        return self.place.see(levelled(scan, at(self.odometry)), self.stamp_s)

    def stand(self, scans: int) -> list[Whereabouts]:
        """Stay for so many scans."""
        return [self.go(np.zeros(3)) for _ in range(scans)]

    def follow(self, way: Array) -> list[float]:
        """Walk along poses; how far off it believed to be [m], where it knew where it was."""
        off: list[float] = []
        for pose in way:
            where = self.go(between(self.true, pose))
            if where.X_WN is not None:
                off.append(self.off_m(where))
        return off

    def off_m(self, where: Whereabouts) -> float:
        """How far from the truth it believes to be [m]."""
        assert where.X_WN is not None
        apart = between(compose(where.X_WN, self.odometry), self.true)
        return float(np.hypot(apart[0], apart[1]))

    def carry(self, pose: Array) -> None:
        """Set it down elsewhere; odometry does not tell."""
        self.true = np.array(pose)


def person(x: float, y: float) -> Array:
    """Two legs' worth of a body."""
    return np.array(box(x - 0.15, y - 0.15, 0.3, 0.3))
