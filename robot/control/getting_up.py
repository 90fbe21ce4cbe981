"""Getting up from the floor: keyframes of the robot's description, played at motor level.

Nothing here balances. A motion moves joint by joint to postures that the description names, slowly
enough for every joint, with the description's gains; then it is looked again how the robot lies.
On its back or a side it first rolls onto its front, from there it pushes itself up into a squat on
both soles; there the whole-body stand takes over. A motion that is missed is followed by the one
for how the robot then lies, as often as the description allows.
"""

from __future__ import annotations

import math
from typing import Literal

import numpy as np

from robot.kinematics.dynamics import Dynamics
from robot.model.body import BodyModel
from robot.model.keyframes import Keyframe
from robot.se3 import Array

PEAK = 1.875
"""The fastest speed of a minimum-jerk motion, as a multiple of its mean."""
SQUAT_UPRIGHT = 0.9  # 26 degrees
FLAT = 0.97
LEVEL_M = 0.02
EDGE_M = 0.02
"""How far inside the ends of the soles the centre of mass has to be."""

Outcome = Literal["running", "on its feet", "failed"]


class GettingUp:
    """One attempt to get up, from `__init__` to an outcome.

    Attributes:
        outcome: "on its feet" when the whole body may take over.
        resting: whether the motors are to damp until the body lies still.
        q, qd: targets of the motors, shape (n,).
        stage: what it does, for people.
    """

    def __init__(self, body: BodyModel) -> None:
        """Begin by lying still."""
        plan = body.description.getting_up
        assert plan is not None
        self.body = body
        self.outcome: Outcome = "running"
        self.resting = True
        self.q: Array = np.zeros(body.count)
        self.qd: Array = np.zeros(body.count)
        self.stage = ""
        self._plan = plan
        self._tries = 0
        self._keyframes: list[Keyframe] = []
        self._goal = self._from = self.q
        self._duration_s = self._end_s = self._time_s = self._still_s = 0.0

    def update(self, dt_s: float, dynamics: Dynamics, q: Array, qd: Array) -> None:
        """Advance by `dt_s`; `q` and `qd` are the measured joints, shape (n,)."""
        plan = self._plan
        self._time_s += dt_s
        up_B = dynamics.data.xmat[self.body.base_body].reshape(3, 3)[2]
        if self.resting:
            turning = float(np.abs(dynamics.data.qvel[3:6]).max())
            still = max(turning, float(np.abs(qd).max())) < plan.still_rad_s
            self._still_s = self._still_s + dt_s if still else 0.0
            if self._still_s >= plan.rest_s or self._time_s >= plan.rest_limit_s:
                self._choose(up_B, q)
            return
        if self._time_s < self._end_s:
            self._interpolate()
            return
        if self._keyframes and self._is(self._keyframes[0].needs, up_B):
            self._next()
        elif not self._keyframes and on_its_feet(dynamics, self.body):
            self.outcome = "on its feet"
            self.qd[:] = 0.0
        else:
            self._choose(up_B, q)

    def miss(self) -> None:
        """What is under way cannot go on: look again how the robot lies."""
        self.resting = True
        self._time_s = self._still_s = 0.0

    def _choose(self, up_B: Array, q: Array) -> None:
        """Begin the motion for how the robot lies."""
        if self._tries == self._plan.tries:
            self.outcome = "failed"
            return
        self._tries += 1
        self.resting = False
        motions = self._plan.motions
        over = motions.left if up_B[1] <= 0.0 else motions.right
        self._keyframes = list(motions.front if up_B[0] < -self._plan.lying else over)
        self._goal = q.copy()
        self._next()

    def _next(self) -> None:
        """Begin the next keyframe, where the last one's targets are."""
        keyframe = self._keyframes.pop(0)
        self.stage = keyframe.name
        body, names = self.body, self.body.description.motor_names
        self._from = self._goal
        goal = self._from.copy()
        for name, value in keyframe.posture.items():
            goal[names.index(name)] = value
        self._goal = np.minimum(np.maximum(goal, body.lower_rad), body.upper_rad)
        rate = np.abs(self._goal - self._from) / (self._plan.speed * body.velocity_limit_rad_s)
        self._duration_s = max(keyframe.duration_s, PEAK * float(rate.max()))
        self._end_s = self._duration_s + keyframe.hold_s
        self._time_s = 0.0
        self._interpolate()

    def _interpolate(self) -> None:
        """Minimum jerk between two postures."""
        t = min(1.0, self._time_s / self._duration_s)
        way = self._goal - self._from
        self.q = self._from + t**3 * (10.0 - 15.0 * t + 6.0 * t * t) * way
        self.qd = 30.0 * t * t * (1.0 - t) ** 2 / self._duration_s * way

    def _is(self, needs: Literal["front", "upright"] | None, up_B: Array) -> bool:
        """Whether the trunk is as a keyframe needs it."""
        if needs is None:
            return True
        plan = self._plan
        return bool(up_B[0] < -plan.lying if needs == "front" else up_B[2] > plan.upright)


def on_its_feet(dynamics: Dynamics, body: BodyModel) -> bool:
    """Whether the trunk is upright over two flat soles at one height, the mass between their ends.

    Only what is true of the body in any frame with z up is asked, not where it is.
    """
    upright = float(dynamics.data.xmat[body.base_body].reshape(3, 3)[2, 2]) > SQUAT_UPRIGHT
    left, right = dynamics.sole_position
    flat = all(float(rotation[2, 2]) > FLAT for rotation in dynamics.sole_rotation)
    if not upright or not flat or abs(float(left[2] - right[2])) > LEVEL_M:
        return False
    heading = dynamics.sole_rotation[0][:2, 0] + dynamics.sole_rotation[1][:2, 0]
    x, y = float(heading[0]), float(heading[1])
    norm = math.hypot(x, y)
    off = dynamics.com[:2] - 0.5 * (left[:2] + right[:2])
    ahead_m = abs(float(off[0]) * x + float(off[1]) * y) / norm
    aside_m = abs(float(off[1]) * x - float(off[0]) * y) / norm
    foot = body.description.feet["left"]
    half_width_m = 0.5 * float(np.linalg.norm(left[:2] - right[:2]))
    return ahead_m < foot.half_length_m - EDGE_M and aside_m < half_width_m
