"""A piece of the map as a grid, searched in a whole window at once by branch and bound.

The score of a pose is the mean of the grid over the points. A coarser level holds in each cell the
largest value of the 2^h x 2^h cells that begin there, so that the score on it bounds those of all
poses below it: what cannot win is never looked at, and the best is the best of the whole window
[Hess2016].
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from robot.fusion.slam.numerics import Indices, combinations
from robot.fusion.slam.planar import turn
from robot.se3 import Array

CELL_M = 0.1
BESIDE = 140
"""Value beside a cell that was hit, of 255: half a cell off is no miss."""
LARGEST_M = 80.0
BATCH = 512
POINTS = 100
ARM_M = 12.0
"""A search takes so many points, and none that are farther away: a step of an angle would carry
them over several cells."""
FEW = 16
"""Cells of a level that are looked into first."""
MOST = 60_000
"""Poses that are looked at before a search is given up: a place that is so much like itself, or so
empty, that bounds do not help."""

ASIDE_M = 1.5
"""Another place is at least this far away."""
Places: TypeAlias = NDArray[np.int32]


@dataclass(frozen=True, eq=False)
class Found:
    """The best pose of a window.

    Attributes:
        pose: x, y [m], heading [rad] in the raster's frame.
        score: mean value of the grid under the points, 0 to 1.
        complete: whether the whole window was searched; if not, there may be a better one.
    """

    pose: Array
    score: float
    complete: bool


class Raster:
    """A grid of hits with its coarser levels.

    Attributes:
        cell_m: side of a cell of the finest level.
        reach_m: how far from its middle a window may go.
    """

    def __init__(
        self,
        points: Array,
        *,
        levels: int,
        reach_m: float,
        cell_m: float = CELL_M,
        largest_m: float = LARGEST_M,
    ) -> None:
        """Draw points (n, 2) [m]."""
        self.cell_m = cell_m
        self.reach_m = reach_m
        near = _together(points, 0.5 * largest_m)
        spread = near if len(near) else np.zeros((1, 2))
        # Whatever point of a scan, wherever it is moved to within reach, has a cell: those that are
        # farther out than the empty margin of the map are taken to stand at its edge.
        self._reach = int(np.ceil(reach_m / cell_m)) + 1
        margin = 2 * self._reach + 2**levels + 1
        low = np.floor(spread.min(axis=0) / cell_m).astype(np.int64) - margin
        high = np.floor(spread.max(axis=0) / cell_m).astype(np.int64) + margin + 1
        self._low = low
        self._size = high - low
        grid = np.zeros((int(self._size[0]), int(self._size[1])), dtype=np.uint8)
        cells = np.floor(near / cell_m).astype(np.int64) - low
        hit = np.zeros(grid.shape, dtype=bool)
        hit[cells[:, 0], cells[:, 1]] = True
        for dx in (-1, 0, 1):
            for dy in (-1, 0, 1):
                grid[np.roll(hit, (dx, dy), axis=(0, 1))] = BESIDE
        grid[hit] = 255
        self._levels: list[NDArray[np.uint8]] = [grid]
        for level in range(levels):
            last, half = self._levels[-1], 2**level
            wide = last.copy()
            np.maximum(wide[:-half], last[half:], out=wide[:-half])
            both = wide.copy()
            np.maximum(both[:, :-half], wide[:, half:], out=both[:, :-half])
            self._levels.append(both)

    def search(
        self,
        points: Array,
        center: Array,
        *,
        reach_m: float,
        reach_rad: float,
        step_rad: float,
        least: float,
        most: int = MOST,
        but: Array | None = None,
    ) -> Found | None:
        """The pose with the best score within a window.

        Args:
            points: (n, 2), in their own frame [m].
            center: the middle of the window.
            reach_m: from there along x and y.
            reach_rad: from there to either side.
            step_rad: between two headings that are tried.
            least: None if no pose has a better score.
            most: poses that are looked at before the search is given up.
            but: nothing nearer than `ASIDE_M` to this pose, whatever its heading.
        """
        turns = max(0, int(np.ceil(reach_rad / step_rad)))
        headings = center[2] + step_rad * np.arange(-turns, turns + 1)
        reach = min(int(np.ceil(reach_m / self.cell_m)), self._reach)
        edge = self._reach + 1
        cells = [
            np.floor((points @ turn(float(heading)) + center[:2]) / self.cell_m)
            for heading in headings
        ]
        inside = np.clip(np.stack(cells) - self._low, edge, self._size - edge - len(self._levels))
        flat = (inside[..., 0] * self._size[1] + inside[..., 1]).astype(np.int32)
        top = len(self._levels) - 1
        while top > 0 and 2**top > 2 * reach:
            top -= 1
        starts: Indices = np.arange(-reach, reach + 1, 2**top, dtype=np.int64)
        candidates = combinations(np.arange(len(headings)), starts, starts)
        # Of equal scores the one nearest the middle wins: last resort in a bare corridor.
        best = _Best(score=least, left=most)
        if but is not None:
            best.but = np.round((but[:2] - center[:2]) / self.cell_m)
            best.aside = ASIDE_M / self.cell_m
        self._descend(flat, candidates, top, reach, best)
        complete = best.left > 0
        if best.candidate is None:
            return None if complete else Found(center, least, complete=False)
        index, x, y = best.candidate
        pose = np.array(
            [
                center[0] + x * self.cell_m,
                center[1] + y * self.cell_m,
                headings[index],
            ]
        )
        return Found(pose, best.score, complete)

    def _scores(self, flat: Places, candidates: Indices, level: int) -> Array:
        moved = candidates[:, 1] * int(self._size[1]) + candidates[:, 2]
        places = flat[candidates[:, 0]] + moved[:, None].astype(np.int32)
        values = self._levels[level].ravel().take(places)
        return values.sum(axis=1, dtype=np.int64) / (255.0 * flat.shape[1])

    def _descend(
        self, flat: Places, candidates: Indices, level: int, reach: int, best: _Best
    ) -> None:
        best.left -= len(candidates)
        if best.left <= 0:
            return
        batches = range(0, len(candidates), BATCH)
        scores = np.concatenate(
            [self._scores(flat, candidates[begin : begin + BATCH], level) for begin in batches]
        )
        order = np.argsort(-scores, kind="stable")
        if level == 0:
            if best.but is not None:
                near = np.hypot(*(candidates[:, 1:] - best.but).T) < best.aside
                scores[near] = 0.0
                order = np.argsort(-scores, kind="stable")
            if scores[order[0]] > best.score:
                best.score = float(scores[order[0]])
                angle, x, y = (int(value) for value in candidates[order[0]])
                best.candidate = angle, x, y
            return
        corners = _corners(2 ** (level - 1))
        begin, width = 0, FEW
        while begin < len(order) and best.left > 0:
            some = order[begin : begin + width]
            some = some[scores[some] > best.score]
            if not len(some):
                return
            children = (candidates[some][:, None, :] + corners).reshape(-1, 3)
            children = children[np.all(np.abs(children[:, 1:]) <= reach, axis=1)]
            if len(children):
                self._descend(flat, children, level - 1, reach, best)
            begin += width
            width = min(2 * width, BATCH)


def _together(points: Array, within_m: float) -> Array:
    """The points around their middle; where that is between two heaps, the nearer heap."""
    if not len(points):
        return points
    middle = np.median(points, axis=0)
    off = np.abs(points - middle).max(axis=1)
    if off.min() >= within_m:
        middle = points[np.argmin(off)]
    return points[np.all(np.abs(points - middle) < within_m, axis=1)]


@dataclass
class _Best:
    score: float
    left: int
    candidate: tuple[int, int, int] | None = None
    but: Array | None = None
    aside: float = 0.0


def _corners(half: int) -> Indices:
    """From a cell of a level to those of the next finer one that it covers."""
    return np.array([(0, 0, 0), (0, half, 0), (0, 0, half), (0, half, half)], dtype=np.int64)


def search_points(points: Array) -> Array:
    """Some of a scan's points, for a search in steps of an angle: far ones would jump."""
    near = points[np.hypot(points[:, 0], points[:, 1]) < ARM_M]
    if len(near) < len(points) // 2:
        near = points
    return near[:: max(1, len(near) // POINTS)]
