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
        self._went: Array = np.zeros(count)
        self._said: Array = np.zeros(count)
        self._gone: Array = np.zeros(count)
        self._known: Flags = np.zeros(count, np.bool_)
        self._last_q: Array | None = None
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
            misses: periods in a row without a reply. One is bridged; what a joint did in more is
                left out, as nobody knows how fast it was meanwhile.
        """
        known = misses <= 1
        if self._last_q is None:
            self._last_q, self._began_s, self._last_s, self._known = (
                q.copy(),
                stamp_s,
                stamp_s,
                known,
            )
            return
        counts = known & self._known
        self._told += np.where(counts, qd * (stamp_s - self._last_s), 0.0)
        self._went += np.where(counts, q - self._last_q, 0.0)
        self._last_q, self._last_s, self._known = q.copy(), stamp_s, known
        if stamp_s - self._began_s < WINDOW_S:
            return
        larger = np.maximum(np.abs(self._went), np.abs(self._told))
        differs = np.abs(self._went - self._told) > SLACK_RAD + SLACK_SHARE * larger
        self.wrong, self._before = differs & self._before, differs
        far = larger > SLACK_RAD
        self.moved = self.moved | far
        self._gone += np.where(far, np.abs(self._went), 0.0)
        self._said += np.where(far, self._told * np.sign(self._went), 0.0)
        self._began_s = stamp_s
        self._told[:] = self._went[:] = 0.0
