"""The arm of a simulated person: two links and a hand that are put where the hand is to be.

The links are geoms of the person's body, moved within it. So an arm stays what it was at rest: part
of one body, sensed and seen as the person, hard where a link is. Hand and fingers are only drawn:
what they do to an object is a force (`sim.grip`).
"""

from __future__ import annotations

import math
from typing import Literal

import mujoco
import numpy as np

from robot.se3 import Array

ArmSide = Literal["left", "right"]
HAND_M = 0.09
"""From the end of the forearm to the middle of the palm, of a figure of 1.70 m."""
SPARE_M = 0.01
"""How much less than straight an arm is at most, so that the elbow has a side to be on."""
PALM_M = 0.047
"""From the middle of the palm to its front, where what is held begins."""
FINGERS_M = 0.055
"""From the middle of the palm to that of the fingers, along the hand."""
CLEAR_M = 0.011
"""Between the axis of a finger and what it lies on: its radius."""
OPEN_M = 0.03
"""How far open fingers are from what they are about to close on."""


def links(person_id: str, side: ArmSide) -> tuple[str, str, str, str, str]:
    """Names of an arm's geoms: upper arm, forearm, palm, fingers, thumb."""
    parts = ("upper_arm", "forearm", "palm", "fingers", "thumb")
    upper, fore, palm, fingers, thumb = (f"person/{person_id}/{side}_{part}" for part in parts)
    return upper, fore, palm, fingers, thumb


class PersonArm:
    """One arm. All points are in the person's frame: x ahead, z up, the origin between the feet.

    Attributes:
        shoulder: where it begins, shape (3,) [m].
        palm: where the middle of the palm is now, shape (3,) [m].
        reach_m: how far the wrist comes from the shoulder.
        hand_m: from the wrist to the middle of the palm.
    """

    def __init__(self, model: mujoco.MjModel, person_id: str, side: ArmSide) -> None:
        """Take the arm as it hangs."""
        self._model = model
        self._geoms = [int(model.geom(name).id) for name in links(person_id, side)]
        upper, fore, palm = self._geoms[:3]
        self._rest = [(model.geom_pos[g].copy(), model.geom_quat[g].copy()) for g in self._geoms]
        self._lengths_m = 2.0 * model.geom_size[upper, 1], 2.0 * model.geom_size[fore, 1]
        self.hand_m = math.dist(_ends(model, fore)[1], model.geom_pos[palm])
        self._out = 1.0 if side == "left" else -1.0
        self.shoulder: Array = _ends(model, upper)[0]
        self.hanging: Array = model.geom_pos[palm].copy()
        self.palm: Array = self.hanging.copy()
        self.reach_m = float(sum(self._lengths_m)) - SPARE_M

    def put(self, palm: Array, towards: Array, *, half_m: float, closed: float) -> None:
        """Bring the palm to a point, as near as the arm is long, and the fingers about something.

        Args:
            palm: where to, shape (3,).
            towards: a unit vector from the palm into what is held, shape (3,).
            half_m: half the width of that.
            closed: 0 with open fingers, 1 with the fingers on it.
        """
        upper_m, fore_m = self._lengths_m
        wrist = palm - self.hand_m * towards
        off = wrist - self.shoulder
        far_m = max(float(np.linalg.norm(off)), 1e-6)
        along = off / far_m
        reach_m = min(far_m, self.reach_m)
        # two links and a distance make a triangle; the elbow hangs down and out of it
        lead_m = (upper_m**2 - fore_m**2 + reach_m**2) / (2.0 * reach_m)
        lead_m = min(lead_m, upper_m)
        down = np.array([0.0, 0.5 * self._out, -1.0])
        down -= (down @ along) * along
        drop_m = math.sqrt(max(upper_m**2 - lead_m**2, 0.0))
        elbow = self.shoulder + lead_m * along + drop_m * down / np.linalg.norm(down)
        wrist = self.shoulder + reach_m * along
        self.palm = wrist + self.hand_m * towards
        self._lay(0, 0.5 * (self.shoulder + elbow), elbow - self.shoulder)
        self._lay(1, 0.5 * (elbow + wrist), wrist - elbow)
        self._lay(2, self.palm, towards)
        self._close(towards, half_m + CLEAR_M + OPEN_M * (1.0 - closed))

    def hang(self) -> None:
        """Let the arm down to where it was at first."""
        self.palm = self.hanging.copy()
        for geom, (p, quat) in zip(self._geoms, self._rest, strict=True):
            self._model.geom_pos[geom], self._model.geom_quat[geom] = p, quat

    def _close(self, towards: Array, apart_m: float) -> None:
        """Fingers on one side of what is before the palm, the thumb on the other."""
        side = np.cross([0.0, 0.0, 1.0], towards)
        side /= max(float(np.linalg.norm(side)), 1e-6)
        for index, sign in ((3, 1.0), (4, -1.0)):
            middle = self.palm + FINGERS_M * towards + sign * apart_m * side
            self._lay(index, middle, towards)

    def _lay(self, index: int, middle: Array, axis: Array) -> None:
        """Put a capsule with its middle at a point and along an axis."""
        geom = self._geoms[index]
        self._model.geom_pos[geom] = middle
        mujoco.mju_quatZ2Vec(self._model.geom_quat[geom], axis / np.linalg.norm(axis))


def _ends(model: mujoco.MjModel, geom: int) -> tuple[Array, Array]:
    """The upper and the lower end of a capsule's axis."""
    axis = np.zeros(3)
    mujoco.mju_rotVecQuat(axis, np.array([0.0, 0.0, 1.0]), model.geom_quat[geom])
    half = model.geom_size[geom, 1] * axis
    one, other = model.geom_pos[geom] + half, model.geom_pos[geom] - half
    return (one, other) if one[2] > other[2] else (other, one)
