"""A scan cut into runs of neighbouring returns: one leg, one chair leg, one stretch of wall."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from robot.perception.people.scan import Array, PlanarScan

APART_M = 0.13
"""Returns that are further from each other begin a new cluster: a bit more than the 31 mm between
beams of 0.35 degrees at 5 m on a slanted surface, and less than a stride ([Leigh2015] uses it)."""
FEWEST_RETURNS = 3


@dataclass(frozen=True)
class Cluster:
    """A run of returns that hang together."""

    begin: int
    """Its first return, among those of the scan."""
    points_m: Array
    """In the laser's frame, counter-clockwise, shape (n, 2)."""

    @property
    def end(self) -> int:
        """One past its last return."""
        return self.begin + len(self.points_m)

    @property
    def centre_m(self) -> Array:
        """The mean of its returns, shape (2,)."""
        return self.points_m.mean(axis=0)


def clusters(scan: PlanarScan) -> list[Cluster]:
    """The clusters of at least `FEWEST_RETURNS` returns, counter-clockwise."""
    points_m = scan.points_m
    if not len(points_m):
        return []
    gaps_m = np.linalg.norm(np.diff(points_m, axis=0), axis=1)
    # Coarse lasers: on a surface at 45 degrees neighbouring returns are that far apart.
    ranges_m = scan.ranges_m[scan.returned]
    nearer_m = np.minimum(ranges_m[:-1], ranges_m[1:])
    apart_m = np.maximum(APART_M, 1.5 * nearer_m * abs(scan.angle_step_rad))
    cuts = [0, *(np.flatnonzero(gaps_m > apart_m) + 1).tolist(), len(points_m)]
    return [
        Cluster(begin, points_m[begin:end])
        for begin, end in pairwise(cuts)
        if end - begin >= FEWEST_RETURNS
    ]
