"""How surely each foot stands, by the force under it."""

from __future__ import annotations

from robot.se3 import Array

TAKE = 0.15  # share of the weight from which a foot stands,
RELEASE = 0.08  # below which it does not,
SURE = 0.35  # and from which it stands as surely as can be


class Contacts:
    """Two feet with hysteresis.

    Attributes:
        load: share of the weight on each foot, left and right.
    """

    def __init__(self, weight_n: float) -> None:
        """Of a robot of that weight, both feet in the air."""
        self.load = [0.0, 0.0]
        self._weight_n = weight_n
        self._standing = [False, False]

    def update(self, force_n: Array) -> tuple[float, float]:
        """Take the upward force on the left and the right foot, shape (2,); 0 (air) to 1 each."""
        left, right = force_n.tolist()
        return self._trust(0, left / self._weight_n), self._trust(1, right / self._weight_n)

    def _trust(self, side: int, load: float) -> float:
        self.load[side] = load
        standing = load > (RELEASE if self._standing[side] else TAKE)
        self._standing[side] = standing
        return max(0.01, min(1.0, (load - RELEASE) / (SURE - RELEASE))) if standing else 0.0
