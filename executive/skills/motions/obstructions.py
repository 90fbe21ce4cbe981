"""What stands in the way: things the lidar sees that the map does not explain."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import msgspec

from robot.messages import Obstacle, Shape
from robot.se3 import SE3

Point2 = tuple[float, float]

EVERY_M = 0.04
"""Of points on a line: half as far as the thinnest wall is thick."""


def in_the_way(
    points_m: Sequence[Point2], obstacles: Iterable[Obstacle], *, radius_m: float
) -> Obstacle | None:
    """The first obstacle nearer than `radius_m` to points of the path ahead, in W."""
    for point in points_m:
        for obstacle in obstacles:
            if clearance_m(point, obstacle) < radius_m:
                return obstacle
    return None


def between(
    a_m: Point2, b_m: Point2, things: Iterable[Obstacle], *, height_m: float
) -> Obstacle | None:
    """What of some things stands between two points of the floor and reaches up to a height."""
    count = 1 + math.ceil(math.dist(a_m, b_m) / EVERY_M)
    line = [
        (a_m[0] + i / count * (b_m[0] - a_m[0]), a_m[1] + i / count * (b_m[1] - a_m[1]))
        for i in range(count + 1)
    ]
    for thing in things:
        high = [s for s in thing.shapes if _top_m(thing.X_WO @ s.X_BodyShape, s) > height_m]
        tall = msgspec.structs.replace(thing, shapes=tuple(high))
        if any(clearance_m(point, tall) <= 0.0 for point in line):
            return thing
    return None


def clearance_m(point: Point2, obstacle: Obstacle) -> float:
    """Distance on the floor from a point to an obstacle's outline, 0 inside it."""
    return min(
        (_outside_m(point, obstacle.X_WO @ s.X_BodyShape, s.size_m) for s in obstacle.shapes),
        default=math.inf,
    )


def may_step(here: Point2, there: Point2, things: Iterable[Obstacle], *, radius_m: float) -> bool:
    """Whether the body has its radius free at a point, or no less than where it stands now."""
    return all(
        clearance_m(there, thing) >= min(radius_m, clearance_m(here, thing)) for thing in things
    )


def _outside_m(point: Point2, X_WA: SE3, size_m: tuple[float, float, float]) -> float:
    """Distance from a point to the rectangle under a shape (a cylinder counts as its square)."""
    dx, dy = point[0] - X_WA.p[0], point[1] - X_WA.p[1]
    c, s = math.cos(X_WA.yaw_rad), math.sin(X_WA.yaw_rad)
    x_m, y_m = abs(c * dx + s * dy), abs(c * dy - s * dx)
    return math.hypot(max(0.0, x_m - 0.5 * size_m[0]), max(0.0, y_m - 0.5 * size_m[1]))


def _top_m(X_WA: SE3, shape: Shape) -> float:
    """How high a shape reaches, standing upright."""
    return X_WA.p[2] + 0.5 * shape.size_m[2]
