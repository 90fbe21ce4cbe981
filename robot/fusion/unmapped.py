"""What lidar and camera see that the map does not explain: a chair that was moved, a person.

The lidar sees all around at one height, which passes over a chair's seat; the depth image is made a
scan of its own: the nearest strange thing in each column.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from robot.messages import DepthImage, LidarScan, Obstacle, Shape
from robot.se3 import SE3, Array, Vector3

NEAR_MAP_M = 0.10
NEAR_MAP_SHARE = 0.03
MIN_HEIGHT_M, MAX_HEIGHT_M = 0.2, 1.6
CLUSTER_GAP_M = 0.25
MIN_POINTS = 3
MAX_RANGE_M = 6.0
SAME_M = 0.35
SCANS_TO_BELIEVE = 3
FORGET_S = 2.0
PADDING_M = 0.05
HEIGHT_M = 1.2
COLUMNS = 40
LOW_M, HIGH_M = 0.12, 1.4
NEAR_SELF_M = 0.62
"""Nearer to the middle of the body, the camera may see the robot's own arms and what they hold."""
DEPTH_RANGE_M = 2.5
ARM_M = 0.2
"""About an arm and a hand: half of a held bottle or box, and the lag of the pose."""


@dataclass
class _Cluster:
    """A group of unexplained hits: its extent in W [m], when and how often it was seen."""

    low: Array
    high: Array
    seen_s: float
    scans: int
    number: int

    @property
    def centre(self) -> Array:
        return 0.5 * (self.low + self.high)


class UnmappedObstacles:
    """Clusters of unexplained hits, kept while they are seen again and again."""

    def __init__(
        self, *, body_radius_m: float, forget_s: float = FORGET_S, name: str = "unmapped"
    ) -> None:
        self._body_radius_m = body_radius_m
        self._forget_s = forget_s
        self._name = name
        self._boxes: Array = np.zeros((0, 6))
        self._clusters: list[_Cluster] = []
        self._count = 0
        self._arms: Array = np.zeros((0, 2, 2))

    def know(self, obstacles: tuple[Obstacle, ...]) -> None:
        """Take the map: footprints of every shape, as (x, y, cos, sin, half x, half y)."""
        rows: list[tuple[float, ...]] = []
        for obstacle in obstacles:
            for shape in obstacle.shapes:
                X_WS = obstacle.X_WO @ shape.X_BodyShape
                yaw = X_WS.yaw_rad
                half = (0.5 * shape.size_m[0], 0.5 * shape.size_m[1])
                rows.append((X_WS.p[0], X_WS.p[1], math.cos(yaw), math.sin(yaw), *half))
        self._boxes = np.array(rows, dtype=np.float64).reshape(-1, 6)

    def feel(self, X_WB: SE3, hands_W: Iterable[Vector3]) -> None:
        """Take where the robot's arms are: about the lines on the floor from the body to the hands.

        An arm that is stretched out, and what it holds, is seen beyond the body; taken for somebody
        else's, the held thing touched itself wherever it went.
        """
        self._arms = np.array([[X_WB.p[:2], p_W[:2]] for p_W in hands_W]).reshape(-1, 2, 2)

    def forget(self) -> None:
        """Take back all that was seen: it was placed by a pose that was wrong."""
        self._clusters.clear()

    def see(self, scan: LidarScan, X_WLidar: SE3) -> None:
        """Take one scan from a lidar at X_WLidar."""
        self._take(self._unexplained(scan, X_WLidar), scan.stamp_s)

    def see_depth(self, image: DepthImage, X_WC: SE3, X_WB: SE3) -> None:
        """Take one depth image of a camera at X_WC, the body being at X_WB."""
        points, ranges = _points(image, X_WC)
        off = points[..., :2] - np.array(X_WB.p[:2])
        keep = (points[..., 2] > LOW_M) & (points[..., 2] < HIGH_M) & np.isfinite(ranges)
        keep &= np.hypot(off[..., 0], off[..., 1]) > NEAR_SELF_M
        keep[keep] = self._strange(points[keep], NEAR_MAP_M + NEAR_MAP_SHARE * ranges[keep])
        ranges = np.where(keep, ranges, np.inf)
        columns = np.flatnonzero(np.isfinite(ranges).any(axis=0))
        nearest = points[np.argmin(ranges, axis=0)[columns], columns, :2]
        self._take(nearest, image.stamp_s)

    def _take(self, points: Array, stamp_s: float) -> None:
        """Group strange hits, shape (k, 2), into clusters; forget what was not seen for long."""
        for group in _groups(points[~self._is_own(points)]):
            self._merge(group.min(axis=0), group.max(axis=0), stamp_s)
        self._clusters = [one for one in self._clusters if stamp_s - one.seen_s < self._forget_s]

    def obstacles(self, *, since_s: float = -math.inf) -> tuple[Obstacle, ...]:
        """What is believed, as boxes on the floor; of that only what was seen since a time."""
        return tuple(
            _box(cluster, self._name)
            for cluster in self._clusters
            if cluster.scans >= SCANS_TO_BELIEVE and cluster.seen_s >= since_s
        )

    def _unexplained(self, scan: LidarScan, X_WLidar: SE3) -> Array:
        """Hits [m] in W that neither map nor floor nor the robot itself explain, shape (k, 2)."""
        ranges = np.array(scan.ranges_m)
        angles = scan.angle_min_rad + scan.angle_step_rad * np.arange(len(ranges))
        keep = np.isfinite(ranges) & (ranges < MAX_RANGE_M)
        keep &= ranges > self._body_radius_m + PADDING_M
        ranges, angles = ranges[keep], angles[keep]
        beams = np.stack(
            [ranges * np.cos(angles), ranges * np.sin(angles), np.zeros(len(ranges))], axis=1
        )
        points = beams @ X_WLidar.rotation().T + np.array(X_WLidar.p)
        keep = (points[:, 2] > MIN_HEIGHT_M) & (points[:, 2] < MAX_HEIGHT_M)
        keep &= self._strange(points, NEAR_MAP_M + NEAR_MAP_SHARE * ranges)
        return points[keep, :2]

    def _is_own(self, points: Array) -> NDArray[np.bool_]:
        """Which points, shape (k, 2), are of the robot's arms or of what its hands hold."""
        own = np.zeros(len(points), dtype=bool)
        for begin, end in self._arms:
            line = end - begin
            along = np.clip((points - begin) @ line / max(float(line @ line), 1e-9), 0.0, 1.0)
            own |= np.linalg.norm(points - begin - along[:, None] * line, axis=1) < ARM_M
        return own

    def _strange(self, points: Array, margin_m: Array) -> NDArray[np.bool_]:
        """Which points lie in or near no footprint of the map, shape (k,)."""
        boxes = self._boxes_near(points, margin_m)
        x, y, c, s, half_x, half_y = (column[None, :] for column in boxes.T)
        dx, dy = points[:, 0:1] - x, points[:, 1:2] - y
        along, across = np.abs(c * dx + s * dy), np.abs(c * dy - s * dx)
        margin = margin_m[:, None]
        return np.all((along > half_x + margin) | (across > half_y + margin), axis=1)

    def _boxes_near(self, points: Array, margin_m: Array) -> Array:
        """The footprints that any of these points could lie in or near."""
        if not len(points):
            return self._boxes[:0]
        reach = np.hypot(self._boxes[:, 4], self._boxes[:, 5]) + 1.5 * float(margin_m.max())
        at, reach = self._boxes[:, :2], reach[:, None]
        low, high = points[:, :2].min(axis=0), points[:, :2].max(axis=0)
        near = (at > low - reach) & (at < high + reach)
        return self._boxes[near.all(axis=1)]

    def _merge(self, low: Array, high: Array, stamp_s: float) -> None:
        """Move a known cluster to where it is now, or begin a new one."""
        centre = 0.5 * (low + high)
        for cluster in self._clusters:
            if cluster.seen_s < stamp_s and np.linalg.norm(cluster.centre - centre) < SAME_M:
                cluster.low, cluster.high = low, high
                cluster.seen_s = stamp_s
                cluster.scans += 1
                return
        self._count += 1
        self._clusters.append(_Cluster(low, high, stamp_s, 1, self._count))


def _groups(points: Array) -> list[Array]:
    """Split hits in beam order where neighbours are far apart; small groups are noise.

    A group that the scan's ends cut in two stays two; both are reported.
    """
    if len(points) == 0:
        return []
    gaps = np.linalg.norm(np.diff(points, axis=0), axis=1) > CLUSTER_GAP_M
    parts = np.split(points, np.flatnonzero(gaps) + 1)
    return [part for part in parts if len(part) >= MIN_POINTS]


def _points(image: DepthImage, X_WC: SE3) -> tuple[Array, Array]:
    """Points in W (rows, columns, 3) of every few pixels, and their depth (inf: too far)."""
    step = max(1, image.width // COLUMNS)
    rows, columns = np.arange(0, image.height, step), np.arange(0, image.width, step)
    depth = image.pixels()[np.ix_(rows, columns)].astype(np.float64)
    depth[(depth <= 0.0) | (depth > DEPTH_RANGE_M)] = np.inf
    focal_px = 0.5 * image.height / math.tan(0.5 * image.fovy_rad)
    x = (columns[None, :] + 0.5 - 0.5 * image.width) / focal_px
    y = (rows[:, None] + 0.5 - 0.5 * image.height) / focal_px
    near = np.where(np.isfinite(depth), depth, 0.0)
    points_C = np.stack([x * near, y * near, near], axis=-1)
    return points_C @ X_WC.rotation().T + np.array(X_WC.p), depth


def _box(cluster: _Cluster, name: str) -> Obstacle:
    x, y = cluster.centre.tolist()
    dx, dy = (cluster.high - cluster.low + 2.0 * PADDING_M).tolist()
    shape = Shape(
        kind="box", size_m=(dx, dy, HEIGHT_M), X_BodyShape=SE3((0.0, 0.0, 0.5 * HEIGHT_M))
    )
    return Obstacle(
        id=f"{name}_{cluster.number}",
        name="something in the way",
        X_WO=SE3((x, y, 0.0)),
        shapes=(shape,),
        movable=True,
    )
