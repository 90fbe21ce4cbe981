"""How the trunk is turned against the feet: by the waist where that can, by the hips else."""

from __future__ import annotations

import math

import numpy as np

from robot.model.body import BodyModel
from robot.se3 import Array


class Trunk:
    """Yaw and pitch of the trunk on their way to what is wanted, at a bounded rate.

    Attributes:
        waist: wanted joints of the waist [rad], in its group's order: a view that is written to.
        moves: whether they are still on their way.
    """

    def __init__(self, body: BodyModel, waist: Array) -> None:
        """Stand straight."""
        self._body = body
        self.waist = waist
        self.moves = False
        self._waist_goal: Array = waist.copy()
        self._base: Array = np.zeros(2)  # yaw and pitch of the base against the feet
        self._base_goal: Array = np.zeros(2)

    def turn(self, yaw_rad: float, pitch_rad: float) -> None:
        """Take a new goal."""
        goal = self._body.leaning(yaw_rad, pitch_rad)
        self._waist_goal = goal.waist_rad
        self._base_goal = np.array((goal.base_yaw_rad, goal.base_pitch_rad))
        self.moves = True

    def differs(self) -> bool:
        """Whether the goal is another than where it is."""
        off = np.abs(self._waist_goal - self.waist).max(initial=0.0)
        return max(float(off), float(np.abs(self._base_goal - self._base).max())) > 1e-3

    def ramp(self, most_rad: float) -> None:
        """Go on towards the goal, no joint by more than so much."""
        if not self.moves:
            return
        change = self._waist_goal - self.waist
        self.waist += np.minimum(np.maximum(change, -most_rad), most_rad)
        turn = self._base_goal - self._base
        self._base += np.minimum(np.maximum(turn, -most_rad), most_rad)
        left_rad = max(float(np.abs(change).max(initial=0.0)), float(np.abs(turn).max()))
        self.moves = left_rad > 1e-9

    def write_base(self, wanted_wxyz: Array, heading_rad: float) -> None:
        """The base's orientation in N, shape (4,), over feet that face `heading_rad`."""
        yaw_rad, pitch_rad = self._base.tolist()
        half_yaw, half_pitch = 0.5 * (heading_rad + yaw_rad), 0.5 * pitch_rad
        cosine, sine = math.cos(half_pitch), math.sin(half_pitch)
        wanted_wxyz[0] = cosine * math.cos(half_yaw)
        wanted_wxyz[1] = -sine * math.sin(half_yaw)
        wanted_wxyz[2] = sine * math.cos(half_yaw)
        wanted_wxyz[3] = cosine * math.sin(half_yaw)
