"""Laying points on a piece of the map: point to line, by Gauss-Newton with robust weights.

Each point is drawn to the line through its nearest neighbour in the map [Censi2008], weighed by the
kernel of Geman and McClure, with a gate that narrows; what is expected beforehand (odometry) is
one more measurement, which decides where the walls do not: along a bare corridor.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from robot.fusion.slam.numerics import solve
from robot.fusion.slam.patch import WIDEST_M, Patch
from robot.fusion.slam.planar import turn, wrapped
from robot.se3 import Array

GATES_M = (0.6, 0.4, 0.25, 0.15)
"""How far a point may be from its neighbour, by iteration; the last one lasts."""
TIGHT_GATES_M = (0.25, 0.15)
ITERATIONS = 12
SETTLED_M = 5e-4
SETTLED_RAD = 2e-4
POINT_M = 0.1
"""1 sigma of a point about its line were the errors of points independent: 3 cm, and about ten
neighbours that err together."""
FIT_M = 0.1
"""A point that is nearer to its line than this is explained by the map."""
ALIKE = 0.7
"""Least cosine between the normals of a point and of its neighbour."""


@dataclass(frozen=True, eq=False)
class Match:
    """Where points lie on a patch.

    Attributes:
        pose: x, y [m], heading [rad] of the points' frame in the patch's.
        information: (3, 3), of the points alone: inverse covariance were their errors independent.
        fit: which part of the points the patch explains.
    """

    pose: Array
    information: Array
    fit: float


def match(
    patch: Patch,
    points: Array,
    normals: Array,
    start: Array,
    *,
    prior: Array | None = None,
    gates_m: tuple[float, ...] = GATES_M,
) -> Match:
    """Lay points on a patch, beginning at a pose.

    Args:
        patch: the piece of the map.
        points: (n, 2), in their own frame [m].
        normals: (n, 2), in their own frame; zero where unknown.
        start: x, y, heading.
        prior: information (3, 3) of the start; none by default.
        gates_m: how far a neighbour may be, by iteration.
    """
    pose = np.array(start, dtype=float)
    size = patch.tree.size
    information: Array = np.zeros((3, 3))
    fit = 0.0
    for step in range(ITERATIONS):
        gate_m = gates_m[min(step, len(gates_m) - 1)]
        rotation = turn(pose[2])
        arms = points @ rotation
        distance, found = patch.tree.nearest(arms + pose[:2], gate_m + WIDEST_M)
        spans_m = np.minimum(patch.spans_m[np.minimum(found, size - 1)], WIDEST_M)
        near = np.flatnonzero((found < size) & (distance < gate_m + spans_m))
        if not len(near):
            break
        found = found[near]
        arms = arms[near]
        across = patch.normals[found]
        own = normals[near] @ rotation
        alike = np.abs(np.einsum("ij,ij->i", across, own)) > ALIKE
        errors = np.einsum("ij,ij->i", arms + pose[:2] - patch.points[found], across)
        scale = 0.5 * gate_m
        weights = alike / (1.0 + (errors / scale) ** 2) ** 2
        jacobian = np.column_stack([across, across[:, 1] * arms[:, 0] - across[:, 0] * arms[:, 1]])
        weighted = jacobian * (weights / POINT_M**2)[:, None]
        information = weighted.T @ jacobian
        right = weighted.T @ errors
        fit = float(np.count_nonzero(alike & (np.abs(errors) < FIT_M))) / len(points)
        matrix = information + 1e-3 * np.eye(3)
        if prior is not None:
            off = pose - start
            off[2] = wrapped(off[2])
            matrix = matrix + prior
            right = right + prior @ off
        change = solve(matrix, -right)
        pose = pose + change
        if (
            step >= len(gates_m) - 1
            and np.hypot(change[0], change[1]) < SETTLED_M
            and abs(change[2]) < SETTLED_RAD
        ):
            break
    pose[2] = wrapped(pose[2])
    return Match(pose=pose, information=information, fit=fit)
