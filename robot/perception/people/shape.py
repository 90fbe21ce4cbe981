"""What a cluster looks like, as a few numbers: the features of [Arras2007], and its surroundings.

[Arras2007] K. O. Arras, O. Martinez Mozos, W. Burgard, "Using boosted features for the detection of
people in 2D range data", ICRA 2007. [Leigh2015] A. Leigh, J. Pineau, N. Olmedo, H. Zhang, "Person
tracking and following with 2D laser scanners", ICRA 2015.
"""

from __future__ import annotations

import numpy as np

from robot.perception.people.clusters import Cluster
from robot.perception.people.scan import Array, PlanarScan

NAMES = (
    "returns", "width_m", "range_m", "spread_m", "across_m", "depth_m", "boundary_m",
    "boundary_spread_m", "roundness_m", "radius_m", "turn_rad", "bulge_m",
    "in_front_before_m", "in_front_after_m", "gap_before_m", "gap_after_m",
)  # fmt: skip
WIDEST_M = 0.8
"""Nothing that is wider from end to end can be legs: no shape is taken of it."""
FAR_M = 2.0
"""Distances to what lies behind say no more past this."""


def shape(scan: PlanarScan, cluster: Cluster) -> Array:
    """The features of a cluster, in the order of `NAMES`."""
    points_m = cluster.points_m
    count = len(points_m)
    centre_m = points_m.mean(axis=0)
    range_m = float(np.linalg.norm(centre_m))
    chord_m = points_m[-1] - points_m[0]
    width_m = float(np.linalg.norm(chord_m))
    centred_m = points_m - centre_m
    spread_m = float(np.sqrt((centred_m**2).sum(axis=1).mean()))
    ahead = centre_m / range_m
    depths_m = centred_m @ ahead
    variances = np.linalg.eigvalsh(centred_m.T @ centred_m / count)
    steps_m = np.diff(points_m, axis=0)
    lengths_m = np.linalg.norm(steps_m, axis=1)
    headings_rad = np.unwrap(np.arctan2(steps_m[:, 1], steps_m[:, 0]))
    along = chord_m / width_m if width_m > 0.0 else np.array([-ahead[1], ahead[0]])
    # How far the returns bulge towards the laser from the line between the ends: a leg is convex.
    normal = np.array([along[1], -along[0]])
    normal = normal if normal @ ahead < 0.0 else -normal
    roundness_m, radius_m = _circle(points_m)
    before = _beside(scan, cluster.begin, cluster.begin - 1)
    after = _beside(scan, cluster.end - 1, cluster.end)
    return np.array(
        [
            count, width_m, range_m, spread_m, np.sqrt(max(variances[0], 0.0)), np.ptp(depths_m),
            lengths_m.sum(), lengths_m.std(), roundness_m, radius_m,
            headings_rad[-1] - headings_rad[0], ((points_m - points_m[0]) @ normal).mean(),
            before[0], after[0], before[1], after[1],
        ]
    )  # fmt: skip


def _circle(points_m: Array) -> tuple[float, float]:
    """Residual and radius of the circle through points, by linear least squares [Arras2007]."""
    centred_m = points_m - points_m.mean(axis=0)
    matrix = np.column_stack((2.0 * centred_m, np.ones(len(centred_m))))
    solution = np.linalg.pinv(matrix) @ (centred_m**2).sum(axis=1)
    radius_m = float(np.sqrt(max(solution[2] + solution[:2] @ solution[:2], 0.0)))
    distances_m = np.linalg.norm(centred_m - solution[:2], axis=1)
    return float(np.sqrt(((distances_m - radius_m) ** 2).mean())), min(radius_m, FAR_M)


def _beside(scan: PlanarScan, inside: int, outside: int) -> tuple[float, float]:
    """How far an end stands in front of its neighbour, and how far from it [m], at most `FAR_M`."""
    returned, points_m = scan.returned, scan.points_m
    if not 0 <= outside < len(returned) or abs(int(returned[inside] - returned[outside])) > 3:
        return FAR_M, FAR_M  # nothing came back beside it
    step_m = float(scan.ranges_m[returned[outside]] - scan.ranges_m[returned[inside]])
    gap_m = float(np.linalg.norm(points_m[outside] - points_m[inside]))
    return float(np.clip(step_m, -FAR_M, FAR_M)), min(gap_m, FAR_M)
