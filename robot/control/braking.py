# pyright: basic
"""Bring joints that move to rest: as soon as bounds on acceleration and jerk let them."""

from __future__ import annotations

import numpy as np
from ruckig import ControlInterface, InputParameter, Ruckig, Synchronization, Trajectory

from robot.se3 import Array


class Brake:
    """A time-optimal stop of every joint for itself, by Ruckig.

    Berscheid & Kröger, "Jerk-limited real-time trajectory generation with arbitrary target
    states", RSS 2021; here over velocity, so that the joints end wherever they come to rest.

    Attributes:
        duration_s: until the last joint rests.
    """

    def __init__(
        self, q: Array, qd: Array, qdd: Array, *, acceleration: float, jerk: float
    ) -> None:
        """Start from positions, velocities and accelerations, each (joints,).

        Args:
            q: positions [rad].
            qd: velocities [rad/s].
            qdd: accelerations [rad/s2].
            acceleration: the most for every joint [rad/s2].
            jerk: the most for every joint [rad/s3].

        Raises:
            RuckigError: if a value is not finite.
        """
        count = len(q)
        state = InputParameter(count)
        state.control_interface = ControlInterface.Velocity
        state.synchronization = Synchronization.No
        state.current_position = q.tolist()
        state.current_velocity = qd.tolist()
        state.current_acceleration = qdd.tolist()
        state.target_velocity = state.target_acceleration = [0.0] * count
        state.max_acceleration = [acceleration] * count
        state.max_jerk = [jerk] * count
        self._trajectory = Trajectory(count)
        Ruckig(count).calculate(state, self._trajectory)
        self.duration_s: float = self._trajectory.duration

    def at(self, time_s: float) -> tuple[Array, Array, Array]:
        """Positions, velocities and accelerations at a time from the start, each (joints,)."""
        q, qd, qdd = self._trajectory.at_time(time_s)
        return np.array(q), np.array(qd), np.array(qdd)
