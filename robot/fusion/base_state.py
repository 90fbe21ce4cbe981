"""Where the base is in the odometry frame N, from IMU, encoders and foot contact.

On its feet a contact-aided Kalman filter that knows the IMU's biases (`state_estimator.filter`).
Lying, no foot tells anything: then the gyro less its bias is pulled to gravity by the accelerometer
when that reads about 1 g (Mahony et al., "Nonlinear complementary filters on SO(3)", 2008), what is
known of the IMU is kept, and the height is that of the lower sole on a floor at z = 0.
"""

from __future__ import annotations

import math

import mujoco
import numpy as np

from robot.fusion.state_estimator.contacts import Contacts
from robot.fusion.state_estimator.filter import ACCEL_BIAS, GYRO_BIAS, ContactFilter, exponential
from robot.fusion.state_estimator.parameters import Parameters
from robot.messages import ImuBias
from robot.model.body import SIDES, BodyModel
from robot.physics import GRAVITY_M_S2
from robot.se3 import SE3, Array, Quaternion, Vector3, matrix_to_quat

CORRECT_EVERY_S = 0.01
"""The legs are asked at half the controller's rate, and at once where a foot comes down or lifts;
between, the IMU tells enough, and asking costs five times what integrating it does."""
LYING_GAIN_1_S = 0.05
ABOUT_1_G_M_S2 = 2.0
BEARS_SHARE, LOST_S = 0.1, 0.2
"""Without an IMU: of the weight, on a foot that bears; for so long none may. One foot of a walk
always does."""


class BaseStateEstimator:
    """Keeps X_NB and v_NB; the caller computes kinematics, once for all that need them.

    Attributes:
        p: p_NB [m], shape (3,).
        v: velocity of B in N [m/s], shape (3,).
        quat_wxyz: orientation of B in N.
        w_B: angular velocity in B [rad/s], shape (3,).
        load: share of the body's weight on each foot, left and right.
        lying: whether no foot is to be believed; the caller says so.
        hangs: the foot that is surely in the air, 0 or 1, if one is; the caller says so.
    """

    def __init__(self, body: BodyModel, X_NB: SE3, *, known: ImuBias | None = None) -> None:
        """Start at rest at X_NB; `known`: of the IMU, from an estimator before this one."""
        self.body = body
        self.p: Array = np.array(X_NB.p)
        self.v: Array = np.zeros(3)
        self.quat_wxyz: Quaternion = X_NB.quat_wxyz
        self.w_B: Array = np.zeros(3)
        self.lying = False
        self.hangs: int | None = None
        site = body.site_id(body.description.sensors.imu.site)
        rotation = np.zeros(9)
        mujoco.mju_quat2Mat(rotation, body.model.site_quat[site])
        self._R_BI: Array = rotation.reshape(3, 3)
        self._p_BI: Array = np.array(body.model.site_pos[site])
        left_n, right_n = (
            GRAVITY_M_S2 * float(body.model.body_subtreemass[body.foot_body[side]])
            for side in SIDES
        )
        self._contacts = Contacts(body.mass_kg * GRAVITY_M_S2, (left_n, right_n))
        self.load = self._contacts.load
        R_NB = X_NB.rotation()
        self._filter = ContactFilter(Parameters(), R_NB @ self._R_BI, self.p + R_NB @ self._p_BI)
        self._positions: Array = np.zeros((2, 3))
        self._rotations: Array = np.zeros((2, 3, 3))
        self._since_s = 0.0
        self._borne_by_none_s = 0.0
        if known is not None:
            self._recall(known)

    @property
    def imu_bias(self) -> ImuBias:
        """What is known of the IMU by now."""
        state = self._filter
        sigma = np.sqrt(np.diag(state.covariance))
        return ImuBias(
            gyro_rad_s=_vector(state.gyro_bias),
            accel_m_s2=_vector(state.accel_bias),
            gyro_sigma_rad_s=_vector(sigma[GYRO_BIAS]),
            accel_sigma_m_s2=_vector(sigma[ACCEL_BIAS]),
        )

    def _recall(self, known: ImuBias) -> None:
        state = self._filter
        state.gyro_bias[:], state.accel_bias[:] = known.gyro_rad_s, known.accel_m_s2
        sigma = np.array((*known.gyro_sigma_rad_s, *known.accel_sigma_m_s2))
        rows = slice(GYRO_BIAS.start, ACCEL_BIAS.stop)
        state.covariance[rows, rows] = np.diag(sigma * sigma)

    def predict(self, dt_s: float, gyro_rad_s: Array, accel_m_s2: Array) -> None:
        """Integrate the IMU over `dt_s`; readings in the IMU's frame, shape (3,)."""
        state = self._filter
        turn_rad_s = gyro_rad_s - state.gyro_bias
        self.w_B = self._R_BI @ turn_rad_s
        if self.lying:
            self._turn(dt_s, turn_rad_s, accel_m_s2 - state.accel_bias)
        else:
            state.predict(dt_s, gyro_rad_s, accel_m_s2)
        self._show()

    def coast(self, dt_s: float, w_B: Array) -> None:
        """Go on without an IMU, whose readings are not believed any more, over `dt_s`.

        The feet alone then tell where the base goes (`ContactFilter.mistrust`).

        Args:
            dt_s: time that has passed.
            w_B: how fast the base turns by the soles that bear, in B [rad/s], shape (3,).
        """
        state = self._filter
        state.mistrust()
        bears = self.lying or max(self.load) > BEARS_SHARE
        self._borne_by_none_s = 0.0 if bears else self._borne_by_none_s + dt_s
        self.w_B = w_B
        if not self.lying:
            still: Array = state.rotation.T @ (0.0, 0.0, GRAVITY_M_S2)
            gyro = self._R_BI.T @ w_B
            state.predict(dt_s, gyro + state.gyro_bias, still + state.accel_bias)
        self._show()

    @property
    def is_lost(self) -> str:
        """Why nothing tells any more which way is up; empty while something does."""
        if self._borne_by_none_s < LOST_S:
            return ""
        return "the IMU is not to be believed, and no foot bears the robot"

    def correct(
        self, dt_s: float, soles: list[Array], rotations: list[Array], ankle_force_z: Array
    ) -> tuple[float, float, float]:
        """Use the feet, if it is time to; returns by how much that moved `v`.

        Args:
            dt_s: time since the last correction.
            soles: left and right, in N, of the predicted base and measured joints, each (3,).
            rotations: their orientations in N, each (3, 3).
            ankle_force_z: upward force on each ankle [N], shape (2,).
        """
        if self.hangs is not None and not self.lying:
            self._contacts.tare(self.hangs, float(ankle_force_z[self.hangs]), dt_s)
        trust = self._contacts.update(ankle_force_z)
        state = self._filter
        if self.lying:
            state.p[2] -= min(float(sole[2]) for sole in soles)
            self._show()
            return 0.0, 0.0, 0.0
        self._since_s += dt_s
        stand = [share > 0.0 for share in trust]
        if self._since_s < CORRECT_EVERY_S - 1e-6 and stand == state.standing:
            return 0.0, 0.0, 0.0
        since_s, self._since_s = self._since_s, 0.0
        turned = state.rotation.T
        for side in (0, 1):
            self._positions[side] = turned.dot(soles[side] - state.p)
            self._rotations[side] = turned.dot(rotations[side])
        before = self.v
        stood, held, slips = state.feet.copy(), state.standing.copy(), sum(state.slips)
        was = state.p.copy()
        state.correct(since_s, self._positions, self._rotations, trust)
        if sum(state.slips) == slips:
            if state.planted:
                self._stay(stood)
            else:
                both = zip(held, state.standing, strict=True)
                self._keep_place(was, stood, [before and now for before, now in both])
        self._show()
        x, y, z = (self.v - before).tolist()
        return x, y, z

    def _stay(self, stood: Array) -> None:
        """Keep the feet of a robot that stands where they were, in the plane; shape (2, 3).

        Standing, the filter learns what the gyro was off by, and that all the way it went another
        way than it thought: ten metres on a tenth of a degree of heading is 2 cm. The heading is
        better known then; a place that moves under a robot that stands helps nobody.
        """
        x, y, _ = (0.5 * (stood - self._filter.feet).sum(axis=0)).tolist()
        self._filter.shift(x, y)

    def _keep_place(self, was: Array, stood: Array, stands: list[bool]) -> None:
        """Take back what moved the base and the feet that stand alike, in the plane.

        A sole that twists as it bears looks like a heading that was wrong all along: far from where
        N began, that puts the whole robot elsewhere, by 13 cm within a tenth of a second on a sill,
        and the gait after a DCM that never moved.

        Args:
            was: where the IMU was before the correction [m], shape (3,).
            stood: where the feet were, shape (2, 3).
            stands: which of them have stood since before it.
        """
        moved = [self._filter.p - was]
        moved += [self._filter.feet[side] - stood[side] for side in (0, 1) if stands[side]]
        if len(moved) == 1:
            return
        x, y = (_alike([float(one[axis]) for one in moved]) for axis in (0, 1))
        self._filter.shift(-x, -y)

    def _turn(self, dt_s: float, turn_rad_s: Array, accel_m_s2: Array) -> None:
        """The orientation of a body that lies, in I: gyro and gravity."""
        state = self._filter
        wx, wy, wz = turn_rad_s.tolist()
        ax, ay, az = accel_m_s2.tolist()
        up_x, up_y, up_z = state.rotation[2].tolist()
        norm = math.sqrt(ax * ax + ay * ay + az * az)
        if abs(norm - GRAVITY_M_S2) < ABOUT_1_G_M_S2:
            gain = LYING_GAIN_1_S / norm
            wx += gain * (ay * up_z - az * up_y)
            wy += gain * (az * up_x - ax * up_z)
            wz += gain * (ax * up_y - ay * up_x)
        turned = state.rotation @ exponential(dt_s * wx, dt_s * wy, dt_s * wz)
        state.place(turned, state.p)

    def _show(self) -> None:
        """Say where the base is by where the IMU is."""
        state = self._filter
        R_NB = state.rotation.dot(self._R_BI.T)
        self.quat_wxyz = matrix_to_quat(R_NB)
        self.p = state.p - R_NB.dot(self._p_BI)
        wx, wy, wz = self.w_B.tolist()
        x, y, z = self._p_BI.tolist()
        self.v = state.v - R_NB.dot((wy * z - wz * y, wz * x - wx * z, wx * y - wy * x))

    def X_NB(self) -> SE3:
        """Pose of the base in N."""
        return SE3(_vector(self.p), self.quat_wxyz)


def _alike(values: list[float]) -> float:
    """What of some motions along an axis is common to all: nothing where they go apart."""
    low, high = min(values), max(values)
    return low if low > 0.0 else min(0.0, high)


def _vector(values: Array) -> Vector3:
    x, y, z = values.tolist()
    return (x, y, z)
