"""What the finder says of each pixel, as one mask a thing.

Each pixel tells how likely it is of a thing, and how far away the middle of that thing is; pixels
that tell of the same middle are one thing, also where two of them touch (as Cheng et al. 2020,
"Panoptic-DeepLab", do it).
"""

# pyright: basic
# scipy comes without types.

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

Floats = NDArray[np.float32]
Mask = NDArray[np.bool_]
HALF = 2
"""The finder answers for each second pixel of each second row."""
REACH_PX = 16.0
"""Its offsets are in units of so many of its pixels."""
LIKELY = 0.5
BLUR_PX, APART_PX = 1.0, 5
LEAST_VOTES, LEAST_PX = 1.2, 3
"""At a middle, and in all."""
MOST = 48


class Instance(NamedTuple):
    """A thing in a picture: which pixels show it, shape (height, width), how likely it is one."""

    pixels: Mask
    score: float


def instances(answers: Floats, shape: tuple[int, ...]) -> list[Instance]:
    """The things of a picture, the likeliest first.

    Args:
        answers: of the finder, shape (3, rows, columns): log-odds, and the offset to the middle
            across and down.
        shape: of the picture, rows and columns.
    """
    odds, across, down = answers
    likely = 1.0 / (1.0 + np.exp(-np.clip(odds, -30.0, 30.0)))
    rows, columns = np.nonzero(likely > LIKELY)
    if not len(rows):
        return []
    height, width = likely.shape
    to_u = np.clip(columns + REACH_PX * across[rows, columns], 0.0, width - 1.0)
    to_v = np.clip(rows + REACH_PX * down[rows, columns], 0.0, height - 1.0)
    place = np.rint(to_v).astype(np.intp) * width + np.rint(to_u).astype(np.intp)
    weights = likely[rows, columns]
    votes = np.bincount(place, weights, minlength=width * height).reshape(height, width)
    votes = ndimage.gaussian_filter(votes, BLUR_PX)
    peaks = (votes == ndimage.maximum_filter(votes, APART_PX)) & (votes * 2 * np.pi > LEAST_VOTES)
    peak_v, peak_u = np.nonzero(peaks)
    if not len(peak_v):
        return []
    best = np.argsort(-votes[peak_v, peak_u])[:MOST]
    peak_v, peak_u = peak_v[best], peak_u[best]
    away = (to_u[:, None] - peak_u) ** 2 + (to_v[:, None] - peak_v) ** 2
    owner = away.argmin(axis=1)
    found: list[Instance] = []
    for number in range(len(peak_v)):
        own = owner == number
        if own.sum() < LEAST_PX:
            continue
        small = np.zeros(likely.shape, dtype=np.bool_)
        small[rows[own], columns[own]] = True
        pixels = np.zeros(shape[:2], dtype=np.bool_)
        pixels[: HALF * height, : HALF * width] = small.repeat(HALF, axis=0).repeat(HALF, axis=1)
        found.append(Instance(pixels, float(weights[own].mean())))
    return sorted(found, key=lambda one: -one.score)
