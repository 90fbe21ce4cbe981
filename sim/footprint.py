"""Rectangles and circles on the floor: do they overlap, how far apart are they."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import msgspec
import numpy as np

Point = tuple[float, float]


def overlapping(footprints: Sequence[Footprint]) -> Iterator[tuple[int, int]]:
    """Pairs (i, j), i > j, of those that share more than a touch, in the order of i, then of j.

    The exact test is made only where the boxes around two of them meet.
    """
    if not footprints:
        return
    x_min, y_min, x_max, y_max = np.array([footprint.box_m for footprint in footprints]).T
    for i, footprint in enumerate(footprints):
        meets = (
            (x_min[:i] <= x_max[i]) & (x_max[:i] >= x_min[i])
            & (y_min[:i] <= y_max[i]) & (y_max[:i] >= y_min[i])
        )  # fmt: skip
        for j in np.flatnonzero(meets).tolist():
            if footprint.overlaps(footprints[j]):
                yield i, j


class Footprint(msgspec.Struct, frozen=True):
    """A turned rectangle seen from above: middle, half extents along its own axes, heading."""

    middle: Point
    half_m: tuple[float, float]
    yaw_rad: float = 0.0

    def local(self, point: Point) -> Point:
        """A point in the rectangle's own axes."""
        dx, dy = point[0] - self.middle[0], point[1] - self.middle[1]
        c, s = math.cos(self.yaw_rad), math.sin(self.yaw_rad)
        return (c * dx + s * dy, c * dy - s * dx)

    def corners(self) -> list[Point]:
        """The four corners, in order around the rectangle."""
        c, s = math.cos(self.yaw_rad), math.sin(self.yaw_rad)
        a, b = self.half_m
        signs = ((a, b), (-a, b), (-a, -b), (a, -b))
        x, y = self.middle
        return [(x + c * u - s * v, y + s * u + c * v) for u, v in signs]

    @property
    def box_m(self) -> tuple[float, float, float, float]:
        """The smallest rectangle along the axes around it: x_min, y_min, x_max, y_max."""
        c, s = abs(math.cos(self.yaw_rad)), abs(math.sin(self.yaw_rad))
        a, b = self.half_m
        x, y = self.middle
        dx, dy = c * a + s * b, s * a + c * b
        return (x - dx, y - dy, x + dx, y + dy)

    def distance_m(self, point: Point) -> float:
        """From a point to the rectangle, 0 inside."""
        u, v = self.local(point)
        return math.hypot(max(abs(u) - self.half_m[0], 0.0), max(abs(v) - self.half_m[1], 0.0))

    def contains(self, other: Footprint, *, slack_m: float = 1e-6) -> bool:
        """Whether another rectangle lies inside this one."""
        a, b = self.half_m[0] + slack_m, self.half_m[1] + slack_m
        local = [self.local(corner) for corner in other.corners()]
        return all(abs(u) <= a and abs(v) <= b for u, v in local)

    def overlaps(self, other: Footprint, *, slack_m: float = 1e-3) -> bool:
        """Whether two rectangles share more than a touch (separating axis theorem)."""
        return not (self._separates(other, slack_m) or other._separates(self, slack_m))

    def _separates(self, other: Footprint, slack_m: float) -> bool:
        local = [self.local(corner) for corner in other.corners()]
        for axis in (0, 1):
            low, high = min(p[axis] for p in local), max(p[axis] for p in local)
            if low > self.half_m[axis] - slack_m or high < slack_m - self.half_m[axis]:
                return True
        return False
