"""The ground under the feet: a floor with a height and a slope, and what each sole stands on."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from robot.se3 import Array


class Ground(NamedTuple):
    """The floor around the feet, a plane, and how high each sole is.

    Attributes:
        x_m, y_m: where in N the floor has its height.
        height_m: of the floor there, in N.
        along, across: how it rises towards x and y of N [m/m].
        soles_m: heights of the left and the right sole in N, on the floor or on something.
    """

    x_m: float
    y_m: float
    height_m: float
    along: float
    across: float
    soles_m: tuple[float, float]

    def under(self, x_m: float, y_m: float) -> float:
        """Height of the floor at a place of N [m]."""
        return self.height_m + self.along * (x_m - self.x_m) + self.across * (y_m - self.y_m)


LEVEL = Ground(0.0, 0.0, 0.0, 0.0, 0.0, (0.0, 0.0))


Variances = tuple[float, float, float]
"""Of two tilts [rad²] and a height [m²]."""


def shares(off: Array, covariances: list[Array], before: list[float]) -> list[float]:
    """How likely each of some explanations is of what was seen.

    Args:
        off: what a sole is off the floor: two tilts [rad] and a height [m], shape (3,).
        covariances: of that under each explanation, shape (3, 3) each.
        before: how likely each was before.
    """
    logs = [
        math.log(share) - 0.5 * (float(off.dot(np.linalg.solve(S, off))) + _log_size(S))
        for S, share in zip(covariances, before, strict=True)
    ]
    most = max(logs)
    parts = [math.exp(one - most) for one in logs]
    whole = sum(parts)
    return [part / whole for part in parts]


def _log_size(S: Array) -> float:
    return math.log(float(np.linalg.det(S)))
