"""A piece of the map as a grid, searched in a whole window at once by branch and bound.

The score of a pose is the mean of the grid over the points. A coarser level holds in each cell the
largest value of the 2^h x 2^h cells that begin there, so that the score on it bounds those of all
poses below it: what cannot win is never looked at, and the best is the best of the whole window
[Hess2016].
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from robot.fusion.slam.numerics import Indices, combinations
from robot.fusion.slam.planar import turn
from robot.se3 import Array

CELL_M = 0.1
BESIDE = 140
"""Value beside a cell that was hit, of 255: half a cell off is no miss."""
LARGEST_M = 80.0
BATCH = 256
POINTS = 100
ARM_M = 12.0
"""A search takes so many points, and none that are farther away: a step of an angle would carry
them over several cells."""
MOST = 60_000
"""Poses that are looked at before a search is given up: a place that is so much like itself, or so
empty, that bounds do not help."""


@dataclass(frozen=True, eq=False)
class Found:
    """The best pose of a window.

    Attributes:
        pose: x, y [m], heading [rad] in the raster's frame.
        score: mean value of the grid under the points, 0 to 1.
    """

    pose: Array
    score: float


class Raster:
    """A grid of hits with its coarser levels."""

    def __init__(self, points: Array, *, levels: int, cell_m: float = CELL_M) -> None:
        self.cell_m = cell_m
        middle = np.median(points, axis=0)
        near = points[np.all(np.abs(points - middle) < 0.5 * LARGEST_M, axis=1)]
        self._margin = 2**levels
        low = np.floor(near.min(axis=0) / cell_m).astype(np.int64) - 1 - self._margin
        high = np.floor(near.max(axis=0) / cell_m).astype(np.int64) + 2 + self._margin
        self._low = low
        grid = np.zeros(tuple(high - low), dtype=np.uint8)
        cells = np.floor(near / cell_m).astype(np.int64) - low
        hit = np.zeros(grid.shape, dtype=bool)
        hit[cells[:, 0], cells[:, 1]] = True
        for dx in (-1, 0, 1):
            for dy in (-1, 0, 1):
                beside = np.roll(hit, (dx, dy), axis=(0, 1))
                grid[beside] = BESIDE
        grid[hit] = 255
        self._levels: list[NDArray[np.uint8]] = [grid]
        for level in range(levels):
            last = self._levels[-1]
            wide = last.copy()
            half = 2**level
            np.maximum(wide[:-half], last[half:], out=wide[:-half])
            both = wide.copy()
            np.maximum(both[:, :-half], wide[:, half:], out=both[:, :-half])
            self._levels.append(both)
        self._width, self._height = int(high[0] - low[0]), int(high[1] - low[1])

    def search(
        self,
        points: Array,
        center: Array,
        *,
        reach_m: float,
        reach_rad: float,
        step_rad: float,
        least: float,
    ) -> Found | None:
        """The pose with the best score within a window about `center`, if it is above `least`."""
        turns = max(0, int(np.ceil(reach_rad / step_rad)))
        headings = center[2] + step_rad * np.arange(-turns, turns + 1)
        cells = np.stack(
            [
                np.floor((points @ turn(float(heading)) + center[:2]) / self.cell_m)
                for heading in headings
            ]
        ).astype(np.int64)
        cells -= self._low
        reach = int(np.ceil(reach_m / self.cell_m))
        top = len(self._levels) - 1
        while top > 0 and 2**top > 2 * reach:
            top -= 1
        starts: Indices = np.arange(-reach, reach + 1, 2**top, dtype=np.int64)
        candidates = combinations(np.arange(len(headings)), starts, starts)
        # Of equal scores the one nearest the middle wins: last resort in a bare corridor.
        best = _Best(score=least, left=MOST)
        self._descend(cells, candidates, top, reach, best)
        if best.candidate is None or best.left <= 0:
            return None
        index, x, y = best.candidate
        pose = np.array(
            [
                center[0] + x * self.cell_m,
                center[1] + y * self.cell_m,
                headings[index],
            ]
        )
        return Found(pose=pose, score=best.score)

    def _scores(self, cells: Indices, candidates: Indices, level: int) -> Array:
        grid = self._levels[level]
        # A cell left of or below the grid still reaches into it when its block does: the margin.
        places = cells[candidates[:, 0]] + candidates[:, None, 1:]
        x, y = places[..., 0], places[..., 1]
        width, height = self._width, self._height
        inside = (x >= 0) & (x < width) & (y >= 0) & (y < height)
        values = grid.ravel().take(np.where(inside, x * height + y, 0))
        values *= inside
        return values.mean(axis=1) / 255.0

    def _descend(
        self, cells: Indices, candidates: Indices, level: int, reach: int, best: _Best
    ) -> None:
        best.left -= len(candidates)
        if best.left <= 0:
            return
        scores = np.concatenate(
            [
                self._scores(cells, candidates[begin : begin + BATCH], level)
                for begin in range(0, len(candidates), BATCH)
            ]
        )
        order = np.argsort(-scores, kind="stable")
        if level == 0:
            first = order[0]
            if scores[first] > best.score:
                best.score = float(scores[first])
                angle, x, y = (int(value) for value in candidates[first])
                best.candidate = angle, x, y
            return
        half = 2 ** (level - 1)
        width = 8
        for begin in range(0, len(order), width):
            some = order[begin : begin + width]
            some = some[scores[some] > best.score]
            if not len(some):
                return
            parents = candidates[some]
            children = (parents[:, None, :] + np.array(_corners(half))[None]).reshape(-1, 3)
            children = children[np.all(np.abs(children[:, 1:]) <= reach, axis=1)]
            if len(children):
                self._descend(cells, children, level - 1, reach, best)
            width = min(2 * width, 4 * BATCH)


@dataclass
class _Best:
    score: float
    left: int
    candidate: tuple[int, int, int] | None = None


def _corners(half: int) -> list[tuple[int, int, int]]:
    return [(0, 0, 0), (0, half, 0), (0, 0, half), (0, half, half)]


def search_points(points: Array) -> Array:
    """Some of a scan's points, for a search in steps of an angle: far ones would jump."""
    near = points[np.hypot(points[:, 0], points[:, 1]) < ARM_M]
    if len(near) < len(points) // 2:
        near = points
    return near[:: max(1, len(near) // POINTS)]
