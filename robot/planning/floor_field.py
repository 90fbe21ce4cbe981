"""Signed distances to the outlines of solids on a grid, measured where each can be the nearest.

The grid is cut into quarters, and these again. No distance changes by more than one goes: who is
farther from the middle of a quarter than another by its diagonal is nearest to no point of it,
and is not asked there. So what a grid costs grows with its area alone, however much stands on it,
and what moves is measured again in the tiles around it only.
"""

from __future__ import annotations

import math
from collections.abc import Generator
from functools import lru_cache
from threading import Lock
from typing import TypeAlias

import numpy as np

from robot.planning import numerics
from robot.planning.solids import Solid
from robot.se3 import Array

CELL_M = 0.04
UPRIGHT = 0.999
"""Cosine of the tilt up to which a solid stands upright."""
WITHIN_M = 1e-6
"""What lies so far within another is never the nearest, however the sums are rounded."""
TILE = 32
"""Rows and columns that are measured at once, at most."""
REMEMBERED_CELLS = 4_000_000
"""Of whole grids, 32 MB; a home has a tenth of them at most."""

Bounds: TypeAlias = tuple[float, float, float, float]


class Rows(dict[int, list[float]]):
    """A grid's rows as lists, whose numbers are read faster than an array's, each when asked for.

    They are indexed by their number.
    """

    def __init__(self, field: Array) -> None:
        """None of them has been read."""
        super().__init__()
        self._field = field

    def __missing__(self, row: int) -> list[float]:
        """Read one."""
        found = self[row] = self._field[row].tolist()
        return found


_remembered: dict[tuple[tuple[Solid, ...], Bounds], tuple[Array, Rows]] = {}
_remembering = Lock()


def field_of(solids: tuple[Solid, ...], bounds_m: Bounds) -> tuple[Array, Rows]:
    """The distances to solids and to the bounds' edge, as an array nobody changes and as rows [m].

    Its rows and columns are y and x from the bounds' low corner, every `CELL_M`.
    """
    key = (solids, bounds_m)
    with _remembering:
        found = _remembered.pop(key, None) or _measured(solids, bounds_m)
        _remembered[key] = found  # as the newest
        cells = sum(field.size for field, _ in _remembered.values())
        for oldest in list(_remembered)[:-1]:
            if cells <= REMEMBERED_CELLS:
                break
            cells -= _remembered.pop(oldest)[0].size
    return found


def _measured(solids: tuple[Solid, ...], bounds_m: Bounds) -> tuple[Array, Rows]:
    columns, rows = _cells(bounds_m)
    field = np.empty((rows + 1, columns + 1))
    outlines = _Outlines(solids, bounds_m)
    everywhere = np.arange(len(solids))
    for tile, near in _tiles((0, rows + 1, 0, columns + 1), everywhere, outlines):
        top, bottom, left, right = tile
        field[top:bottom, left:right] = _tile(tuple(solids[n] for n in near), bounds_m, tile)
    field.flags.writeable = False
    return field, Rows(field)


Span: TypeAlias = tuple[int, int, int, int]
"""Rows and columns of a part of the grid: first, end, first, end."""


def _tiles(
    span: Span, near: numerics.Indices, outlines: _Outlines
) -> Generator[tuple[Span, list[int]]]:
    """The tiles of a part of the grid, each with the numbers of who may be nearest in it."""
    top, bottom, left, right = span
    high, wide = bottom - top, right - left
    middle = (0.5 * (left + right - 1), 0.5 * (top + bottom - 1))
    diagonal_m = CELL_M * math.hypot(high, wide)
    near = near[outlines.within(near, middle, diagonal_m)]
    if max(high, wide) <= TILE:
        yield span, near.tolist()
        return
    row = top + _half(high) if high > TILE else bottom
    column = left + _half(wide) if wide > TILE else right
    for rows in ((top, row), (row, bottom)):
        for columns in ((left, column), (column, right)):
            if rows[0] < rows[1] and columns[0] < columns[1]:
                yield from _tiles((*rows, *columns), near, outlines)


def _half(length: int) -> int:
    """About a half, in whole tiles: what the bounds' far edges are changes few tiles."""
    return TILE * max(1, (length // TILE + 1) // 2)


class _Outlines:
    """The outlines of many solids, measured at one point at once; exact but for rounding."""

    def __init__(self, solids: tuple[Solid, ...], bounds_m: Bounds) -> None:
        self._bounds_m = bounds_m
        self._at: Array = np.array([s.X_WG.p[:2] for s in solids]).reshape(-1, 2)
        self._half: Array = np.array([_half_m(s) for s in solids]).reshape(-1, 2)
        turns = np.array([s.X_WG.yaw_rad if _upright(s) else 0.0 for s in solids])
        self._cos: Array = np.cos(turns)
        self._sin: Array = np.sin(turns)
        self._round: numerics.Mask = np.array([_is_round(s) for s in solids], dtype=bool)

    def within(
        self, of: numerics.Indices, column_row: tuple[float, float], slack_m: float
    ) -> numerics.Mask:
        """Who of some is no farther from a point than the nearest by more than the slack [m]."""
        x0, y0, x1, y1 = self._bounds_m
        x, y = x0 + CELL_M * column_row[0], y0 + CELL_M * column_row[1]
        dx, dy = x - self._at[of, 0], y - self._at[of, 1]
        c, s, half = self._cos[of], self._sin[of], self._half[of]
        qx, qy = np.abs(c * dx + s * dy) - half[:, 0], np.abs(c * dy - s * dx) - half[:, 1]
        box: Array = np.hypot(np.maximum(qx, 0.0), np.maximum(qy, 0.0))
        box += np.minimum(np.maximum(qx, qy), 0.0)
        circle: Array = np.hypot(dx, dy) - half[:, 0]
        far: Array = np.where(self._round[of], circle, box)
        edge = min(x - x0, x1 - x, y - y0, y1 - y)
        return far <= min(edge, float(np.min(far, initial=math.inf))) + slack_m


def _upright(solid: Solid) -> bool:
    return abs(solid.X_WG.rotation()[2, 2]) > UPRIGHT


def _is_round(solid: Solid) -> bool:
    return solid.kind == "cylinder" and _upright(solid)


def _half_m(solid: Solid) -> Array:
    """Half of an outline's sides, in its own frame where it stands upright, shape (2,)."""
    return 0.5 * np.array(solid.size_m[:2]) if _upright(solid) else solid.half_extents_m()[:2]


@lru_cache(maxsize=16384)
def _tile(near: tuple[Solid, ...], bounds_m: Bounds, tile: Span) -> Array:
    """The distances on a tile (8 kB), to solids and to the edge."""
    top, bottom, left, right = tile
    xs, ys = _grid(bounds_m)
    xs, ys = xs[:, left:right], ys[top:bottom]
    x0, y0, x1, y1 = bounds_m
    field = np.minimum(np.minimum(xs - x0, x1 - xs), np.minimum(ys - y0, y1 - ys))
    for solid in near:
        np.minimum(field, signed(solid, xs, ys), out=field)
    return field


def _cells(bounds_m: Bounds) -> tuple[int, int]:
    """Columns and rows between the bounds."""
    x0, y0, x1, y1 = bounds_m
    return math.ceil((x1 - x0) / CELL_M), math.ceil((y1 - y0) / CELL_M)


@lru_cache(maxsize=8)
def _grid(bounds_m: Bounds) -> tuple[Array, Array]:
    x0, y0, _, _ = bounds_m
    columns, rows = _cells(bounds_m)
    xs = x0 + numerics.even(0.0, CELL_M * columns, columns + 1)
    ys = y0 + numerics.even(0.0, CELL_M * rows, rows + 1)
    return xs[None, :], ys[:, None]


def outermost(solids: tuple[Solid, ...]) -> tuple[Solid, ...]:
    """The solids whose outlines lie within no other's: only they can be nearest to anything.

    What lies on a table is within the table, so a home of 300 things costs little more than an
    empty one, and the same field serves whatever is seen on its surfaces.
    """
    upright = [abs(s.X_WG.rotation()[2, 2]) > UPRIGHT for s in solids]
    hosts = [n for n, s in enumerate(solids) if s.kind == "box" and upright[n]]
    if not hosts:
        return solids
    outlines = np.array([_outline(s) for s in solids])
    middles = outlines.mean(axis=1)
    inside = np.zeros(len(solids), dtype=bool)
    for number in hosts:
        host = solids[number]
        reach_m = 0.5 * math.hypot(*host.size_m[:2])
        off = np.abs(middles - middles[number])
        of = np.flatnonzero((off[:, 0] <= reach_m) & (off[:, 1] <= reach_m))
        far = signed(host, outlines[of, :, 0], outlines[of, :, 1]).max(axis=1)
        inside[of] |= far < -WITHIN_M
    return tuple(s for s, within in zip(solids, inside, strict=True) if not within)


def _outline(solid: Solid) -> Array:
    """Corners of the upright rectangle around a solid's outline, shape (4, 2)."""
    corners = np.array([(1.0, 1.0), (1.0, -1.0), (-1.0, -1.0), (-1.0, 1.0)])
    rotation = solid.X_WG.rotation()
    at = np.array(solid.X_WG.p[:2])
    if abs(rotation[2, 2]) > UPRIGHT:
        return at + (corners * 0.5 * np.array(solid.size_m[:2])) @ rotation[:2, :2].T
    return at + corners * solid.half_extents_m()[:2]


def signed(solid: Solid, xs: Array, ys: Array) -> Array:
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
