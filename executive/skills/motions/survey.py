"""What has been looked over and what has not: points of surfaces and floor, and views of them.

Only geometry: no waiting, no link. A view is a cone about the line of sight; that something stands
between is not reckoned with, so places are gone to in the end.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from robot.messages import Place
from robot.se3 import SE3, Vector3, wrap_angle

SIGHT_M = 3.0
CONE_RAD = 0.45
HEAD_RAD = 1.0
"""How far the head is turned to a side."""
EYE_M = 1.2
HEADINGS = 8
GRID = ((0.0, 0.0), (0.35, 0.35), (0.35, -0.35), (-0.35, -0.35), (-0.35, 0.35))
AROUND_M = ((0.0, 0.0), (0.5, 0.0), (-0.5, 0.0), (0.0, 0.5), (0.0, -0.5))
FLOOR_M = 0.05


class Survey:
    """Points still to be looked at."""

    def __init__(self, places: Iterable[Place], fallen_from: Vector3 | None = None) -> None:
        """Points over every place, and on the floor around where something may have fallen from."""
        points: list[Vector3] = []
        self._owners: list[str] = []
        for place in places:
            for part_x, part_y in GRID:
                at = (part_x * place.size_m[0], part_y * place.size_m[1], 0.0)
                x, y, z = (float(value) for value in place.X_WP.apply(at))
                points.append((x, y, z))
                self._owners.append(place.id)
        for dx, dy in AROUND_M if fallen_from is not None else ():
            assert fallen_from is not None
            points.append((fallen_from[0] + dx, fallen_from[1] + dy, FLOOR_M))
            self._owners.append("")
        self._points = np.array(points).reshape(-1, 3)
        self._left = np.ones(len(points), dtype=bool)

    def next_point(self, X_WS: SE3) -> Vector3 | None:
        """Where to look from a stance without turning: where most is left to be seen, if any."""
        here = self._in_reach(X_WS, X_WS.yaw_rad)
        if not here.any():
            return None
        rows = np.flatnonzero(here)
        counts = [int(np.count_nonzero(here & self._in_cone(X_WS, self._points[i]))) for i in rows]
        x, y, z = self._points[rows[int(np.argmax(counts))]].tolist()
        return (x, y, z)

    def look(self, X_WS: SE3, p_W: Sequence[float]) -> None:
        """Note that the eyes have rested on a point, from a stance."""
        near = np.linalg.norm(self._points - _eye(X_WS), axis=1) < SIGHT_M
        self._left &= ~(near & self._in_cone(X_WS, np.array(p_W)))

    def heading(self, X_WS: SE3) -> float | None:
        """The heading from which most is left to be seen here; None if nothing is."""
        yaws = [X_WS.yaw_rad + 2.0 * math.pi * k / HEADINGS for k in range(HEADINGS)]
        counts = [int(np.count_nonzero(self._in_reach(X_WS, yaw))) for yaw in yaws]
        best = int(np.argmax(counts))
        return wrap_angle(yaws[best]) if counts[best] else None

    def left_at(self, place_id: str) -> int:
        """How many points of a place have not been looked at."""
        owned = np.array([owner == place_id for owner in self._owners])
        return int(np.count_nonzero(self._left & owned))

    def again(self, place_id: str) -> None:
        """Look over a place once more, from nearby."""
        self._left |= np.array([owner == place_id for owner in self._owners], dtype=bool)

    def _in_reach(self, X_WS: SE3, yaw_rad: float) -> NDArray[np.bool_]:
        """Which points left are near enough and within the head's turn, shape (n,)."""
        off = self._points - _eye(X_WS)
        aside = np.arctan2(off[:, 1], off[:, 0]) - yaw_rad
        aside = np.abs((aside + math.pi) % (2.0 * math.pi) - math.pi)
        return self._left & (np.linalg.norm(off, axis=1) < SIGHT_M) & (aside < HEAD_RAD)

    def _in_cone(self, X_WS: SE3, p_W: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Which points are near the line of sight to a point, shape (n,)."""
        eye = _eye(X_WS)
        off, line = self._points - eye, p_W - eye
        cos = off @ line / np.maximum(np.linalg.norm(off, axis=1) * np.linalg.norm(line), 1e-9)
        return cos > math.cos(CONE_RAD)


def _eye(X_WS: SE3) -> NDArray[np.float64]:
    return np.array([X_WS.p[0], X_WS.p[1], EYE_M])
