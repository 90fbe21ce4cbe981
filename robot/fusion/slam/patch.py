"""A piece of the map: the points of some scans, laid together, to match others with."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from robot.fusion.slam.numerics import Tree
from robot.fusion.slam.planar import placed, turn
from robot.fusion.slam.scan import Scan
from robot.se3 import Array

WIDEST_M = 0.5
"""A point stands for no more of its surface than this to either side."""


class Patch:
    """Points (n, 2) with normals (n, 2) in one frame.

    Attributes:
        points: [m].
        normals: unit vectors; zero where a point lies on no surface.
        spans_m: how much of its surface each point stands for, to either side.
        tree: to find the nearest.
        scans: what it was laid together from, with their poses in the frame.
    """

    def __init__(self, scans: Sequence[Scan], poses: Sequence[Array]) -> None:
        self.scans = list(scans)
        self.poses = list(poses)
        pairs = list(zip(scans, poses, strict=True))
        self.points = np.concatenate([placed(pose, scan.points) for scan, pose in pairs])
        self.normals = np.concatenate([scan.normals @ turn(float(pose[2])) for scan, pose in pairs])
        self.spans_m = np.concatenate([scan.spans_m for scan in self.scans])
        self.tree = Tree(self.points)

    def filled(self, step_m: float) -> Array:
        """The points, and others between those of one surface, no farther apart than a step."""
        along = np.column_stack([self.normals[:, 1], -self.normals[:, 0]])
        spans_m = np.minimum(self.spans_m, WIDEST_M)
        parts = [self.points]
        for k in range(1, int(WIDEST_M / step_m) + 1):
            wide = spans_m > (k - 0.5) * step_m
            if not wide.any():
                break
            aside = k * step_m * along[wide]
            parts += [self.points[wide] + aside, self.points[wide] - aside]
        return np.concatenate(parts)
