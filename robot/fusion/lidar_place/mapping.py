"""A map out of a walk: what the lidar saw on it and what the legs said, and nothing else.

The walk begins at a pose that is known (where the robot is set down), which gives the map its
frame; `laid_on` moves it onto what people told of the building, three numbers in all, so that "the
shelf" is where they say it is.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

import numpy as np

from robot.fusion.lidar_place.levelled import Levelled
from robot.fusion.slam.front_end import LOST, FrontEnd
from robot.fusion.slam.grid import occupancy
from robot.fusion.slam.map_file import SURFACE_M, SavedMap
from robot.fusion.slam.mapper import Mapper
from robot.fusion.slam.matching import match
from robot.fusion.slam.patch import Patch
from robot.fusion.slam.planar import compose, inverse, placed, turn
from robot.fusion.slam.scan import Scan
from robot.messages import Obstacle
from robot.se3 import Array

LEGS_SLIP = 0.5
"""Legs, an IMU and a filter of both err about half as much as the wheels the front end was made
for; with that it stays within 11 mm of the truth on a job in a kitchen, and without leaps."""
UPRIGHT_RAD = np.radians(8.0)
"""A scan of a lidar that leans more than this is left out."""
SEEN = 3
"""Times that a cell of a surface has to be hit to be kept."""
SAME_WAY = 0.7
"""Least length of the mean of a cell's normals: less is an edge, or clutter."""
STEP_M = 0.05
ENOUGH = 0.5
"""A map of which less lies on what was told stays where the start put it."""


def walked_map(
    sweeps: Sequence[Levelled],
    stamps_s: Sequence[float],
    start: Array,
    *,
    told: Patch | None = None,
    progress: Callable[[int], None] = lambda _done: None,
) -> SavedMap:
    """SLAM over the scans of a walk.

    Args:
        sweeps: in the order of the walk; those of a lidar that leans are left out.
        stamps_s: theirs.
        start: x, y, heading of the first one's lidar in the map's frame.
        told: the outlines of what people told of the building, to lay the map on.
        progress: told after each how many are done.

    Raises:
        ValueError: there is no scan of a level lidar.
    """
    level = [i for i, sweep in enumerate(sweeps) if sweep.tilt_rad < UPRIGHT_RAD]
    if not level:
        raise ValueError("no scan of a level lidar")
    mapper = Mapper(front=FrontEnd(slip=LEGS_SLIP, fits=LOST))
    for done, index in enumerate(level):
        mapper.add(sweeps[index].scan, sweeps[index].odometry)
        progress(done + 1)
    mapper.finish()
    way = mapper.trajectory()
    origin = compose(start, inverse(way[0]))
    scans = [sweeps[index].scan for index in level]
    if told is not None:
        surface = averaged_surface(scans, compose(origin, way))
        origin = compose(laid_on(surface, told), origin)
    way, keys = compose(origin, way), compose(origin, mapper.poses)
    return SavedMap(
        grid=occupancy(mapper.scans, keys),
        trajectory=np.column_stack([[stamps_s[index] for index in level], way]),
        keys=keys,
        surface=averaged_surface(scans, way),
        places={"start": way[0], "end": way[-1]},
        height_m=float(np.median([sweeps[index].height_m for index in level])),
    )


def averaged_surface(scans: Sequence[Scan], poses: Array) -> Array:
    """Points, normals and spans by cells, each the mean of all that was seen of it, shape (p, 5).

    One sweep errs by 2 cm a beam; a map to localise in by millimetres needs the mean of many.
    """
    parts: list[Array] = []
    for scan, pose in zip(scans, poses, strict=True):
        if len(scan.points):
            facing = np.einsum("ij,ij->i", scan.normals, scan.points) < 0.0
            normals = np.where(facing[:, None], scan.normals, -scan.normals)
            normals = normals @ turn(float(pose[2]))
            points = placed(pose, scan.points)
            parts.append(np.column_stack([points, normals, scan.spans_m]))
    everything = np.concatenate(parts)
    everything = everything[np.any(everything[:, 2:4] != 0.0, axis=1)]
    cells = np.floor(everything[:, :2] / SURFACE_M).astype(np.int64)
    _, number, count = np.unique(cells, axis=0, return_inverse=True, return_counts=True)
    number = number.reshape(-1)
    sums = np.zeros((len(count), 5))
    np.add.at(sums, number, everything)
    mean = sums / count[:, None]
    length = np.hypot(mean[:, 2], mean[:, 3])
    mean[:, 2:4] /= np.maximum(length, 1e-9)[:, None]
    kept = (count >= SEEN) & (length > SAME_WAY)
    return mean[kept] if kept.any() else mean[length > 1e-6]


def laid_on(surface: Array, told: Patch) -> Array:
    """By which pose (3,) a surface has to be moved to lie on what was told; none if it does not."""
    found = match(told, surface[:, :2], surface[:, 2:4], np.zeros(3))
    return found.pose if found.fit >= ENOUGH else np.zeros(3)


def told_outlines(obstacles: Iterable[Obstacle], height_m: float) -> Patch | None:
    """The sides of furniture and walls, where a plane at a height cuts them; None without any."""
    rows: list[Array] = []
    for obstacle in obstacles:
        for shape in obstacle.shapes:
            X_WS = obstacle.X_WO @ shape.X_BodyShape
            depth_m, width_m, high_m = shape.size_m
            if abs(X_WS.p[2] - height_m) < 0.5 * high_m and shape.kind == "box":
                pose = np.array([X_WS.p[0], X_WS.p[1], X_WS.yaw_rad])
                rows += [_side(pose, depth_m, width_m, quarter) for quarter in range(4)]
    if not rows:
        return None
    points = np.concatenate(rows)
    return Patch(points[:, :2], points[:, 2:4], np.full(len(points), 0.5 * STEP_M))


def _side(pose: Array, depth_m: float, width_m: float, quarter: int) -> Array:
    """Points and normals, shape (n, 4), along one of the four sides of a rectangle at a pose."""
    out_m, half_m = (depth_m, width_m) if quarter % 2 == 0 else (width_m, depth_m)
    along = np.arange(-0.5 * half_m, 0.5 * half_m + 1e-9, STEP_M)
    local = np.column_stack([np.full(len(along), 0.5 * out_m), along])
    faced = compose(pose, np.array([0.0, 0.0, 0.5 * np.pi * quarter]))
    normal = np.array([np.cos(faced[2]), np.sin(faced[2])])
    return np.column_stack([placed(faced, local), np.tile(normal, (len(along), 1))])
