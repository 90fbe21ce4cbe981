"""Positions that nobody can have come to are not believed, unless a motor insists."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from robot.se3 import Array

JUMPS_BELIEVED = 3
"""So many in a row that agree with each other are where the joint is."""
JUMP_SLACK_RAD = 0.05
FASTER = 1.5
"""Than its fastest, at most, a motor may turn from one reply to the next."""


class Jumps:
    """Of all motors of a map.

    Attributes:
        count: replies in a row that were too far from the one before, shape (n,).
    """

    def __init__(self, fastest_rad_s: Array) -> None:
        """Of motors that turn at most so fast, shape (n,)."""
        self.count: npt.NDArray[np.intp] = np.zeros(len(fastest_rad_s), np.intp)
        self._allowed: Array = FASTER * fastest_rad_s

    def calm(
        self, which: npt.NDArray[np.intp], moved_rad: Array, since_s: Array
    ) -> npt.NDArray[np.bool_] | None:
        """Whose new position is believed, shape (k,); None: everybody's.

        Args:
            which: motors that told one, each once, shape (k,).
            moved_rad: how far from the one before, shape (k,).
            since_s: how long after it, shape (k,).
        """
        jumped = np.abs(moved_rad) > JUMP_SLACK_RAD + self._allowed[which] * since_s
        if not jumped.any():
            self.count[which] = 0
            return None
        jumped &= self.count[which] < JUMPS_BELIEVED
        self.count[which[jumped]] += 1
        calm = ~jumped
        self.count[which[calm]] = 0
        return calm
