"""What networks of YOLO's kind say, as boxes with scores: three layouts are known.

| output | shape, C names | a candidate |
|---|---|---|
| versions 8 to 12 | (1, 4 + C, N), or its transpose | centre x, y, width, height, a score a name |
| versions 5 to 7 | (1, N, 5 + C) | the same, with the score of being anything before them |
| end to end, 10 and 26 | (1, N, 6), N at most 1000 | x1, y1, x2, y2, score, number of the name |

Lengths are pixels of the network's picture.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float32]

MOST_END_TO_END = 1000
LARGEST_PX = 1e6
"""What is beyond that, or no number, is no box."""


@dataclass(frozen=True)
class Candidates:
    """Boxes x1, y1, x2, y2, shape (n, 4), with the number of the likeliest name, and its score."""

    boxes: Array
    names: NDArray[np.intp]
    scores: Array

    def __getitem__(self, chosen: NDArray[np.intp]) -> Candidates:
        """Some of them."""
        return Candidates(self.boxes[chosen], self.names[chosen], self.scores[chosen])


def decoded(output: Array, count: int) -> Candidates:
    """The candidates in a network's output; those that are no boxes with a score are left out.

    Args:
        output: of the network.
        count: of the names that it tells apart.

    Raises:
        ValueError: the output is of no layout that is known, for so many names.
    """
    if output.ndim != 3 or output.shape[0] != 1 or 0 in output.shape:
        raise ValueError(f"its output has shape {output.shape}, and not (1, ..., ...)")
    with np.errstate(over="ignore", invalid="ignore"):
        found = _laid_out(output[0], count)
        # NaN is not less.
        sane = (np.abs(found.boxes) < LARGEST_PX).all(axis=1) & np.isfinite(found.scores)
    return found[np.flatnonzero(sane)]


def _laid_out(rows: Array, count: int) -> Candidates:
    if rows.shape[1] == 5 + count:
        return _centred(rows[:, :4], rows[:, 5:] * rows[:, 4:5])
    if rows.shape[0] == 4 + count and rows.shape[0] < rows.shape[1]:
        return _centred(rows[:4].T, rows[4:].T)
    if rows.shape[1] == 4 + count and (count != 2 or len(rows) > MOST_END_TO_END):
        return _centred(rows[:, :4], rows[:, 4:])
    if rows.shape[1] == 6 and len(rows) <= MOST_END_TO_END:
        names = np.clip(np.nan_to_num(rows[:, 5]), 0, count - 1).astype(np.intp)
        return Candidates(rows[:, :4], names, rows[:, 4])
    raise ValueError(
        f"its output has shape {(1, *rows.shape)}, which does not fit {count} names in any layout "
        "of YOLO that is known"
    )


def _centred(boxes: Array, scores: Array) -> Candidates:
    centres, halves = boxes[:, :2], boxes[:, 2:] / np.float32(2.0)
    names = scores.argmax(axis=1)
    best = np.take_along_axis(scores, names[:, None], axis=1)[:, 0]
    corners = np.concatenate((centres - halves, centres + halves), axis=1)
    return Candidates(corners.astype(np.float32), names, best)
