"""What the map explains: points in, or at the surface of, what it says stands there.

What is on a table or between the boards of a shelf is a thing: nobody is where furniture is.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from robot.messages import Obstacle, Place
from robot.se3 import Array

NEAR_M, NEAR_SHARE = 0.10, 0.03
"""How far beside a solid a point of it may be measured: by the pose, and the heading at a range."""
ABOVE_M, ABOVE_SHARE = 0.07, 0.02
CHUNK = 4096
SEAT_M = 0.55
"""Nobody stands, sits or lies on what is higher, as on beds, sofas and chairs. A tea box in a
bookcase was somebody who stood in it, and the hand that reached for it waited for them."""
OVER_M, WITHIN_M = 0.05, 0.02
"""What is over a surface: no lower than that below it, and so far inside its edges."""


class MappedSolids:
    """The solids of a map as upright boxes, and what of it people put things on."""

    def __init__(self, obstacles: Iterable[Obstacle] = (), places: Iterable[Place] = ()) -> None:
        """Take what stands fast.

        Args:
            obstacles: of the map; people on it do not stand fast, and are not to be among them.
            places: its surfaces.
        """
        rows: list[tuple[float, ...]] = []
        for obstacle in obstacles:
            for shape in obstacle.shapes:
                X_WS = obstacle.X_WO @ shape.X_BodyShape
                half = 0.5 * np.array(shape.size_m)
                high_m = float(np.abs(X_WS.rotation()[2]) @ half)
                yaw_rad = X_WS.yaw_rad
                rows.append((*X_WS.p, np.cos(yaw_rad), np.sin(yaw_rad), half[0], half[1], high_m))
        self._boxes = np.array(rows, dtype=np.float64).reshape(-1, 8)
        self._tops = [one for one in places if not one.floor and one.X_WP.p[2] > SEAT_M]

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
        for top in self._tops:
            found &= ~_over(top, points)
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


def _over(top: Place, points: Array) -> NDArray[np.bool_]:
    """Which points, shape (n, 3), are over a surface."""
    off = (points - np.array(top.X_WP.p)) @ top.X_WP.rotation()
    half_x, half_y = 0.5 * top.size_m[0] - WITHIN_M, 0.5 * top.size_m[1] - WITHIN_M
    over = (np.abs(off[:, 0]) < half_x) & (np.abs(off[:, 1]) < half_y) & (off[:, 2] > -OVER_M)
    return np.asarray(over, np.bool_)
