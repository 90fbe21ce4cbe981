"""What a simulated body felt in every period of its controller, with where it truly was."""

from __future__ import annotations

import numpy as np

from robot.drivers.body_sample import BodySample
from robot.files.archives import Plain
from robot.reality.contract import Plant
from robot.se3 import SE3, Array

SIDES = ("l_foot_fz", "r_foot_fz")


class BodyLog:
    """What a body felt, and where it truly was.

    Attributes:
        stamps_s: of the motors, a sample each.
    """

    def __init__(self) -> None:
        self.stamps_s: list[float] = []
        self._bases: list[SE3] = []
        self._joints: list[Array] = []
        self._imu: list[Array] = []
        self._forces_n: list[Array] = []

    def take(self, sample: BodySample, plant: Plant) -> None:
        """Keep a sample; its arrays are used again by who gave it."""
        self.stamps_s.append(sample.motors.stamp_s)
        self._bases.append(plant.X_WB())
        self._joints.append(sample.motors.q.copy())
        self._imu.append(np.concatenate([sample.imu.accel_m_s2, sample.imu.gyro_rad_s]))
        self._forces_n.append(sample.force.ankle_wrench[:, 2].copy())

    def arrays(self, joints: list[str]) -> dict[str, Plain]:
        """The fields of `robot.fusion.state_estimator.legged_log`.

        Args:
            joints: the motors' joints, in motor order.
        """
        imu, forces_n = np.stack(self._imu), np.stack(self._forces_n)
        began = self._bases[0]
        return {
            "t": np.array(self.stamps_s),
            "joint_names": np.array(joints),
            "joint_pos": np.stack(self._joints),
            "imu_acc": imu[:, :3],
            "imu_gyro": imu[:, 3:],
            **{side: forces_n[:, k] for k, side in enumerate(SIDES)},
            "gt_base_pos0": np.array(began.p),
            "gt_base_rpy0": np.array(began.rpy_rad),
        }

    def truth(self) -> Array:
        """Rows of t [s], x, y, z [m], qw, qx, qy, qz of the base, a row a sample, shape (n, 8)."""
        poses = np.array([(*X_WB.p, *X_WB.quat_wxyz) for X_WB in self._bases])
        return np.column_stack([self.stamps_s, poses])
