# pyright: basic
"""The numerical routines of SLAM that come without types (scipy), and shapes of arrays."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage, sparse
from scipy.sparse import csgraph
from scipy.sparse.linalg import splu
from scipy.spatial import cKDTree

from robot.se3 import Array

Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]


class Tree:
    """Points to find the nearest of."""

    def __init__(self, points: Array) -> None:
        # Neither balanced nor compact: 2.5 times as fast to build, a few per cent slower to ask.
        self._tree = cKDTree(points, leafsize=16, balanced_tree=False, compact_nodes=False)
        self.size = len(points)

    def nearest(self, points: Array, within_m: float) -> tuple[Array, Indices]:
        """Distances [m] and indices; inf and `size` where none is near enough."""
        distances, found = self._tree.query(points, distance_upper_bound=within_m)
        return distances, found


def solve_sparse(rows: Indices, columns: Indices, values: Array, right: Array) -> Array:
    """Solution of a symmetric sparse system, whose entries may be given in parts."""
    size = len(right)
    matrix = sparse.csc_matrix((values, (rows, columns)), shape=(size, size))
    factors = splu(matrix, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})
    return factors.solve(right)


def shortest_paths(
    begins: Indices, ends: Indices, lengths: Array, *, nodes: int, source: int
) -> Array:
    """Lengths of the shortest ways from a node to every node of an undirected graph."""
    graph = sparse.csr_matrix((lengths, (begins, ends)), shape=(nodes, nodes))
    return csgraph.dijkstra(graph, directed=False, indices=source)


def maximum_over(grid: NDArray[np.uint8], side: int, axis: int) -> NDArray[np.uint8]:
    """The largest of each `side` cells of a row or column that begin at a cell."""
    return ndimage.maximum_filter1d(grid, side, axis=axis, origin=-(side // 2), mode="constant")
