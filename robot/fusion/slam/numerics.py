# pyright: basic
"""The numerical routines of SLAM that come without types (scipy), and shapes of arrays."""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse import csgraph
from scipy.sparse.linalg import splu
from scipy.spatial import KDTree

from robot.se3 import Array

Indices: TypeAlias = NDArray[np.int64]
Mask: TypeAlias = NDArray[np.bool_]


class Tree:
    """Points to find the nearest of."""

    def __init__(self, points: Array) -> None:
        # Neither balanced nor compact: 2.5 times as fast to build, a few per cent slower to ask.
        self._tree = KDTree(points, leafsize=16, balanced_tree=False, compact_nodes=False)
        self.size = len(points)

    def nearest(self, points: Array, within_m: float) -> tuple[Array, Indices]:
        """Distances [m] and indices; inf and `size` where none is near enough."""
        distances, found = self._tree.query(points, distance_upper_bound=within_m)
        return np.asarray(distances), np.asarray(found)


def combinations(first: Indices, second: Indices, third: Indices) -> Indices:
    """All triples of three lists of numbers, (n, 3)."""
    grids = np.meshgrid(first, second, third, indexing="ij")
    return np.column_stack([grid.ravel() for grid in grids])


def solve(matrix: Array, right: Array) -> Array:
    """Solution of a small system."""
    result: Any = np.linalg.solve(matrix, right)
    return result


def inverse_of(matrix: Array) -> Array:
    """Inverse of a small matrix."""
    result: Any = np.linalg.inv(matrix)
    return result


def by_blocks(grid: NDArray[np.uint8], side: int) -> tuple[NDArray[np.uint8], NDArray[np.uint8]]:
    """Smallest and largest value of the blocks of a grid; what is left over at its end is not.

    A grid that is narrower than a block is one block wide.
    """
    down, across = min(side, grid.shape[0]), min(side, grid.shape[1])
    rows, columns = grid.shape[0] // down, grid.shape[1] // across
    blocks = grid[: rows * down, : columns * across].reshape(rows, down, columns, across)
    return blocks.min(axis=(1, 3)), blocks.max(axis=(1, 3))


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
