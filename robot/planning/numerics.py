# pyright: basic
"""The numerical routines of planning that come without types (scipy), and shapes of arrays."""

from __future__ import annotations

from typing import Any, TypeAlias

import mujoco
import numpy as np
from numpy.typing import NDArray
from scipy import ndimage, sparse
from scipy.sparse import csgraph

from robot.kinematics.spline import ClampedSpline
from robot.se3 import Array

Mask: TypeAlias = NDArray[np.bool_]
Indices: TypeAlias = NDArray[np.int64]
_NEIGHBOURS = np.ones((3, 3))


def even(first: float, last: float, count: int) -> Array:
    """`count` numbers evenly from first to last, both included."""
    return np.linspace(first, last, count)


def grid_values(field: Array, row_column: tuple[Array, Array], *, outside: float | None) -> Array:
    """A grid's values between its points, linearly; `outside` of it a constant (None: nearest)."""
    mode, fill = ("nearest", 0.0) if outside is None else ("constant", outside)
    return ndimage.map_coordinates(field, row_column, order=1, mode=mode, cval=fill)


def regions(mask: Mask) -> Indices:
    """Number of the connected region of every cell, 0 outside the mask."""
    labels: Any = ndimage.label(mask, structure=_NEIGHBOURS)
    return labels[0].astype(np.int64)


def grown(mask: Mask, *, inside: Mask | None = None) -> Mask:
    """The mask and its neighbour cells, those `inside` only."""
    result: Any = ndimage.binary_dilation(mask, structure=_NEIGHBOURS, mask=inside)
    return result


def distance_to(mask: Mask) -> Array:
    """Distance of every cell to the mask, in cells."""
    result: Any = ndimage.distance_transform_edt(~mask)
    return result


def ways_over(mask: Mask, start: tuple[int, int]) -> Array:
    """Length of the shortest way from a cell to every other over the mask, in cells; inf: none.

    A way goes from cell to cell, diagonally too.
    """
    height, width = mask.shape
    number = np.arange(height * width).reshape(height, width)
    tails, heads, lengths = [], [], []
    for down, right in ((0, 1), (1, 0), (1, 1), (1, -1)):
        first = (slice(0, height - down), slice(max(0, -right), width - max(0, right)))
        second = (slice(down, height), slice(max(0, right), width + min(0, right)))
        both = mask[first] & mask[second]
        tails.append(number[first][both])
        heads.append(number[second][both])
        lengths.append(np.full(int(both.sum()), np.hypot(down, right)))
    ends = (np.concatenate(tails), np.concatenate(heads))
    graph = sparse.csr_matrix((np.concatenate(lengths), ends), shape=(number.size, number.size))
    result: Any = csgraph.dijkstra(graph, directed=False, indices=int(number[start]))
    return result.reshape(height, width)


def spline(times_s: Array, positions: Array, at_s: Array, *, derivative: int = 0) -> Array:
    """A C2 cubic spline through positions (k, n), at rest at both ends, at other times (m, n)."""
    return ClampedSpline(times_s, positions).sample(np.asarray(at_s), derivative=derivative)


def turn_between(first: Array, last: Array) -> Array:
    """Axis times angle that takes one rotation matrix to another, in the first's frame."""
    quat, turn = np.zeros(4), np.zeros(3)
    mujoco.mju_mat2Quat(quat, (first.T @ last).reshape(9))
    mujoco.mju_quat2Vel(turn, quat, 1.0)
    return turn


def turned(first: Array, turn: Array) -> Array:
    """A rotation matrix turned by axis times angle in its own frame."""
    angle = float(np.linalg.norm(turn))
    if angle == 0.0:
        return first.copy()
    quat, matrix = np.zeros(4), np.zeros(9)
    mujoco.mju_axisAngle2Quat(quat, turn / angle, angle)
    mujoco.mju_quat2Mat(matrix, quat)
    return first @ matrix.reshape(3, 3)


def solve_all(matrices: Array, right: Array) -> Array:
    """X of A x = b for many A (n, k, k) and b (n, k)."""
    result: Any = np.linalg.solve(matrices, right[..., None])
    return result[..., 0]


def smallest_singular_values(matrices: Array) -> Array:
    """Of many matrices (n, k, m), shape (n,)."""
    result: Any = np.linalg.svd(matrices, compute_uv=False)
    return result[:, -1]
