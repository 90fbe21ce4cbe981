"""How far every point of the floor is from anything that stands, or hangs low, over it."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np

from robot.planning import numerics
from robot.planning.numerics import Indices, Mask
from robot.planning.solids import Solid
from robot.se3 import Array

CELL_M = 0.04
WAY_CELLS = 2
"""Lengths of ways are reckoned on a coarser grid: three cells fit in a doorway's middle."""
LEAVE_M = 1.0
"""A place too near furniture to turn in is left by no more than that [m]."""
LOWEST_M, HIGHEST_M = 0.03, 1.35
"""Solids outside of this range of heights are walked over or under [m]."""
UPRIGHT = 0.999
"""Cosine of the tilt up to which a solid stands upright."""
LARGE_M = 1.5
"""Walls and sideboards fill a home: no point is farther than some metres from one of them, and what
is smaller (tables, chairs, people) is measured so far only."""
WITHIN_M = 1e-6
"""What lies so far within another is never the nearest, however the sums are rounded."""


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
        """Measure the distances; about 1 ms a solid the first time, then remembered."""
        self.bounds_m = bounds_m
        self.solids = tuple(s for s in solids if _in_the_way(s))
        self._x0, self._y0 = bounds_m[0], bounds_m[1]
        self.field, self._rows = _field(_outermost(self.solids), bounds_m)
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
        return float(_signed(solid, np.array([[x_m]]), np.array([[y_m]]))[0, 0])

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


def _grid(bounds_m: tuple[float, float, float, float]) -> tuple[Array, Array]:
    x0, y0, x1, y1 = bounds_m
    columns, rows = math.ceil((x1 - x0) / CELL_M), math.ceil((y1 - y0) / CELL_M)
    xs = x0 + numerics.even(0.0, CELL_M * columns, columns + 1)
    ys = y0 + numerics.even(0.0, CELL_M * rows, rows + 1)
    return xs[None, :], ys[:, None]


@lru_cache(maxsize=8)
def _edge_distance(bounds_m: tuple[float, float, float, float]) -> Array:
    xs, ys = _grid(bounds_m)
    x0, y0, x1, y1 = bounds_m
    return np.minimum(np.minimum(xs - x0, x1 - xs), np.minimum(ys - y0, y1 - ys))


def _outermost(solids: tuple[Solid, ...]) -> tuple[Solid, ...]:
    """The solids whose outlines lie within no other's: only they can be nearest to anything.

    What lies on a table is within the table, so a home of 300 things costs little more than an
    empty one, and the same field serves whatever is seen on its surfaces.
    """
    upright = [abs(s.X_WG.rotation()[2, 2]) > UPRIGHT for s in solids]
    hosts = [n for n, s in enumerate(solids) if s.kind == "box" and upright[n]]
    if not hosts:
        return solids
    outlines = np.array([_outline(s) for s in solids])
    inside = np.zeros(len(solids), dtype=bool)
    for number in hosts:
        host = solids[number]
        far = _signed(host, outlines[..., 0], outlines[..., 1]).max(axis=1)
        inside |= far < -WITHIN_M
    return tuple(s for s, within in zip(solids, inside, strict=True) if not within)


def _outline(solid: Solid) -> Array:
    """Corners of the upright rectangle around a solid's outline, shape (4, 2)."""
    corners = np.array([(1.0, 1.0), (1.0, -1.0), (-1.0, -1.0), (-1.0, 1.0)])
    rotation = solid.X_WG.rotation()
    at = np.array(solid.X_WG.p[:2])
    if abs(rotation[2, 2]) > UPRIGHT:
        return at + (corners * 0.5 * np.array(solid.size_m[:2])) @ rotation[:2, :2].T
    return at + corners * solid.half_extents_m()[:2]


@lru_cache(maxsize=8)
def _field(
    solids: tuple[Solid, ...], bounds_m: tuple[float, float, float, float]
) -> tuple[Array, list[list[float]]]:
    """The distances on the grid, as an array that nobody changes and as rows."""
    field = _edge_distance(bounds_m).copy()
    is_large = [max(solid.size_m[:2]) > LARGE_M for solid in solids]
    for solid, large in zip(solids, is_large, strict=True):
        if large:
            np.minimum(field, _solid_distance(solid, bounds_m), out=field)
    reach_m = math.ceil(float(field.max()))  # farther off, something large is nearer
    for solid, large in zip(solids, is_large, strict=True):
        if not large:
            around, distances = _distance_around(solid, bounds_m, reach_m)
            np.minimum(field[around], distances, out=field[around])
    field.flags.writeable = False
    return field, field.tolist()


@lru_cache(maxsize=512)
def _solid_distance(solid: Solid, bounds_m: tuple[float, float, float, float]) -> Array:
    return _signed(solid, *_grid(bounds_m))


@lru_cache(maxsize=512)
def _distance_around(
    solid: Solid, bounds_m: tuple[float, float, float, float], reach_m: int
) -> tuple[tuple[slice, slice], Array]:
    """Distances to a solid on the part of the grid that is no farther from it than `reach_m`."""
    xs, ys = _grid(bounds_m)
    x, y = (float(at) for at in solid.X_WG.p[:2])
    far_x, far_y = (solid.half_extents_m()[:2] + reach_m + CELL_M).tolist()
    columns = slice(*np.searchsorted(xs[0], (x - far_x, x + far_x)).tolist())
    rows = slice(*np.searchsorted(ys[:, 0], (y - far_y, y + far_y)).tolist())
    return (rows, columns), _signed(solid, xs[:, columns], ys[rows])


def _signed(solid: Solid, xs: Array, ys: Array) -> Array:
    """Signed distance to a solid's outline at points (broadcast)."""
    rotation = solid.X_WG.rotation()
    dx, dy = xs - solid.X_WG.p[0], ys - solid.X_WG.p[1]
    upright = abs(rotation[2, 2]) > UPRIGHT
    if solid.kind == "cylinder" and upright:
        return np.hypot(dx, dy) - 0.5 * solid.size_m[0]
    if upright:
        yaw = solid.X_WG.yaw_rad
        half = 0.5 * np.array(solid.size_m[:2])
        c, s = math.cos(yaw), math.sin(yaw)
        dx, dy = c * dx + s * dy, -s * dx + c * dy
    else:
        half = solid.half_extents_m()[:2]
    qx, qy = np.abs(dx) - half[0], np.abs(dy) - half[1]
    outside = np.hypot(np.maximum(qx, 0.0), np.maximum(qy, 0.0))
    return outside + np.minimum(np.maximum(qx, qy), 0.0)
