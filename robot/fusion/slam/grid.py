"""Where is something, and where is nothing: an occupancy grid from scans whose poses are known.

Each cell counts the beams that ended in it and those that went through [Moravec1985]; the share of
hits, with a prior of one half, is its occupancy.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from robot.fusion.slam.planar import turn
from robot.fusion.slam.scan import Scan
from robot.se3 import Array

CELL_M = 0.05
MOST_CELLS = 16_000_000
FAR_M = 30.0
"""Beams are drawn no farther: beyond, neighbouring ones lie too far apart to tell free space."""
SHORT_M = 0.1
"""A beam is free until this much before its end."""
THROUGH = 0.25
"""Weight of a beam that went through, against one that ended: walls are grazed more than holed."""
UNKNOWN = 127
"""Value of a cell that no beam has met; 0 is free, 255 is full."""


@dataclass(frozen=True, eq=False)
class Grid:
    """Occupancy by cells.

    Attributes:
        cells: (columns along x, rows along y) of 0 (free) to 255 (full); `UNKNOWN` between.
        cell_m: side of a cell.
        origin_m: (2,) the corner of cell (0, 0) with the smallest x and y.
    """

    cells: NDArray[np.uint8]
    cell_m: float
    origin_m: Array


def occupancy(scans: Sequence[Scan], poses: Array) -> Grid:
    """The grid of scans at poses (n, 3)."""
    ends = np.concatenate(
        [
            _near(scan.points) @ turn(float(p[2])) + p[:2]
            for scan, p in zip(scans, poses, strict=True)
        ]
        + [poses[:, :2]]
    )
    low, high = ends.min(axis=0) - 1.0, ends.max(axis=0) + 1.0
    cell_m = CELL_M
    while np.prod(np.ceil((high - low) / cell_m)) > MOST_CELLS:
        cell_m *= 2.0
    columns, rows = (int(n) for n in np.ceil((high - low) / cell_m))
    size = columns * rows
    hits = np.zeros(size, dtype=np.float32)
    passes = np.zeros(size, dtype=np.float32)
    for scan, pose in zip(scans, poses, strict=True):
        points = scan.points
        if not len(points):
            continue
        ranges = np.hypot(points[:, 0], points[:, 1])
        rotation = turn(float(pose[2]))
        directions = (points / ranges[:, None]) @ rotation
        count = int(np.ceil(min(float(ranges.max()), FAR_M) / cell_m))
        along = (np.arange(count) + 0.5) * cell_m
        clear = along[None, :] < (ranges - SHORT_M)[:, None]
        places = pose[:2] + along[None, :, None] * directions[:, None, :]
        met = np.unique(_cells(places[clear], low, cell_m, rows))
        passes[met] += THROUGH
        ended = _cells(_near(points) @ rotation + pose[:2], low, cell_m, rows)
        hits[np.unique(ended)] += 1.0
    share = (hits + 0.5) / (hits + passes + 1.0)
    cells = np.where((hits == 0) & (passes == 0), UNKNOWN, np.round(255.0 * share))
    return Grid(cells.astype(np.uint8).reshape(columns, rows), cell_m, low)


def _near(points: Array) -> Array:
    return points[np.hypot(points[:, 0], points[:, 1]) < FAR_M]


def _cells(places: Array, low: Array, cell_m: float, rows: int) -> NDArray[np.int64]:
    index = ((places - low) / cell_m).astype(np.int64)
    return index[:, 0] * rows + index[:, 1]
