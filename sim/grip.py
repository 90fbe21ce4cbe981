"""What a simulated person's hand does to an object: a soft, bounded hold that can pull.

A hand that was a body of infinite mass would push whatever it met with any force. This one is a
spring and a damper between the object and where the hand has it, never stronger than a person who
takes a cup: so a robot that does not let go feels `PULL_N` and no more.
"""

from __future__ import annotations

import mujoco
import numpy as np

from robot.physics import GRAVITY_M_S2
from robot.se3 import Array

PULL_N = 8.0
"""Beside the weight: well above the 3 N that a robot feels for, and a firm tug to a person."""
STIFF_RAD_S = 30.0
"""Frequency of the hold: 2 cm off pull a cup of 0.25 kg with 4.5 N; far below what 2 ms can do."""
DAMPED = 0.9


class Grip:
    """One hand on one object.

    Attributes:
        at: where the hand wants the object's middle in the world, shape (3,) [m].
        share: how much of the weight the hand bears, 0 to 1.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, body: int) -> None:
        """Take hold of it where it is, without a force."""
        self._data, self.body = data, body
        joint = int(model.body_jntadr[body])
        self._q, self._v = int(model.jnt_qposadr[joint]), int(model.jnt_dofadr[joint])
        self._mass_kg = float(model.body_mass[body])
        self._inertia = float(np.max(model.body_inertia[body]))
        self.at: Array = self.where.copy()
        self.share = 0.0

    @property
    def where(self) -> Array:
        """Where the object's middle is, shape (3,) [m]."""
        return self._data.qpos[self._q : self._q + 3]

    @property
    def pull_n(self) -> Array:
        """What the hand pulls with beside bearing the weight, shape (3,) [N]."""
        speed = self._data.qvel[self._v : self._v + 3]
        stiff = self._mass_kg * STIFF_RAD_S**2
        damp = 2.0 * DAMPED * self._mass_kg * STIFF_RAD_S
        force = stiff * (self.at - self.where) - damp * speed
        return force * min(1.0, PULL_N / max(float(np.linalg.norm(force)), 1e-9))

    def press(self) -> None:
        """Add the hand's force and torque to those that act on the object in the next step."""
        weight = self.share * self._mass_kg * GRAVITY_M_S2
        self._data.xfrc_applied[self.body, :3] += self.pull_n + np.array([0.0, 0.0, weight])
        self._data.xfrc_applied[self.body, 3:] += self._upright()

    def _upright(self) -> Array:
        """The torque that keeps the object as upright as it bears its weight [N m]."""
        rotation = np.zeros(9)
        mujoco.mju_quat2Mat(rotation, self._data.qpos[self._q + 3 : self._q + 7])
        turn = rotation.reshape(3, 3)
        lean = np.cross(turn[:, 2], [0.0, 0.0, 1.0])
        spin = turn @ self._data.qvel[self._v + 3 : self._v + 6]
        stiff, damp = STIFF_RAD_S**2, 2.0 * DAMPED * STIFF_RAD_S
        return self.share * self._inertia * (stiff * lean - damp * spin)
