"""Where the floor was free: what stands there now has come, and furniture does not."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from robot.perception.company.returns import Sweep
from robot.se3 import Array

CELL_M, REACH_M = 0.15, 12.0
"""Of the grid, and how far it goes around where the robot was first."""
SEEN_M, SHORT_M, STEP_M = 5.0, 0.35, 0.15
"""Beams tell of the floor up to there, and up to so far before what they hit."""
EMPTY_M = 3.0
"""So far the floor is taken to be free under a beam that does not come back."""
SCANS = 3
MOST = 20


class FreeFloor:
    """How many scans went over each cell of the floor, since something stood in it last."""

    def __init__(self) -> None:
        """Nothing is known."""
        self.forget()

    def forget(self) -> None:
        """Forget it all: it was told by a pose that was wrong."""
        side = 2 * round(REACH_M / CELL_M)
        self._scans = np.zeros((side, side), np.int16)
        self._origin: Array | None = None

    def look(self, swept: Sweep) -> None:
        """Take a scan."""
        if self._origin is None:
            self._origin = swept.eye_W.copy()
        steps_m = np.arange(STEP_M, SEEN_M, STEP_M)
        reach_m = np.concatenate((swept.ranges_m - SHORT_M, np.full(len(swept.empty_rad), EMPTY_M)))
        beams, steps = np.nonzero(steps_m[None, :] < reach_m[:, None])
        bearings = np.concatenate((swept.bearings_rad, swept.empty_rad))[beams]
        along = np.stack([np.cos(bearings), np.sin(bearings)], axis=1)
        cells = self._cells(swept.eye_W + steps_m[steps, None] * along)
        over = np.zeros_like(self._scans)
        over[cells[:, 0], cells[:, 1]] = 1
        self._scans = np.minimum(self._scans + over, MOST)

    def occupy(self, p_W: Array) -> None:
        """Take it that something has stood at a point of the floor for a while."""
        if self._origin is not None:
            i, j = self._cells(p_W[None])[0]
            self._scans[max(i - 2, 0) : i + 3, max(j - 2, 0) : j + 3] = 0

    def was_free(self, p_W: Array) -> bool:
        """Whether a point of the floor and all about it was free."""
        if self._origin is None:
            return False
        i, j = self._cells(p_W[None])[0]
        around = self._scans[max(i - 1, 0) : i + 2, max(j - 1, 0) : j + 2]
        return bool(around.size and around.min() >= SCANS)

    def _cells(self, points: Array) -> NDArray[np.intp]:
        assert self._origin is not None
        side = len(self._scans)
        cells = np.floor((points - self._origin + REACH_M) / CELL_M).astype(np.intp)
        return np.clip(cells, 0, side - 1)
