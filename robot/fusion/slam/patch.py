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
        scans: what it was laid together from, if that is known.
        poses: theirs in the frame.
    """

    def __init__(self, points: Array, normals: Array, spans_m: Array) -> None:
        """Hold points, each (n, 2), with their normals and spans."""
        self.points = points
        self.normals = normals
        self.spans_m = spans_m
        self.tree = Tree(points)
        self.scans: list[Scan] = []
        self.poses: list[Array] = []

    @classmethod
    def of(cls, scans: Sequence[Scan], poses: Sequence[Array]) -> Patch:
        """Scans laid together at poses of the patch's frame."""
        pairs = list(zip(scans, poses, strict=True))
        patch = cls(
            np.concatenate([placed(pose, scan.points) for scan, pose in pairs]),
            np.concatenate([scan.normals @ turn(float(pose[2])) for scan, pose in pairs]),
            np.concatenate([scan.spans_m for scan in scans]),
        )
        patch.scans, patch.poses = list(scans), list(poses)
        return patch

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
