"""The poses of the key frames that agree best with all that was measured between them.

Sparse Gauss-Newton on relative poses [Grisetti2010]; loops have the kernel of Cauchy, under which a
wrong one loses its say instead of bending the map.
"""

from __future__ import annotations

import numpy as np

from robot.fusion.slam.numerics import Indices, shortest_paths, solve_sparse
from robot.fusion.slam.planar import wrapped
from robot.se3 import Array

ITERATIONS = 20
SETTLED_M = 1e-4
DAMPING = 1e-6
KERNEL = 3.0
"""Normalised error at which a loop has half of its say."""


class PoseGraph:
    """Relative poses between numbered key frames; the first one is held."""

    def __init__(self) -> None:
        self._begins: list[int] = []
        self._ends: list[int] = []
        self._measured: list[Array] = []
        self._information: list[Array] = []
        self._robust: list[bool] = []
        self._lengths_m: list[float] = []

    def add(
        self,
        begin: int,
        end: int,
        measured: Array,
        information: Array,
        *,
        robust: bool,
        length_m: float,
    ) -> None:
        """Add that key frame `end` is at `measured` in the frame of key frame `begin`.

        Args:
            begin: a key frame.
            end: another one.
            measured: x, y, heading.
            information: (3, 3), the inverse of its covariance.
            robust: whether it may be wrong altogether, as a loop may.
            length_m: it is as unsure as a way of this length.
        """
        self._begins.append(begin)
        self._ends.append(end)
        self._measured.append(measured)
        self._information.append(information)
        self._robust.append(robust)
        self._lengths_m.append(length_m)

    @property
    def loops(self) -> int:
        """How many."""
        return sum(self._robust)

    def looped(self) -> set[int]:
        """Key frames that a loop ends in."""
        pairs = zip(self._ends, self._robust, strict=True)
        return {end for end, robust in pairs if robust}

    def way_from(self, source: int, nodes: int) -> Array:
        """The shortest way from a key frame to each of all `nodes` [m]."""
        return shortest_paths(
            np.array(self._begins),
            np.array(self._ends),
            np.array(self._lengths_m),
            nodes=nodes,
            source=source,
        )

    def optimised(self, poses: Array, *, iterations: int = ITERATIONS) -> Array:
        """The poses (n, 3) that fit best, from a start."""
        if not self._begins:
            return poses
        begins, ends, measured, information, robust = self._arrays()
        poses = poses.copy()
        rows, columns = _places(begins, ends)
        size = 3 * len(poses)
        held = np.arange(3)
        diagonal = np.arange(size)
        for _ in range(iterations):
            errors, first, second = _linearised(poses, begins, ends, measured)
            weighted = information * _weights(errors, information, robust)[:, None, None]
            first_w = np.einsum("eki,ekl->eil", first, weighted)
            second_w = np.einsum("eki,ekl->eil", second, weighted)
            blocks = np.stack(
                [first_w @ first, first_w @ second, second_w @ first, second_w @ second], axis=1
            )
            right = np.zeros(size)
            for nodes, side in ((begins, first_w), (ends, second_w)):
                gradient = np.einsum("eil,el->ei", side, errors)
                for k in range(3):
                    right += np.bincount(3 * nodes + k, gradient[:, k], minlength=size)
            change = -solve_sparse(
                np.concatenate([rows, held, diagonal]),
                np.concatenate([columns, held, diagonal]),
                np.concatenate([blocks.ravel(), np.full(3, 1e12), np.full(size, DAMPING)]),
                right,
            ).reshape(-1, 3)
            poses += change
            poses[:, 2] = wrapped(poses[:, 2])
            if np.abs(change).max() < SETTLED_M:
                break
        return poses

    def _arrays(self) -> tuple[Indices, Indices, Array, Array, Array]:
        return (
            np.array(self._begins),
            np.array(self._ends),
            np.array(self._measured),
            np.array(self._information),
            np.array(self._robust, dtype=float),
        )


def _linearised(
    poses: Array, begins: Indices, ends: Indices, measured: Array
) -> tuple[Array, Array, Array]:
    """Errors (e, 3), and their Jacobians (e, 3, 3) by the first and the second pose."""
    first, second = poses[begins], poses[ends]
    angle = first[:, 2] + measured[:, 2]
    cos, sin = np.cos(angle), np.sin(angle)
    cos_1, sin_1 = np.cos(first[:, 2]), np.sin(first[:, 2])
    dx, dy = second[:, 0] - first[:, 0], second[:, 1] - first[:, 1]
    # What is left of the second pose in the frame where it was measured to be.
    x = dx - cos_1 * measured[:, 0] + sin_1 * measured[:, 1]
    y = dy - sin_1 * measured[:, 0] - cos_1 * measured[:, 1]
    errors = np.stack(
        [
            cos * x + sin * y,
            cos * y - sin * x,
            wrapped(second[:, 2] - first[:, 2] - measured[:, 2]),
        ],
        axis=1,
    )
    by_second = np.zeros((len(begins), 3, 3))
    by_second[:, 0, 0] = by_second[:, 1, 1] = cos
    by_second[:, 0, 1], by_second[:, 1, 0] = sin, -sin
    by_second[:, 2, 2] = 1.0
    by_first = -by_second
    # By the first heading: the difference of places turned, seen from the measured frame.
    by_first[:, 0, 2] = -sin * dx + cos * dy
    by_first[:, 1, 2] = -cos * dx - sin * dy
    return errors, by_first, by_second


def _weights(errors: Array, information: Array, robust: Array) -> Array:
    squares = np.einsum("ei,eij,ej->e", errors, information, errors)
    return np.where(robust > 0, 1.0 / (1.0 + squares / KERNEL**2), 1.0)


def _places(begins: Indices, ends: Indices) -> tuple[Indices, Indices]:
    """Rows and columns of the blocks of every edge: (1, 1), (1, 2), (2, 1), (2, 2)."""
    pairs = np.stack([begins, ends], axis=1)
    row = np.repeat(pairs[:, [0, 0, 1, 1]], 9, axis=1) * 3 + np.tile(np.repeat(range(3), 3), 4)
    column = np.repeat(pairs[:, [0, 1, 0, 1]], 9, axis=1) * 3 + np.tile(np.tile(range(3), 3), 4)
    return row.ravel(), column.ravel()
