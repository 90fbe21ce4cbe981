"""What the feet are committed to: twists that were given and have not reached the stance yet.

A landing is decided when the foot before it lifts, and the stance is the middle of both feet, so
what is told now shows in the stance over half a second later. A loop closed over the stance as it
is swings from side to side at that; closed over where the steps under way lead to, it does not
[Smith1957].
"""

from __future__ import annotations

from collections import deque

from executive.skills.motions.path_follower import Velocity
from robot.model.gait import Walking
from robot.se3 import SE3


class Committed:
    """Where the steps that are decided already lead to."""

    def __init__(self, walking: Walking) -> None:
        """Begin with none."""
        self._walking = walking
        step_s = walking.single_support_s + walking.double_support_s
        self._lag_s = walking.lag_steps * step_s
        self._told: deque[tuple[float, Velocity]] = deque()

    def told(self, twist: Velocity, *, now_s: float) -> None:
        """Take note of a twist that is given now; the gait bounds how fast it changes."""
        if self._told:
            since_s, before = self._told[-1]
            most_m_s = self._walking.acceleration_m_s2 * (now_s - since_s)
            most_rad_s = self._walking.turn_acceleration_rad_s2 * (now_s - since_s)
            twist = Velocity(
                _near(before.forward_m_s, twist.forward_m_s, most_m_s),
                _near(before.left_m_s, twist.left_m_s, most_m_s),
                _near(before.turn_rad_s, twist.turn_rad_s, most_rad_s),
            )
        self._told.append((now_s, twist))

    def ahead(self, X_WS: SE3, *, now_s: float) -> SE3:
        """The stance X_WS as it will be when what is told now reaches it."""
        while self._told and self._told[0][0] < now_s - self._lag_s:
            self._told.popleft()
        ahead = X_WS
        ends_s = [*(since_s for since_s, _ in self._told), now_s][1:]
        for (since_s, twist), end_s in zip(self._told, ends_s, strict=True):
            dt_s = end_s - since_s
            ahead = ahead @ SE3.from_xy_yaw(*(rate * dt_s for rate in twist))
        return ahead


def _near(before: float, wanted: float, most: float) -> float:
    return before + min(max(wanted - before, -most), most)
