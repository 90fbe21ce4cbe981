"""The body's recent states by stamp, so that a sensor's message meets the pose of its own time."""

from __future__ import annotations

import math
from bisect import bisect_left
from collections import deque

from robot.messages import BodyState
from robot.se3 import SE3, Quaternion, Vector3

LENGTH = 100
MAX_GAP_S = 0.1
RESTART_M = 0.3


class BodyHistory:
    """Two seconds of body states at 50 Hz.

    Attributes:
        restarts: how often the odometry frame was left for a new one (the base jumped in it).
    """

    def __init__(self) -> None:
        self.restarts = 0
        self._states: deque[BodyState] = deque(maxlen=LENGTH)

    @property
    def newest(self) -> BodyState | None:
        """The last state added."""
        return self._states[-1] if self._states else None

    def add(self, state: BodyState) -> None:
        """Add a state; one that is not newer than the last is ignored."""
        newest = self.newest
        if newest is not None:
            if state.stamp_s <= newest.stamp_s:
                return
            if math.dist(state.X_NB.p, newest.X_NB.p) > RESTART_M:
                self.restarts += 1
                self._states.clear()
        self._states.append(state)

    def covers(self, stamp_s: float) -> bool:
        """Whether a state at or after that stamp has come (so that waiting longer is no use)."""
        return bool(self._states) and self._states[-1].stamp_s >= stamp_s

    def base_at(self, stamp_s: float) -> SE3 | None:
        """X_NB at a stamp, interpolated; None if no state is near enough in time."""
        pair = self._around(stamp_s)
        if pair is None:
            return None
        before, after = pair
        span_s = after.stamp_s - before.stamp_s
        share = 0.0 if span_s <= 0.0 else (stamp_s - before.stamp_s) / span_s
        return blend(before.X_NB, after.X_NB, min(1.0, max(0.0, share)))

    def joints_at(self, stamp_s: float) -> tuple[float, ...] | None:
        """Joint positions nearest to a stamp, in motor order [rad]; None as for `base_at`."""
        pair = self._around(stamp_s)
        if pair is None:
            return None
        return min(pair, key=lambda state: abs(state.stamp_s - stamp_s)).q_rad

    def _around(self, stamp_s: float) -> tuple[BodyState, BodyState] | None:
        """The states before and after a stamp, or the nearest one twice."""
        states = self._states
        index = bisect_left(states, stamp_s, key=lambda state: state.stamp_s)
        before = states[index - 1] if index > 0 else None
        after = states[index] if index < len(states) else None
        before, after = before or after, after or before
        if before is None or after is None:
            return None
        nearest_s = min(abs(before.stamp_s - stamp_s), abs(after.stamp_s - stamp_s))
        return (before, after) if nearest_s <= MAX_GAP_S else None


def blend(X_first: SE3, X_second: SE3, share: float) -> SE3:
    """A pose between two near ones: linear in position, normalised linear in the quaternion."""
    (x0, y0, z0), (x1, y1, z1) = X_first.p, X_second.p
    p: Vector3 = (x0 + share * (x1 - x0), y0 + share * (y1 - y0), z0 + share * (z1 - z0))
    first, second = X_first.quat_wxyz, X_second.quat_wxyz
    dot = sum(a * b for a, b in zip(first, second, strict=True))
    sign = 1.0 if dot >= 0.0 else -1.0
    mixed = [(1.0 - share) * a + share * sign * b for a, b in zip(first, second, strict=True)]
    norm = math.sqrt(sum(value * value for value in mixed))
    w, i, j, k = (value / norm for value in mixed)
    quat_wxyz: Quaternion = (w, i, j, k)
    return SE3(p, quat_wxyz)
