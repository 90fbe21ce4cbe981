"""A cubic spline through joint positions, at rest at both ends.

scipy has it too, but loading `scipy.interpolate` takes longer than everything else that the
controller, or a planner, loads.
"""

from __future__ import annotations

import numpy as np

from robot.se3 import Array


class ClampedSpline:
    """C2 cubic spline with zero velocity at its ends (de Boor, "A Practical Guide to Splines").

    Attributes:
        times_s: knots, growing, shape (k,), k >= 2.
    """

    def __init__(self, times_s: Array, positions: Array) -> None:
        """Solve for the velocities at the knots; `positions` shape (k, joints)."""
        self.times_s = times_s
        step = np.diff(times_s)
        slope = np.diff(positions, axis=0) / step[:, None]
        count = len(times_s)
        matrix = np.eye(count)
        right = np.zeros_like(positions)
        for i in range(1, count - 1):
            matrix[i, i - 1] = step[i]
            matrix[i, i] = 2.0 * (step[i - 1] + step[i])
            matrix[i, i + 1] = step[i - 1]
            right[i] = 3.0 * (step[i] * slope[i - 1] + step[i - 1] * slope[i])
        velocity = np.linalg.solve(matrix, right)
        self._position = positions
        self._velocity = velocity
        width = step[:, None]
        self._quadratic = (3.0 * slope - 2.0 * velocity[:-1] - velocity[1:]) / width
        self._cubic = (velocity[:-1] + velocity[1:] - 2.0 * slope) / width**2

    def at(self, time_s: float) -> tuple[Array, Array, Array]:
        """Position, velocity and acceleration at a time within the knots, each (joints,)."""
        last = len(self.times_s) - 2
        i = min(last, max(0, int(np.searchsorted(self.times_s, time_s, side="right")) - 1))
        t = time_s - float(self.times_s[i])
        v, b, c = self._velocity[i], self._quadratic[i], self._cubic[i]
        position = self._position[i] + t * (v + t * (b + t * c))
        return position, v + t * (2.0 * b + 3.0 * t * c), 2.0 * b + 6.0 * t * c

    def sample(self, at_s: Array, *, derivative: int = 0) -> Array:
        """Positions, or their `derivative` (up to 2), at many times (m,), shape (m, joints)."""
        i = np.clip(np.searchsorted(self.times_s, at_s, side="right") - 1, 0, len(self.times_s) - 2)
        t = (at_s - self.times_s[i])[:, None]
        v, b, c = self._velocity[i], self._quadratic[i], self._cubic[i]
        if derivative == 0:
            return self._position[i] + t * (v + t * (b + t * c))
        return v + t * (2.0 * b + 3.0 * t * c) if derivative == 1 else 2.0 * b + 6.0 * t * c
