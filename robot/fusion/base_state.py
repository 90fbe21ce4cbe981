"""Where the base is in the odometry frame N, from IMU, encoders and foot contact.

A complementary filter. Orientation: the gyro, pulled to gravity by the accelerometer when that
reads about 1 g (Mahony et al., "Nonlinear complementary filters on SO(3)", 2008). Velocity: the
accelerometer, pulled to what loaded feet that do not move imply. Position: the velocity, pulled to
where loaded feet were when they took load (legged odometry as in Bloesch et al., "State estimation
for legged robots", RSS 2012, with constant gains). Soles are taken to stand on a floor at z = 0.
"""

from __future__ import annotations

import math
from typing import Any

import mujoco
import numpy as np

from robot.model.body import SIDES, BodyModel
from robot.se3 import SE3, Array, Quaternion, multiply, rotate

GRAVITY_M_S2 = 9.81
TILT_GAIN_1_S = 0.05
VELOCITY_TIME_S = 0.03
POSITION_TIME_S = 0.10
TAKE_LOAD = 0.2  # share of the weight from which a foot is an anchor,
RELEASE_LOAD = 0.1  # below which it is none,
SURE_LOAD = 0.5  # and below which its anchor follows the foot


class BaseStateEstimator:
    """Keeps X_NB and v_NB; works on the caller's MjData so that kinematics are computed once.

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
        self._anchor: list[Array | None] = [None, None]
        site = body.site_id(body.description.sensors.imu.site)
        rotation = np.zeros(9)
        mujoco.mju_quat2Mat(rotation, body.model.site_quat[site])
        self._R_BI: Array = rotation.reshape(3, 3)
        self._weight_n = body.mass_kg * GRAVITY_M_S2

    def predict(self, dt_s: float, gyro_rad_s: Array, accel_m_s2: Array) -> None:
        """Integrate the IMU over `dt_s`; readings in the IMU's frame, shape (3,)."""
        w = self._R_BI @ gyro_rad_s
        a = self._R_BI @ accel_m_s2
        self.w_B = w
        qw, qx, qy, qz = self.quat_wxyz
        up = (2 * (qx * qz - qw * qy), 2 * (qy * qz + qw * qx), 1 - 2 * (qx * qx + qy * qy))
        ax, ay, az = float(a[0]), float(a[1]), float(a[2])
        norm = math.sqrt(ax * ax + ay * ay + az * az)
        wx, wy, wz = float(w[0]), float(w[1]), float(w[2])
        if abs(norm - GRAVITY_M_S2) < 2.0:
            gain = TILT_GAIN_1_S / norm
            wx += gain * (ay * up[2] - az * up[1])
            wy += gain * (az * up[0] - ax * up[2])
            wz += gain * (ax * up[1] - ay * up[0])
        half = 0.5 * dt_s
        self.quat_wxyz = multiply(self.quat_wxyz, (1.0, half * wx, half * wy, half * wz))
        x, y, z = rotate(self.quat_wxyz, (ax, ay, az))
        z -= GRAVITY_M_S2
        self.p[0] += dt_s * (self.v[0] + half * x)
        self.p[1] += dt_s * (self.v[1] + half * y)
        self.p[2] += dt_s * (self.v[2] + half * z)
        self.v[0] += dt_s * x
        self.v[1] += dt_s * y
        self.v[2] += dt_s * z

    def correct(self, dt_s: float, data: Any, jac_sole: list[Array], ankle_force_z: Array) -> None:
        """Use the feet.

        `data` has kinematics for the predicted base and measured joints, and qvel set; `jac_sole`
        are the soles' translational Jacobians, each (3, nv); `ankle_force_z` [N], shape (2,).
        """
        total_gain_v = dt_s / VELOCITY_TIME_S
        total_gain_p = dt_s / POSITION_TIME_S
        weights = [0.0, 0.0]
        for i, side in enumerate(SIDES):
            load = float(ankle_force_z[i]) / self._weight_n
            self.load[i] = load
            sole = data.site_xpos[self.body.sole_site[side]]
            if load > TAKE_LOAD and self._anchor[i] is None:
                self._anchor[i] = np.array([sole[0], sole[1], 0.0])
            elif load < RELEASE_LOAD:
                self._anchor[i] = None
            if self._anchor[i] is not None:
                weights[i] = max(0.0, min(1.0, (load - 0.05) / 0.3))
        total = sum(weights)
        if total <= 0.0:
            return
        scale = min(1.0, total) / total
        shift_p, shift_v = np.zeros(3), np.zeros(3)
        for i, side in enumerate(SIDES):
            anchor = self._anchor[i]
            if anchor is None or weights[i] == 0.0:
                continue
            share = scale * weights[i]
            sole = data.site_xpos[self.body.sole_site[side]]
            slip = jac_sole[i] @ data.qvel
            shift_v -= share * total_gain_v * slip
            shift_p += share * total_gain_p * (anchor - sole)
        self.v += shift_v
        self.p += shift_p
        self._settle_anchors(dt_s, data, shift_p)

    def _settle_anchors(self, dt_s: float, data: Any, shift_p: Array) -> None:
        """Let a lightly loaded foot's anchor follow the foot, so that rolling does not pull."""
        for i, side in enumerate(SIDES):
            anchor = self._anchor[i]
            if anchor is not None and self.load[i] < SURE_LOAD:
                sole = data.site_xpos[self.body.sole_site[side]]
                rate = min(1.0, dt_s / 0.02) * (1.0 - self.load[i] / SURE_LOAD)
                anchor[:2] += rate * (sole[:2] + shift_p[:2] - anchor[:2])

    def X_NB(self) -> SE3:
        """Pose of the base in N."""
        return SE3((float(self.p[0]), float(self.p[1]), float(self.p[2])), self.quat_wxyz)
