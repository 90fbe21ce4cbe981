# pyright: basic
# SciPy ships no types.
"""What is connected with what, through any number of links."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components


def components(count: int, links: NDArray[np.intp]) -> NDArray[np.int32]:
    """The number of the component that each of `count` nodes is of; links have shape (n, 2)."""
    ones = np.ones(len(links), dtype=np.int8)
    graph = coo_array((ones, (links[:, 0], links[:, 1])), shape=(count, count))
    return connected_components(graph, directed=False)[1]
