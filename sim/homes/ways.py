# pyright: basic
"""Lengths of ways over a grid (scipy comes without types)."""

from __future__ import annotations

import math

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import dijkstra

from robot.planning.numerics import Mask
from robot.se3 import Array

STEPS = ((0, 1), (1, 0), (1, 1), (1, -1))


def lengths(free: Mask, start: tuple[int, int]) -> Array:
    """Length of the shortest way from one cell to every other, in cells; infinite if none leads."""
    number = np.arange(free.size).reshape(free.shape)
    rows, columns, costs = [], [], []
    for di, dj in STEPS:
        here = (slice(0, free.shape[0] - di), slice(max(0, -dj), free.shape[1] - max(0, dj)))
        there = (slice(di, None), slice(max(0, dj), free.shape[1] + min(0, dj)))
        both = free[here] & free[there]
        rows.append(number[here][both])
        columns.append(number[there][both])
        costs.append(np.full(int(both.sum()), math.hypot(di, dj)))
    graph = coo_matrix(
        (np.concatenate(costs), (np.concatenate(rows), np.concatenate(columns))),
        shape=(free.size, free.size),
    ).tocsr()
    found = dijkstra(graph, directed=False, indices=int(number[start]))
    return found.reshape(free.shape)
