"""How surely each foot stands, by the force under it."""

from __future__ import annotations

from robot.se3 import Array

TAKE = 0.15  # share of the weight from which a foot stands,
RELEASE = 0.08  # below which it does not,
SURE = 0.35  # and from which it stands as surely as can be
TARE_S = 0.05  # a third of the time for which a foot surely hangs in a step
MOST_OFFSET = 0.12  # share of the weight; what is more is the floor


class Contacts:
    """Two feet with hysteresis, whose force sensors are tared while they hang in the air.

    Attributes:
        load: share of the weight on each foot, left and right.
    """

    def __init__(self, weight_n: float, feet_n: tuple[float, float] = (0.0, 0.0)) -> None:
        """Of a robot of that weight, both feet in the air; `feet_n`: what hangs on each sensor."""
        self.load = [0.0, 0.0]
        self._weight_n = weight_n
        self._feet_n = feet_n
        self._offset_n = [0.0, 0.0]
        self._standing = [False, False]

    def update(self, force_n: Array) -> tuple[float, float]:
        """Take the upward force on the left and the right foot, shape (2,); 0 (air) to 1 each."""
        left, right = force_n.tolist()
        return self._trust(0, left), self._trust(1, right)

    def tare(self, side: int, force_n: float, dt_s: float) -> None:
        """Learn what a sensor is off by, of a foot that hangs in the air for `dt_s`.

        An offset of 2 % of the weight would be taken for the floor, and the step for ended.
        """
        most_n, offset_n = MOST_OFFSET * self._weight_n, self._offset_n[side]
        off_n = max(-most_n, min(most_n, force_n + self._feet_n[side]))
        self._offset_n[side] += dt_s / (TARE_S + dt_s) * (off_n - offset_n)

    def _trust(self, side: int, force_n: float) -> float:
        load = (force_n - self._offset_n[side]) / self._weight_n
        self.load[side] = load
        standing = load > (RELEASE if self._standing[side] else TAKE)
        self._standing[side] = standing
        return max(0.01, min(1.0, (load - RELEASE) / (SURE - RELEASE))) if standing else 0.0
