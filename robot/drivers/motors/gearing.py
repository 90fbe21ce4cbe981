"""Between joints and the shafts of their motors, for all of them at once; arrays of shape (n,)."""

from __future__ import annotations

import numpy as np

from robot.drivers.motors.mounting import MountedJoints
from robot.se3 import Array


class Gearing:
    """q_joint = sign q_motor / gear + offset, and what follows: tau_joint = sign gear tau_motor.

    Attributes:
        turns: motor over joint, signed, shape (n,).
        stiffness: of a joint over that of its motor: gear², shape (n,).
    """

    def __init__(self, joints: MountedJoints) -> None:
        """Of a map's joints, in its order."""
        motors = joints.joints.values()
        self.turns: Array = np.array([motor.sign * motor.gear for motor in motors])
        self.stiffness: Array = self.turns * self.turns
        self._offset: Array = np.array([motor.offset_rad for motor in motors])

    def joint_q(self, motor_rad: Array) -> Array:
        """Angles of joints."""
        return motor_rad / self.turns + self._offset

    def joint_qd(self, motor_rad_s: Array) -> Array:
        """Speeds of joints."""
        return motor_rad_s / self.turns

    def joint_tau(self, motor_nm: Array) -> Array:
        """Torques at joints."""
        return motor_nm * self.turns

    def motor_q(self, joint_rad: Array) -> Array:
        """Angles of motors."""
        return (joint_rad - self._offset) * self.turns

    def motor_qd(self, joint_rad_s: Array) -> Array:
        """Speeds of motors."""
        return joint_rad_s * self.turns

    def motor_tau(self, joint_nm: Array) -> Array:
        """Torques of motors."""
        return joint_nm / self.turns
