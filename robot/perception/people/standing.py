"""Where something stands all the time: chair legs look like legs, but they do not walk away."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from robot.perception.people.scan import Array, PlanarScan

REACH_M = 8.0
CELL_M = 0.08
ON_M, PAST_M = 0.06, 0.15
"""A beam that ends so near to a cell's distance hits it; one that goes on so far past it went
through.

Three sigmas of a laser of 20 mm; less than the depth of a leg."""
NO_RETURN = 0.3
"""What a beam that did not come back is worth as one that went through: most find nothing within
reach, some hit what is black or bright as a mirror."""
UNKNOWN, WORTH_LOOKS = 0.55, 4.0
"""What is expected of a cell that was never seen, and how many looks that is worth."""


class StandingThings:
    """A grid around where the laser was first: how often each cell was hit and seen through."""

    def __init__(self) -> None:
        """Nothing is known yet."""
        self._side = 2 * round(REACH_M / CELL_M)
        axis = (np.arange(self._side) + 0.5) * CELL_M - REACH_M
        self._cells_m = np.stack(np.meshgrid(axis, axis, indexing="ij"), axis=-1).reshape(-1, 2)
        self._origin_m: Array | None = None
        self._hits = np.zeros(len(self._cells_m))
        self._looks = np.zeros(len(self._cells_m))

    def look(self, scan: PlanarScan) -> None:
        """Take in a scan."""
        if self._origin_m is None:
            self._origin_m = np.array(scan.pose[:2])
        cells_m = scan.in_laser(self._cells_m + self._origin_m)
        distances_m = np.hypot(cells_m[:, 0], cells_m[:, 1])
        bearings_rad = np.arctan2(cells_m[:, 1], cells_m[:, 0])
        turns = np.mod(bearings_rad - scan.angle_min_rad, 2.0 * np.pi)
        beams = np.round(turns / scan.angle_step_rad).astype(np.intp)
        count = len(scan.ranges_m)
        ranges_m = np.zeros(count + 2)
        ranges_m[1:-1][scan.returned] = scan.ranges_m[scan.returned]
        within = (beams < count) & (distances_m > CELL_M)
        beams = np.where(within, beams, 0) + 1
        ranges_m = np.where(np.isfinite(ranges_m), ranges_m, 0.0)
        beside_m = np.stack([ranges_m[beams - 1], ranges_m[beams], ranges_m[beams + 1]])
        hit = within & (np.abs(beside_m - distances_m) < ON_M).any(axis=0)
        through = within & ~hit & (ranges_m[beams] > distances_m + PAST_M)
        nothing = within & (beside_m == 0.0).all(axis=0)
        self._hits += hit
        self._looks += hit + through + NO_RETURN * nothing

    def share(self, scan: PlanarScan, points_m: Array) -> Array:
        """How much of the time something stood at points of the laser's frame: shape (n,), 0 to 1.

        `UNKNOWN` where nobody looked.
        """
        if self._origin_m is None:
            return np.full(len(points_m), UNKNOWN)
        places_m = scan.in_place(points_m) - self._origin_m
        columns = np.floor((places_m + REACH_M) / CELL_M).astype(np.intp)
        inside: NDArray[np.bool_] = np.all((columns >= 0) & (columns < self._side), axis=1)
        columns = np.where(inside[:, None], columns, 0)
        cells = columns[:, 0] * self._side + columns[:, 1]
        hits, looks = inside * self._hits[cells], inside * self._looks[cells]
        return (hits + WORTH_LOOKS * UNKNOWN) / (looks + WORTH_LOOKS)
