"""The numerical routines of tabletops that come without types (scipy, linear algebra)."""

# pyright: basic

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage, sparse, spatial
from scipy.sparse import csgraph

Array = NDArray[np.float64]


def smooth(values: Array, sigma: float) -> Array:
    """A line of numbers, blurred."""
    return np.asarray(ndimage.gaussian_filter1d(values, sigma, mode="constant"), np.float64)


def regions(mask: NDArray[np.bool_]) -> tuple[NDArray[np.int32], int]:
    """Numbers from 1 for what hangs together in a picture, 0 elsewhere, and how many there are."""
    found: Any = ndimage.label(mask, np.ones((3, 3)))
    labels, count = found
    return np.asarray(labels, np.int32), int(count)


def linked(count: int, pairs: NDArray[np.int64]) -> NDArray[np.int32]:
    """Which of `count` nodes hang together by pairs, shape (n, 2): a number for each node."""
    ones = np.ones(len(pairs), dtype=np.int8)
    graph = sparse.coo_matrix((ones, (pairs[:, 0], pairs[:, 1])), shape=(count, count))
    return np.asarray(csgraph.connected_components(graph, directed=False)[1], np.int32)


def hull(points: Array) -> Array:
    """The half planes of a convex hull, shape (k, 3): a x + b y + c <= 0 inside, (a, b) unit."""
    try:
        return np.asarray(spatial.ConvexHull(points).equations, np.float64)
    except spatial.QhullError:  # all on a line
        return np.array([[0.0, 0.0, np.inf]])


def cross(a: Array, b: Array) -> Array:
    """The vector product, shape (3,)."""
    return np.asarray(np.cross(a, b), np.float64)


def least_squares(system: Array, wanted: Array) -> Array:
    """What solves `system @ x = wanted` best."""
    return np.asarray(np.linalg.lstsq(system, wanted, rcond=None)[0], np.float64)
