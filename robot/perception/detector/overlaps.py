"""One box a thing: of those that overlap and have one name, the likeliest is kept."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from robot.perception.detector.yolo import Array, Candidates

MOST_CANDIDATES = 3000
"""The likeliest so many are looked at: what is below has no chance, and costs time."""


def without_overlaps(
    candidates: Candidates, *, least_score: float, overlap: float
) -> NDArray[np.intp]:
    """The numbers of the candidates that are kept, the likeliest first (greedy, name by name).

    Args:
        candidates: to choose from; those that are not finite are left out.
        least_score: of what is kept.
        overlap: intersection over union above which two boxes of one name are one thing.
    """
    sound = np.isfinite(candidates.boxes).all(axis=1) & np.isfinite(candidates.scores)
    chosen = np.flatnonzero(sound & (candidates.scores >= least_score))
    order = chosen[np.argsort(-candidates.scores[chosen], kind="stable")][:MOST_CANDIDATES]
    kept: list[int] = []
    while len(order):
        best, order = order[0], order[1:]
        kept.append(int(best))
        others = candidates[order]
        same = others.names == candidates.names[best]
        order = order[~same | (_overlaps(candidates.boxes[best], others.boxes) <= overlap)]
    return np.array(kept, dtype=np.intp)


def _overlaps(box: Array, others: Array) -> Array:
    """Intersection over union of a box with others, shape (n,)."""
    begins, ends = np.maximum(box[:2], others[:, :2]), np.minimum(box[2:], others[:, 2:])
    shared = np.prod(np.maximum(ends - begins, 0.0), axis=1)
    areas = np.prod(np.maximum(others[:, 2:] - others[:, :2], 0.0), axis=1)
    own = np.prod(np.maximum(box[2:] - box[:2], 0.0))
    return (shared / np.maximum(own + areas - shared, 1e-9)).astype(np.float32)
