"""Where the base is in the odometry frame N, from IMU, encoders and foot contact.

A complementary filter. Orientation: the gyro, pulled to gravity by the accelerometer when that
reads about 1 g (Mahony et al., "Nonlinear complementary filters on SO(3)", 2008). Velocity: the
accelerometer, pulled to what loaded feet that do not move imply. Position: the velocity, pulled to
where loaded feet were when they took load (legged odometry as in Bloesch et al., "State estimation
for legged robots", RSS 2012, with constant gains). Soles are taken to stand on a floor at z = 0.
"""

from __future__ import annotations

import math

import mujoco
import numpy as np

from robot.model.body import BodyModel
from robot.physics import GRAVITY_M_S2
from robot.se3 import SE3, Array, Quaternion, multiply, rotate

TILT_GAIN_1_S = 0.05
VELOCITY_TIME_S = 0.03
POSITION_TIME_S = 0.10
TAKE_LOAD = 0.2  # share of the weight from which a foot is an anchor,
RELEASE_LOAD = 0.1  # below which it is none,
SURE_LOAD = 0.5  # and below which its anchor follows the foot


class BaseStateEstimator:
    """Keeps X_NB and v_NB; the caller computes kinematics, once for all that need them.

    Attributes:
        p: p_NB [m], shape (3,).
        v: velocity of B in N [m/s], shape (3,).
        quat_wxyz: orientation of B in N.
        w_B: angular velocity in B [rad/s], shape (3,).
        load: share of the body's weight on each foot, left and right.
    """

    def __init__(self, body: BodyModel, X_NB: SE3) -> None:
        """Start at rest at X_NB."""
        self.body = body
        self.p: Array = np.array(X_NB.p)
        self.v: Array = np.zeros(3)
        self.quat_wxyz: Quaternion = X_NB.quat_wxyz
        self.w_B: Array = np.zeros(3)
        self.load = [0.0, 0.0]
        self._anchor: list[list[float] | None] = [None, None]
        site = body.site_id(body.description.sensors.imu.site)
        rotation = np.zeros(9)
        mujoco.mju_quat2Mat(rotation, body.model.site_quat[site])
        self._R_BI: Array = rotation.reshape(3, 3)
        self._weight_n = body.mass_kg * GRAVITY_M_S2

    def predict(self, dt_s: float, gyro_rad_s: Array, accel_m_s2: Array) -> None:
        """Integrate the IMU over `dt_s`; readings in the IMU's frame, shape (3,)."""
        self.w_B = self._R_BI @ gyro_rad_s
        wx, wy, wz = self.w_B.tolist()
        ax, ay, az = (self._R_BI @ accel_m_s2).tolist()
        qw, qx, qy, qz = self.quat_wxyz
        up = (2 * (qx * qz - qw * qy), 2 * (qy * qz + qw * qx), 1 - 2 * (qx * qx + qy * qy))
        norm = math.sqrt(ax * ax + ay * ay + az * az)
        if abs(norm - GRAVITY_M_S2) < 2.0:
            gain = TILT_GAIN_1_S / norm
            wx += gain * (ay * up[2] - az * up[1])
            wy += gain * (az * up[0] - ax * up[2])
            wz += gain * (ax * up[1] - ay * up[0])
        half = 0.5 * dt_s
        self.quat_wxyz = multiply(self.quat_wxyz, (1.0, half * wx, half * wy, half * wz))
        x, y, z = rotate(self.quat_wxyz, (ax, ay, az))
        z -= GRAVITY_M_S2
        (px, py, pz), (vx, vy, vz) = self.p.tolist(), self.v.tolist()
        self.p[:] = (
            px + dt_s * (vx + half * x),
            py + dt_s * (vy + half * y),
            pz + dt_s * (vz + half * z),
        )
        self.v[:] = vx + dt_s * x, vy + dt_s * y, vz + dt_s * z

    def correct(
        self, dt_s: float, soles: list[Array], sole_velocity: Array, ankle_force_z: Array
    ) -> tuple[float, float, float]:
        """Use the feet; returns by how much that moved `v`.

        Args:
            dt_s: time since the last correction.
            soles: left and right, in N, of the predicted base and measured joints, each (3,).
            sole_velocity: theirs, linear over angular, left over right, shape (12,).
            ankle_force_z: upward force on each ankle [N], shape (2,).
        """
        positions, velocity = [sole.tolist() for sole in soles], sole_velocity.tolist()
        weights = [
            self._trust(i, force_n / self._weight_n, positions[i])
            for i, force_n in enumerate(ankle_force_z.tolist())
        ]
        total = sum(weights)
        if total <= 0.0:
            return 0.0, 0.0, 0.0
        scale = min(1.0, total) / total
        shift_p, shift_v = [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]
        for i, weight in enumerate(weights):
            anchor = self._anchor[i]
            if anchor is None or weight == 0.0:
                continue
            gain_p = scale * weight * dt_s / POSITION_TIME_S
            gain_v = scale * weight * dt_s / VELOCITY_TIME_S
            for k in range(3):
                shift_v[k] -= gain_v * velocity[6 * i + k]
                shift_p[k] += gain_p * (anchor[k] - positions[i][k])
        self.v += shift_v
        self.p += shift_p
        self._settle_anchors(dt_s, positions, shift_p)
        return shift_v[0], shift_v[1], shift_v[2]

    def _trust(self, i: int, load: float, sole: list[float]) -> float:
        """Note a foot's load, drop or lift its anchor; how much its standing still counts."""
        self.load[i] = load
        if load > TAKE_LOAD and self._anchor[i] is None:
            self._anchor[i] = [sole[0], sole[1], 0.0]
        elif load < RELEASE_LOAD:
            self._anchor[i] = None
        return 0.0 if self._anchor[i] is None else max(0.0, min(1.0, (load - 0.05) / 0.3))

    def _settle_anchors(self, dt_s: float, soles: list[list[float]], shift_p: list[float]) -> None:
        """Let a lightly loaded foot's anchor follow the foot, so that rolling does not pull."""
        for i, sole in enumerate(soles):
            anchor = self._anchor[i]
            if anchor is not None and self.load[i] < SURE_LOAD:
                rate = min(1.0, dt_s / 0.02) * (1.0 - self.load[i] / SURE_LOAD)
                for k in (0, 1):
                    anchor[k] += rate * (sole[k] + shift_p[k] - anchor[k])

    def X_NB(self) -> SE3:
        """Pose of the base in N."""
        return SE3((float(self.p[0]), float(self.p[1]), float(self.p[2])), self.quat_wxyz)
