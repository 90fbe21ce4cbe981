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


def cheapest_ways(cost: Array, stride: int, start: tuple[int, int]) -> tuple[Array, Indices]:
    """Cheapest ways from one node of a grid to all others, straight and diagonally.

    Args:
        cost: of crossing a cell, infinite where it cannot be; shape (h, w).
        stride: cells from node to node; what lies between two counts too.
        start: row and column of a node.

    Returns:
        The cost of the way to every node [lengths of `stride` cells], and the index of the node
        before it in the flattened grid (below 0: there is none), both of the nodes' shape.
    """
    nodes = cost[::stride, ::stride]
    rows, columns = nodes.shape
    index = np.arange(nodes.size).reshape(nodes.shape)
    edges: list[tuple[Array, Indices, Indices]] = []
    for down, right in ((0, 1), (1, 0), (1, 1), (1, -1)):
        a = (slice(0, rows - down), slice(max(0, -right), columns - max(0, right)))
        b = (slice(down, rows), slice(max(0, right), columns - max(0, -right)))
        crossed = [0.5 * (nodes[a] + nodes[b])]
        for step in range(1, stride):  # the cells between the two
            first = np.arange(a[0].start, a[0].stop) * stride + down * step
            second = np.arange(a[1].start, a[1].stop) * stride + right * step
            crossed.append(cost[np.ix_(first, second)])
        weight = np.hypot(down, right) * np.mean(crossed, axis=0)
        free = np.isfinite(weight)
        edges.append((weight[free], index[a][free], index[b][free]))
    weights, tails, heads = (np.concatenate(part) for part in zip(*edges, strict=True))
    graph = sparse.csr_array((weights, (tails, heads)), shape=(nodes.size, nodes.size))
    far, before = csgraph.dijkstra(
        graph, directed=False, indices=int(index[start]), return_predecessors=True
    )
    return far.reshape(nodes.shape), before.astype(np.int64).reshape(nodes.shape)


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
