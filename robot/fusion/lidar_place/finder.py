"""Where in the whole map a scan was taken, without any word of it; or that it could be elsewhere.

A robot that does not know where it is must not walk, and a lidar that sees all around sees
nothing new by turning: so one place has to do. The best place of the map counts only if the map
explains the scan there, if hardly a beam goes through what the map says is full, and if neither
another place nor another heading looks nearly as good.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from robot.fusion.slam.grid import Grid
from robot.fusion.slam.map_file import SavedMap
from robot.fusion.slam.matching import match
from robot.fusion.slam.numerics import Mask
from robot.fusion.slam.patch import Patch
from robot.fusion.slam.raster import Found, Raster, search_points
from robot.fusion.slam.scan import Scan
from robot.se3 import Array

CELL_M = 0.1
LEVELS = 5
STEP_RAD = np.radians(2.0)
MOST = 150_000
"""Poses that are looked at before a search is given up: at most a third of a second."""
SCORE = 0.55
FIT = 0.65
GATES_M = (0.4, 0.3, 0.2, 0.12)
ALIKE = 0.9
"""Another place, or heading, that scores this much of the best one's could be it."""
TURNED_RAD = np.radians(30.0)
"""Headings that are farther apart than this are others."""
MARGIN_M = 1.5
"""The robot is no farther than this from where the lidar has been."""
FEWEST = 25
THROUGH = 0.12
"""Of the beams may have gone through what is full: it was moved, or the map is a little off."""
FULL = 200
"""Of 255: cells where more beams ended than went through."""
SHORT_M = 0.35
"""Beams are looked at up to this much before their ends."""


@dataclass(frozen=True, eq=False)
class Guess:
    """The best place of the map.

    Attributes:
        pose: x, y, heading of the scan's frame in the map.
        fit: which part of the scan the map explains there.
        through: which part of the beams went through what is full there.
        alone: whether no other place or heading looks nearly as good.
    """

    pose: Array
    fit: float
    through: float
    alone: bool

    @property
    def sure(self) -> bool:
        """Whether it is enough to act on, once others say the same."""
        return self.alone and self.fit >= FIT and self.through <= THROUGH


class Finder:
    """Looks for scans in a map."""

    def __init__(self, saved: SavedMap, patch: Patch) -> None:
        """Draw the map.

        Args:
            saved: the map.
            patch: its surfaces.
        """
        self._patch, self._grid = patch, saved.grid
        low, high = saved.keys[:, :2].min(axis=0), saved.keys[:, :2].max(axis=0)
        self._middle = np.array([*(0.5 * (low + high)), 0.0])
        self._reach_m = 0.5 * float((high - low).max()) + MARGIN_M
        self._raster = Raster(
            patch.filled(CELL_M),
            levels=LEVELS,
            reach_m=self._reach_m,
            cell_m=CELL_M,
            largest_m=2.0 * self._reach_m + 30.0,
        )

    def look(self, scan: Scan) -> Guess | None:
        """The best place of the map; None if nothing there looks like the scan."""
        points = search_points(scan.points)
        if len(points) < FEWEST:
            return None
        best = self._search(points, 0.0, np.pi, SCORE)
        if best is None or not best.complete:
            return None
        found = match(self._patch, scan.points, scan.normals, best.pose, gates_m=GATES_M)
        elsewhere = self._search(points, 0.0, np.pi, ALIKE * best.score, but=best.pose)
        opposite = float(best.pose[2] + np.pi)
        turned = self._search(points, opposite, np.pi - TURNED_RAD, ALIKE * best.score)
        return Guess(
            pose=found.pose,
            fit=found.fit,
            through=through(self._grid, scan, found.pose),
            alone=elsewhere is None and turned is None,
        )

    def _search(
        self,
        points: Array,
        heading_rad: float,
        reach_rad: float,
        least: float,
        *,
        but: Array | None = None,
    ) -> Found | None:
        center = np.array([self._middle[0], self._middle[1], heading_rad])
        return self._raster.search(
            points, center, reach_m=self._reach_m, reach_rad=reach_rad, step_rad=STEP_RAD,
            least=least, most=MOST, but=but,
        )  # fmt: skip


def through(grid: Grid, scan: Scan, pose: Array) -> float:
    """Which part of a scan's beams went through full cells of a grid, seen from a pose (3,)."""
    first_rad, step_rad = scan.beams
    beams = np.flatnonzero(scan.seen_m > SHORT_M + grid.cell_m)
    if not len(beams):
        return 0.0
    ranges_m = scan.seen_m[beams]
    angles = float(pose[2]) + first_rad + step_rad * beams
    along = np.arange(SHORT_M, float(ranges_m.max()), grid.cell_m)
    clear = along[None, :] < (ranges_m - SHORT_M)[:, None]
    x = pose[0] + np.cos(angles)[:, None] * along
    y = pose[1] + np.sin(angles)[:, None] * along
    beam, _ = np.nonzero(_full(grid, x, y) & clear)
    return len(np.unique(beam)) / len(beams)


def _full(grid: Grid, x_m: Array, y_m: Array) -> Mask:
    """Whether places lie in full cells."""
    column = np.floor((x_m - grid.origin_m[0]) / grid.cell_m).astype(np.int64)
    row = np.floor((y_m - grid.origin_m[1]) / grid.cell_m).astype(np.int64)
    columns, rows = grid.cells.shape
    inside = (column >= 0) & (column < columns) & (row >= 0) & (row < rows)
    cells = grid.cells[np.clip(column, 0, columns - 1), np.clip(row, 0, rows - 1)]
    return inside & (cells >= FULL)
