"""What the map explains: points in, or at the surface of, what it says stands there."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from robot.messages import Obstacle
from robot.se3 import Array

NEAR_M, NEAR_SHARE = 0.10, 0.03
"""How far beside a solid a point of it may be measured: by the pose, and the heading at a range."""
ABOVE_M, ABOVE_SHARE = 0.07, 0.02
CHUNK = 4096


class MappedSolids:
    """The solids of a map as upright boxes."""

    def __init__(self, obstacles: Iterable[Obstacle] = ()) -> None:
        """Take the obstacles; people on the map do not stand fast, and are not to be among them."""
        rows: list[tuple[float, ...]] = []
        for obstacle in obstacles:
            for shape in obstacle.shapes:
                X_WS = obstacle.X_WO @ shape.X_BodyShape
                half = 0.5 * np.array(shape.size_m)
                high_m = float(np.abs(X_WS.rotation()[2]) @ half)
                yaw_rad = X_WS.yaw_rad
                rows.append((*X_WS.p, np.cos(yaw_rad), np.sin(yaw_rad), half[0], half[1], high_m))
        self._boxes = np.array(rows, dtype=np.float64).reshape(-1, 8)

    def strange(self, points: Array, ranges_m: Array) -> NDArray[np.bool_]:
        """Which points are of none of them.

        Args:
            points: in W [m], shape (n, 3).
            ranges_m: how far from the sensor each is, shape (n,).
        """
        found = np.ones(len(points), dtype=bool)
        for begin in range(0, len(points), CHUNK):
            part = slice(begin, begin + CHUNK)
            found[part] = self._strange(points[part], ranges_m[part])
        return found

    def apart(self, points: Array, margin_m: float) -> NDArray[np.bool_]:
        """Which points, shape (n, 3), are further than that beside all of them."""
        return self._outside(points, np.full(len(points), margin_m), np.zeros(len(points)))

    def _strange(self, points: Array, ranges_m: Array) -> NDArray[np.bool_]:
        beside_m, above_m = NEAR_M + NEAR_SHARE * ranges_m, ABOVE_M + ABOVE_SHARE * ranges_m
        return self._outside(points, beside_m, above_m)

    def _outside(self, points: Array, margin_m: Array, above_m: Array) -> NDArray[np.bool_]:
        boxes = self._near(points, float(margin_m.max(initial=0.0)))
        x, y, z, c, s, half_x, half_y, half_z = (column[None, :] for column in boxes.T)
        dx, dy, dz = points[:, 0:1] - x, points[:, 1:2] - y, points[:, 2:3] - z
        margin = margin_m[:, None]
        inside = np.abs(c * dx + s * dy) <= half_x + margin
        inside &= np.abs(c * dy - s * dx) <= half_y + margin
        inside &= np.abs(dz) <= half_z + above_m[:, None]
        return ~inside.any(axis=1)

    def _near(self, points: Array, margin_m: float) -> Array:
        """The boxes that any of these points can be of."""
        if not len(points) or not len(self._boxes):
            return self._boxes[:0]
        reach_m = np.hypot(self._boxes[:, 5], self._boxes[:, 6])[:, None] + 1.5 * margin_m
        low, high = points[:, :2].min(axis=0), points[:, :2].max(axis=0)
        at = self._boxes[:, :2]
        return self._boxes[((at > low - reach_m) & (at < high + reach_m)).all(axis=1)]
