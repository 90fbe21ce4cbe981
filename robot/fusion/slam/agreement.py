"""Whether scans contradict a piece of the map: points where other beams went through."""

from __future__ import annotations

import numpy as np

from robot.fusion.slam.patch import Patch
from robot.fusion.slam.planar import inverse, placed
from robot.se3 import Array

THROUGH_M = 0.4
THROUGH_SHARE = 0.05
"""A beam went through a point if it went this much farther: beside a corner it may."""


def contradicted(patch: Patch, points: Array, *, every: int = 3) -> float:
    """Which part of the points, given in the patch's frame, its own beams went through.

    Of those points that lie where some beam of the patch looked.
    """
    looked = np.zeros(len(points), dtype=bool)
    through = np.zeros(len(points), dtype=np.int64)
    stopped = np.zeros(len(points), dtype=np.int64)
    for scan, pose in list(zip(patch.scans, patch.poses, strict=True))[::every]:
        local = placed(inverse(pose), points)
        ranges = np.hypot(local[:, 0], local[:, 1])
        first, step = scan.beams
        beam = (np.arctan2(local[:, 1], local[:, 0]) - first) / step
        period = abs(2.0 * np.pi / step)
        beam = np.mod(beam, period)
        index = np.round(beam).astype(np.int64)
        count = len(scan.seen_m)
        inside = (index >= 1) & (index < count - 1)
        index = np.clip(index, 1, max(1, count - 2))
        # Of three neighbouring beams the shortest, lest a grazed edge passes for a contradiction.
        seen = np.minimum(
            np.minimum(scan.seen_m[index - 1], scan.seen_m[index]), scan.seen_m[index + 1]
        )
        known = inside & (seen > 0.0)
        beyond = known & (seen > ranges + THROUGH_M + THROUGH_SHARE * ranges)
        at = known & (np.abs(seen - ranges) < THROUGH_M)
        through += beyond
        stopped += at
        looked |= known & (seen > ranges - THROUGH_M)
    if not looked.any():
        return 0.0
    return float(np.count_nonzero(through > stopped)) / float(np.count_nonzero(looked))
