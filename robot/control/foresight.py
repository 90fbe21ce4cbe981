"""The body as it will be when what is computed now acts.

Motors obey late, and a command is held until the next one. A controller that looks at the body as
measured then acts for a past one, which takes its damping away: of six robots of the reality
`harsh` three fell within half a minute. So base and joints are moved on, by their velocities and
by the accelerations that were planned and are still to come: a Smith predictor whose model is the
whole-body programme's own [Smith1957] (docs/control.md).
"""

from __future__ import annotations

import mujoco
import numpy as np

from robot.kinematics.dynamics import Dynamics
from robot.se3 import Array

HOLD_SHARE = 0.5  # of the time for which a command is held: it acts from its begin to its end


class Foresight:
    """Remembers accelerations that were planned, and moves a measured body on by them."""

    def __init__(self) -> None:
        """Nothing was planned yet."""
        self._planned: list[tuple[float, Array]] = []

    def plan(self, now_s: float, acc: Array) -> None:
        """What the body was told to do, by dof, shape (nv,), from the measurement of `now_s`."""
        self._planned.append((now_s, acc))

    def forget(self) -> None:
        """Nothing that was planned comes: other hands have the motors."""
        self._planned.clear()

    def move_on(self, dynamics: Dynamics, now_s: float, delay_s: float, *, hold_s: float) -> None:
        """Move what was measured at `now_s` on; after it, the kinematics are computed anew.

        Args:
            dynamics: base and joints as measured, which are moved.
            now_s: of the measurement.
            delay_s: from a measurement to its torque; 0: nothing is done.
            hold_s: how long a command is held.
        """
        planned, begin_s = self._planned, now_s - delay_s
        while len(planned) > 1 and planned[1][0] <= begin_s:
            planned.pop(0)
        if delay_s <= 0.0:
            return
        data, model = dynamics.data, dynamics.body.model
        gain = np.zeros(model.nv)
        for k, (since_s, acc) in enumerate(planned):
            until_s = planned[k + 1][0] if k + 1 < len(planned) else now_s
            if until_s > since_s:
                gain += (until_s - max(since_s, begin_s)) * acc
        ahead_s = delay_s + HOLD_SHARE * hold_s
        gain *= ahead_s / delay_s
        data.qvel += 0.5 * gain
        mujoco.mj_integratePos(model, data.qpos, data.qvel, ahead_s)
        data.qvel += 0.5 * gain
        dynamics.kinematics()
