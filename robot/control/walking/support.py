"""The support polygon, and points kept inside it."""

from __future__ import annotations

import math

from robot.control.walking.footsteps import Sole

Point = tuple[float, float]


class SupportPolygon:
    """Convex hull of planted soles shrunk by a margin; half planes a x + b y + c <= 0."""

    def __init__(
        self, soles: list[Sole], half_length_m: float, half_width_m: float, *, margin_m: float = 0.0
    ) -> None:
        """Corners of every sole, hulled."""
        corners: list[Point] = []
        lx, ly = half_length_m - margin_m, half_width_m - margin_m
        for sole in soles:
            c, s = math.cos(sole.yaw), math.sin(sole.yaw)
            for x, y in ((lx, ly), (lx, -ly), (-lx, -ly), (-lx, ly)):
                corners.append((sole.x + c * x - s * y, sole.y + s * x + c * y))
        self.vertices: list[Point] = convex_hull(corners)
        n = len(self.vertices)
        edges = [(self.vertices[i], self.vertices[(i + 1) % n]) for i in range(n)]
        self.planes = [_outside(start, end) for start, end in edges]

    def margin_m(self, point: Point) -> float:
        """Distance to the nearest edge, positive inside."""
        x, y = point
        return -max(a * x + b * y + c for a, b, c in self.planes)

    def clip(self, point: Point, *, beyond_m: float = 0.0) -> Point:
        """The nearest point inside, or as far towards `point` from there as may be."""
        x, y = point
        if all(a * x + b * y + c <= 1e-9 for a, b, c in self.planes):
            return point
        best, best_d2 = point, math.inf
        n = len(self.vertices)
        for i in range(n):
            (x0, y0), (x1, y1) = self.vertices[i], self.vertices[(i + 1) % n]
            ex, ey = x1 - x0, y1 - y0
            t = max(0.0, min(1.0, ((x - x0) * ex + (y - y0) * ey) / (ex * ex + ey * ey)))
            px, py = x0 + t * ex, y0 + t * ey
            d2 = (px - x) ** 2 + (py - y) ** 2
            if d2 < best_d2:
                best, best_d2 = (px, py), d2
        share = min(1.0, beyond_m / math.sqrt(best_d2))
        return best[0] + share * (x - best[0]), best[1] + share * (y - best[1])


def convex_hull(points: list[Point]) -> list[Point]:
    """Corners counter-clockwise (Andrew's monotone chain, 1979; scipy takes long to load)."""
    ordered = sorted(set(points))
    hull: list[Point] = []
    for chain in (ordered, ordered[::-1]):
        base = len(hull)
        for point in chain:
            while len(hull) >= base + 2 and _turn(hull[-2], hull[-1], point) <= 0.0:
                hull.pop()
            hull.append(point)
        hull.pop()
    return hull


def _turn(a: Point, b: Point, c: Point) -> float:
    """Positive where a, b, c turn left."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _outside(start: Point, end: Point) -> tuple[float, float, float]:
    """Half plane a x + b y + c <= 0 left of an edge, with a unit normal."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    length = math.hypot(dx, dy)
    a, b = dy / length, -dx / length
    return a, b, -(a * start[0] + b * start[1])
