"""Whether reported speeds are those of the reported positions: else a scale is wrong."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from robot.se3 import Array

Flags: TypeAlias = npt.NDArray[np.bool_]
WINDOW_S = 0.05
SLACK_RAD = 0.02
"""Steps of position and speed, added up over a window, and a reply or two that were lost."""
SLACK_SHARE = 0.25


class SpeedCheck:
    """Adds speeds up over windows and compares with how far joints went.

    Attributes:
        wrong: joints that differed in the last two windows in a row, shape (n,).
        moved: joints that ever moved far enough to tell, shape (n,).
        ratio: of what the speeds say to how far they went, over all windows that told, shape (n,).
    """

    def __init__(self, count: int) -> None:
        """Of so many joints."""
        self.wrong: Flags = np.zeros(count, np.bool_)
        self.moved: Flags = np.zeros(count, np.bool_)
        self._before: Flags = np.zeros(count, np.bool_)
        self._told: Array = np.zeros(count)
        self._said: Array = np.zeros(count)
        self._gone: Array = np.zeros(count)
        self._torn: Flags = np.zeros(count, np.bool_)
        self._began: Array | None = None
        self._began_s = self._last_s = 0.0

    @property
    def ratio(self) -> Array:
        """NaN of joints that never moved."""
        nan = np.full_like(self._said, np.nan)
        return np.divide(self._said, self._gone, out=nan, where=self._gone > SLACK_RAD)

    def feel(self, stamp_s: float, q: Array, qd: Array, misses: npt.NDArray[np.intp]) -> None:
        """A new state of all joints, shape (n,) each.

        Args:
            stamp_s: when.
            q: where they are.
            qd: how fast they say that they move.
            misses: periods in a row without a reply. One is bridged; a window with more tells
                nothing, as nobody knows how fast the joint was meanwhile.
        """
        self._torn = self._torn | (misses > 1)
        if self._began is None:
            self._began, self._began_s, self._last_s = q.copy(), stamp_s, stamp_s
            return
        self._told += qd * (stamp_s - self._last_s)
        self._last_s = stamp_s
        if stamp_s - self._began_s < WINDOW_S:
            return
        gone = q - self._began
        larger = np.maximum(np.abs(gone), np.abs(self._told))
        differs = (np.abs(gone - self._told) > SLACK_RAD + SLACK_SHARE * larger) & ~self._torn
        self.wrong, self._before = differs & self._before, differs
        far = (larger > SLACK_RAD) & ~self._torn
        self.moved = self.moved | far
        self._gone += np.where(far, np.abs(gone), 0.0)
        self._said += np.where(far, self._told * np.sign(gone), 0.0)
        self._began, self._began_s = q.copy(), stamp_s
        self._told[:] = 0.0
        self._torn[:] = False
