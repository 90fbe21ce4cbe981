"""The robot's time as ROS has it: that of the wall's clock, in seconds and nanoseconds.

A simulated robot's time may pass more slowly than the wall's. What is sent has to lie in one time
all the same, or transforms cannot be put together: so the difference between the two is what it was
at the message that came fastest lately, and no stamp is older than the one before it.
"""

from __future__ import annotations

import math
from collections import deque

LATELY_S = 2.0


class Stamps:
    """Turns the robot's stamps into the wall's time."""

    def __init__(self) -> None:
        """Nothing came yet."""
        self._seen: deque[tuple[float, float]] = deque()
        self._offset_s = math.nan

    def saw(self, stamp_s: float, wall_s: float) -> None:
        """A message with that stamp came at that time of the wall [s since 1970]."""
        seen = self._seen
        seen.append((wall_s, wall_s - stamp_s))
        while wall_s - seen[0][0] > LATELY_S or wall_s < seen[0][0]:
            seen.popleft()
        self._offset_s = min(offset_s for _, offset_s in seen)

    @property
    def known(self) -> bool:
        """Whether anything came yet."""
        return math.isfinite(self._offset_s)

    def wall_s(self, stamp_s: float) -> float:
        """The time of the wall that a stamp stands for [s since 1970]; 0 before anything came."""
        return stamp_s + self._offset_s if self.known else 0.0


def time_of(wall_s: float) -> dict[str, int]:
    """A time [s since 1970] as builtin_interfaces/msg/Time; what is none is 0."""
    if not 0.0 <= wall_s < 2**31:
        return {"sec": 0, "nanosec": 0}
    whole = math.floor(wall_s)
    return {"sec": whole, "nanosec": min(999_999_999, math.floor((wall_s - whole) * 1e9))}
