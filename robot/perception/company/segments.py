"""Pixels that hang together in space, put together where they are above one spot of the floor."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from robot.perception.company.connected import components
from robot.perception.company.view import DepthView

TOGETHER_M, PITCHES = 0.16, 2.5
"""Neighbours that are nearer hang together; or, from afar, nearer than so many pixels are wide."""
ABOVE_M = 0.30
"""Parts that are as near to one another across the floor are of one: a head, a trunk, legs."""
LEAST_PX = 3
HOPS = ((0, 1), (1, 0), (0, 2), (2, 0))
"""To pixels that are neighbours; single holes are passed over."""


def segments(view: DepthView, wanted: NDArray[np.bool_]) -> list[NDArray[np.intp]]:
    """The pixels of each segment as (row, column), shape (n, 2), of those that are wanted."""
    count = int(wanted.sum())
    if not count:
        return []
    numbers = np.full(wanted.shape, -1)
    numbers[wanted] = np.arange(count)
    near_m = np.maximum(TOGETHER_M, PITCHES * view.depth_m / view.focal_px)
    pairs: list[NDArray[np.intp]] = []
    for down, right in HOPS:
        here = (slice(0, wanted.shape[0] - down), slice(0, wanted.shape[1] - right))
        there = (slice(down, None), slice(right, None))
        apart_m = np.linalg.norm(view.points_W[here] - view.points_W[there], axis=-1)
        joined = wanted[here] & wanted[there] & (apart_m < near_m[here])
        pairs.append(np.column_stack((numbers[here][joined], numbers[there][joined])))
    labels = components(count, np.concatenate(pairs))
    pixels = np.argwhere(wanted)
    parts = [pixels[labels == label] for label in range(int(labels.max()) + 1)]
    return _above_one_spot(view, [part for part in parts if len(part) >= LEAST_PX])


def _above_one_spot(view: DepthView, parts: list[NDArray[np.intp]]) -> list[NDArray[np.intp]]:
    if len(parts) < 2:
        return parts
    middles = np.array(
        [np.median(view.points_W[part[:, 0], part[:, 1], :2], axis=0) for part in parts]
    )
    apart_m = np.linalg.norm(middles[:, None] - middles[None], axis=-1)
    labels = components(len(parts), np.argwhere(np.triu(apart_m < ABOVE_M, 1)))
    whole: list[NDArray[np.intp]] = []
    for label in range(int(labels.max()) + 1):
        own = [part for part, its in zip(parts, labels.tolist(), strict=True) if its == label]
        whole.append(np.concatenate(own))
    return whole
