"""How far every point of the floor is from anything that stands, or hangs low, over it."""

from __future__ import annotations

import math

import numpy as np

from robot.planning import numerics
from robot.planning.floor_field import CELL_M, field_of, outermost, signed
from robot.planning.numerics import Indices, Mask
from robot.planning.solids import Solid
from robot.se3 import Array

WAY_CELLS = 2
"""Lengths of ways are reckoned on a coarser grid: three cells fit in a doorway's middle."""
LEAVE_M = 1.0
"""A place too near furniture to turn in is left by no more than that [m]."""
LOWEST_M, HIGHEST_M = 0.03, 1.35
"""Solids outside of this range of heights are walked over or under [m]."""


class Floor:
    """Signed distance to the solids' outlines on a grid over the bounds, negative inside them.

    The distances are exact at the grid's points (solids count as upright boxes and cylinders; a
    tilted one counts as its bounding box); the bounds' edge counts as a wall.

    Attributes:
        bounds_m: of the floor.
        solids: on it.
        field: the distances [m], shape (rows, columns): y and x from the bounds' low corner.
    """

    def __init__(
        self, solids: tuple[Solid, ...], bounds_m: tuple[float, float, float, float]
    ) -> None:
        """Measure the distances; some 20 ms a home the first time, less what is as it was."""
        self.bounds_m = bounds_m
        self.solids = tuple(s for s in solids if _in_the_way(s))
        self._x0, self._y0 = bounds_m[0], bounds_m[1]
        self.field, self._rows = field_of(outermost(self.solids), bounds_m)
        self._height, self._width = self.field.shape

    def clearance_m(self, x_m: float, y_m: float) -> float:
        """Distance of a point to the nearest solid or the edge of the map, interpolated [m]."""
        u, v = (x_m - self._x0) / CELL_M, (y_m - self._y0) / CELL_M
        i, j = math.floor(u), math.floor(v)
        if i < 0 or j < 0 or i >= self._width - 1 or j >= self._height - 1:
            return -1.0
        a, b = u - i, v - j
        low, high = self._rows[j], self._rows[j + 1]
        return (1 - b) * ((1 - a) * low[i] + a * low[i + 1]) + b * (
            (1 - a) * high[i] + a * high[i + 1]
        )

    def clearances_m(self, xy: Array) -> Array:
        """The same for many points, shape (n, 2) to (n,)."""
        return numerics.grid_values(self.field, self._rows_columns(xy), outside=-1.0)

    def row_column(self, point: Array) -> Array:
        """Where a point is on the grid, shape (2,) to (2,), in cells."""
        return np.array([point[1] - self._y0, point[0] - self._x0]) / CELL_M

    def points(self, rows_columns: Indices) -> Array:
        """The points [m] of cells, shape (n, 2) to (n, 2)."""
        return np.array([self._x0, self._y0]) + CELL_M * rows_columns[:, ::-1].astype(np.float64)

    def _rows_columns(self, xy: Array) -> tuple[Array, Array]:
        return (xy[:, 1] - self._y0) / CELL_M, (xy[:, 0] - self._x0) / CELL_M

    def segment_clearance_m(self, a: tuple[float, float], b: tuple[float, float]) -> float:
        """Least clearance on the straight line from a to b [m]."""
        count = max(2, math.ceil(math.hypot(b[0] - a[0], b[1] - a[1]) / (0.5 * CELL_M)) + 1)
        share = numerics.even(0.0, 1.0, count)[:, None]
        return float(np.min(self.clearances_m((1 - share) * np.array(a) + share * np.array(b))))

    def regions(self, clearance_m: float) -> Indices:
        """Label of every cell's connected free region (0: not free), shape of the grid."""
        return numerics.regions(self.field >= clearance_m)

    def label_at(self, labels: Indices, xy: Array) -> Indices:
        """Labels of the cells nearest to points, shape (n, 2) to (n,); 0 outside."""
        column = np.rint((xy[:, 0] - self._x0) / CELL_M).astype(int)
        row = np.rint((xy[:, 1] - self._y0) / CELL_M).astype(int)
        inside = (column >= 0) & (row >= 0) & (column < self._width) & (row < self._height)
        found = labels[np.clip(row, 0, self._height - 1), np.clip(column, 0, self._width - 1)]
        return np.where(inside, found, 0)

    def distance_to_m(self, mask: Mask, xy: Array) -> Array:
        """Distance of points, shape (n, 2), to the nearest cell of a mask of the grid [m], (n,)."""
        if not mask.any():
            return np.zeros(len(xy))
        far = CELL_M * numerics.distance_to(mask)
        return numerics.grid_values(far, self._rows_columns(xy), outside=None)

    def ways_m(self, x_m: float, y_m: float, *, radius_m: float) -> Ways:
        """How far it is to walk from a point to everywhere that keeps `radius_m` clear."""
        step = slice(None, None, WAY_CELLS)
        free = self.field[step, step] >= radius_m
        height, width = free.shape
        cell_m = WAY_CELLS * CELL_M
        rows, columns = np.nonzero(free)
        x, y = self._x0 + cell_m * columns, self._y0 + cell_m * rows
        away_m = np.hypot(x - x_m, y - y_m)
        lengths = np.full((height, width), np.inf)
        if len(away_m) and away_m.min() <= LEAVE_M:
            nearest = int(np.argmin(away_m))
            start = (int(rows[nearest]), int(columns[nearest]))
            lengths = (
                cell_m * numerics.cheapest_ways(np.where(free, 1.0, np.inf), 1, start)[0]
                + away_m[nearest]
            )
        return Ways(lengths, (self._x0, self._y0), cell_m)

    def home(self, labels: Indices, x_m: float, y_m: float) -> int:
        """Label of the free region nearest to a point, within 1 m (0: none)."""
        angles = np.arange(24) * (2 * math.pi / 24)
        circle = np.stack([np.cos(angles), np.sin(angles)], axis=1)
        for radius in np.arange(0.0, 1.01, 0.1).tolist():
            found = self.label_at(labels, radius * circle + (x_m, y_m))
            if found.any():
                return int(found[found > 0][0])
        return 0

    def nearest(self, x_m: float, y_m: float) -> tuple[str, float]:
        """The solid nearest to a point and its distance [m] ("the edge of the map", if that is)."""
        best = ("the edge of the map", self._edge(x_m, y_m))
        for solid in self.solids:
            distance = self.distance_m(solid, x_m, y_m)
            if distance < best[1]:
                best = (solid.id, distance)
        return best

    @staticmethod
    def distance_m(solid: Solid, x_m: float, y_m: float) -> float:
        """Signed distance of a point to one solid's outline [m]."""
        return float(signed(solid, np.array([[x_m]]), np.array([[y_m]]))[0, 0])

    def _edge(self, x_m: float, y_m: float) -> float:
        x0, y0, x1, y1 = self.bounds_m
        return min(x_m - x0, x1 - x_m, y_m - y0, y1 - y_m)


class Ways:
    """Lengths of the ways from one point to all others, around what stands there."""

    def __init__(self, lengths_m: Array, corner_m: tuple[float, float], cell_m: float) -> None:
        self._lengths_m, self._corner_m, self._cell_m = lengths_m, corner_m, cell_m

    def lengths_m(self, xy: Array) -> Array:
        """To points, shape (n, 2) to (n,); inf where none leads."""
        column, row = np.rint((xy - np.array(self._corner_m)) / self._cell_m).astype(int).T
        height, width = self._lengths_m.shape
        inside = (column >= 0) & (row >= 0) & (column < width) & (row < height)
        found = self._lengths_m[np.clip(row, 0, height - 1), np.clip(column, 0, width - 1)]
        return np.where(inside, found, np.inf)


def with_room(
    bounds_m: tuple[float, float, float, float], x_m: float, y_m: float, *, radius_m: float
) -> tuple[float, float, float, float]:
    """The bounds, wider where one of this radius stands at their edge or beyond.

    A robot that rolled over there on the floor must have a way back in.
    """
    x0, y0, x1, y1 = bounds_m
    if min(x_m - x0, x1 - x_m, y_m - y0, y1 - y_m) >= radius_m:
        return bounds_m
    room_m = 2.0 * radius_m
    return (
        min(x0, x_m - room_m), min(y0, y_m - room_m), max(x1, x_m + room_m), max(y1, y_m + room_m),
    )  # fmt: skip


def _in_the_way(solid: Solid) -> bool:
    low, high = solid.z_range_m()
    return low < HIGHEST_M and high > LOWEST_M
