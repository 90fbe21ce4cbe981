"""Whether a thing is round or has corners: what the side that is seen looks like from above.

A round side falls back as a circle does, a box shows one level face or two that meet in a corner.
Both are fitted to how far away the side is across its width; how much better the one fits than the
other, in noise, is the evidence. What is seen of a top says nothing of that and is left out.
"""

from __future__ import annotations

from typing import cast

import numpy as np
from numpy.typing import NDArray

from robot.se3 import Array

BINS = 9
REACH = 0.82
"""Of half the width: nearer to an outline depth is of what is behind as well."""
LEAST_POINTS, LEAST_BINS = 6, 6
TOP = 0.2
"""Of the height: what is higher may be the top."""
ERROR_M = 0.0025
"""1 sigma of a bin's depth besides noise: handles, labels, the finite pixels."""
CORNERS = np.linspace(-0.9, 0.9, 13)
"""Where the near corner may be, over half the width."""
TURNS = np.radians(np.arange(0.0, 90.0, 7.5))
SUPPLE = 2.0
"""What a box, which has a corner and a turn to fit with, has to be better by."""
LEAST, MOST = -1.7, 3.0
"""Evidence of one look, in logarithms: of things in homes that are round one in six looks like a
box, of boxes one in thirty looks round."""
TOO_COARSE = 0.12
"""Noise over half the width from which on a side says nothing: that of a cup beyond 1.4 m."""


def roundness(points: Array, eye: Array, *, noise_m: float) -> float:
    """How much likelier a thing is round than a box, in logarithms; 0 if nothing can be said.

    Args:
        points: of the thing above what it stands on [m], in W, shape (n, 3).
        eye: where the camera is, across the floor, shape (2,).
        noise_m: 1 sigma of one point's depth.
    """
    profile = _profile(points, eye)
    if profile is None:
        return 0.0
    across, depths, counts, half_m = profile
    if noise_m > TOO_COARSE * half_m:
        return 0.0
    sigma = np.sqrt(ERROR_M**2 + noise_m**2 / counts)
    weights = 1.0 / sigma**2
    circle = half_m * (1.0 - np.sqrt(1.0 - across**2))
    corner, turn = np.meshgrid(CORNERS, TURNS, indexing="ij")
    from_corner = across[None, None, :] - corner[..., None]
    left, right = np.tan(turn)[..., None], np.tan(np.pi / 2 - np.maximum(turn, 1e-2))[..., None]
    flat = half_m * np.where(from_corner < 0.0, -from_corner * left, from_corner * right)
    boxes = flat.reshape(-1, len(across))
    best = float(min(_misfit(depths, box, weights) for box in boxes))
    odds = 0.5 * (best - _misfit(depths, circle, weights)) + SUPPLE
    return float(np.clip(odds, LEAST, MOST))


def _profile(points: Array, eye: Array) -> tuple[Array, Array, Array, float] | None:
    """Bins across, from -1 to 1; depth of the side in each; points in each; half the width."""
    high = points[:, 2]
    side = points[high < high.min() + (1.0 - TOP) * (high.max() - high.min())][:, :2]
    if len(side) < LEAST_POINTS * LEAST_BINS:
        return None
    sight = side.mean(axis=0) - eye
    sight /= max(float(np.linalg.norm(sight)), 1e-9)
    across, along = side @ np.array([-sight[1], sight[0]]), side @ sight
    low, top = np.quantile(across, (0.01, 0.99)).tolist()
    half_m = max(0.5 * (top - low), 1e-3)
    place = (across - 0.5 * (low + top)) / half_m
    edges = np.linspace(-REACH, REACH, BINS + 1)
    bins = cast("NDArray[np.intp]", np.searchsorted(edges, place, side="right")) - 1
    found: list[tuple[float, float, int]] = []
    for number in range(BINS):
        mine = bins == number
        count = int(np.count_nonzero(mine))
        if count >= LEAST_POINTS:
            middle = float(place[mine].mean())
            found.append((middle, float(np.median(along[mine])), count))
    if len(found) < LEAST_BINS:
        return None
    table = np.array(found)
    return table[:, 0], table[:, 1], table[:, 2], half_m


def _misfit(depths: Array, form: Array, weights: Array) -> float:
    """Squares of what is left when a form is moved to where it fits best, in noise."""
    off = depths - form
    off = off - (weights @ off) / weights.sum()
    return float(weights @ off**2)
