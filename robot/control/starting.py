"""How a controller finds the robot when it begins: at rest, or where another controller died.

It knows the joints and what the IMU and the soles feel, not where the robot is: its odometry frame
has the stance as its origin and the floor at z = 0.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from robot.control.walking.footsteps import Sole, stance_of
from robot.drivers.body_sample import BodySample
from robot.drivers.motor_bus import MotorState
from robot.failures import Failure, failure
from robot.kinematics.dynamics import Dynamics
from robot.messages import Mode
from robot.model.body import SIDES
from robot.physics import GRAVITY_M_S2
from robot.se3 import SE3, Array, Quaternion

TAKE_OVER_S = 0.1
"""A robot whose controller died is held up by the next one if that comes so soon, else it damps."""
CARRYING_SHARE = 0.5
"""Feet that bear this part of the weight stand on the floor, and flat."""
LYING_RAD = 0.8
"""Feet that are so far from flat by what the IMU feels do not stand; in a step that is 0.32."""
AT_REST_M_S2 = 1.5  # from 1 g: else what is felt is not gravity alone


class Found(NamedTuple):
    """Where the robot is in the new frame N: the base, and the soles on the floor."""

    X_NB: SE3
    left: Sole
    right: Sole


def find(dynamics: Dynamics, sample: BodySample, *, taking_over: bool) -> Found:
    """Find the odometry frame: the stance is its origin, the floor its z = 0.

    Args:
        dynamics: of the robot; its base and joints are written.
        sample: what motors, IMU and soles say.
        taking_over: whether another controller moved it a moment ago.
    """
    body, data = dynamics.body, dynamics.data
    X_AB = SE3((0.0, 0.0, 0.0), _upright(dynamics, sample, taking_over=taking_over))
    body.write_base(data, X_AB)
    body.write_joints(data, sample.motors.q)
    dynamics.kinematics()
    X_AL, X_AR = (body.site_pose(data, body.sole_site[side]) for side in SIDES)
    stance = stance_of(planar(X_AL), planar(X_AR))
    lowest_m = min(X_AL.p[2], X_AR.p[2])
    X_NA = SE3.from_xy_yaw(stance.x, stance.y, stance.yaw, z_m=lowest_m).inverse()
    return Found(X_NA @ X_AB, planar(X_NA @ X_AL), planar(X_NA @ X_AR))


def planar(X: SE3) -> Sole:
    """A sole's place on the floor."""
    return Sole(X.p[0], X.p[1], X.yaw_rad)


def _upright(dynamics: Dynamics, sample: BodySample, *, taking_over: bool) -> Quaternion:
    """Orientation with heading zero: from gravity at rest, else from the soles lying flat.

    A robot whose controller died may be in mid-step: the soles that bear it say what is up. Or it
    lies, which they do not.
    """
    felt_B = sample.imu.accel_m_s2
    norm = float(np.linalg.norm(felt_B))
    weight_n = GRAVITY_M_S2 * dynamics.body.mass_kg
    bearing = sample.force.ankle_wrench[:, 2].clip(min=0.0) / weight_n
    in_a_step = taking_over and float(bearing.sum()) > CARRYING_SHARE
    up_B = felt_B / norm
    if in_a_step or abs(norm - GRAVITY_M_S2) >= AT_REST_M_S2:
        soles_B = _up_of_soles(dynamics, sample.motors, bearing if in_a_step else np.ones(2))
        flat = float(soles_B @ up_B) > math.cos(LYING_RAD) * float(np.linalg.norm(soles_B))
        up_B = soles_B if flat or not taking_over else up_B
    x, y, z = (float(value) for value in up_B)
    roll, pitch = math.atan2(y, z), math.atan2(-x, math.hypot(y, z))
    return SE3.from_rpy(roll, pitch, 0.0, (0.0, 0.0, 0.0)).quat_wxyz


def _up_of_soles(dynamics: Dynamics, state: MotorState, shares: Array) -> Array:
    """The mean of what is up from the soles, in the base's axes, shape (3,); not of unit length."""
    body, data = dynamics.body, dynamics.data
    body.write_base(data, SE3())
    body.write_joints(data, state.q)
    dynamics.kinematics()
    left, right = dynamics.sole_rotation
    return shares[0] * left[:, 2] + shares[1] * right[:, 2]


def took_over(state: MotorState) -> bool:
    """Whether another controller commanded these motors before."""
    return math.isfinite(state.command_stamp_s)


def left_by(state: MotorState, mode: Mode) -> Failure | None:
    """What became of a robot whose controller died; None if it can be held up where it is.

    Args:
        state: at the first tick of the next controller.
        mode: in which that controller would begin.
    """
    silence_s = state.stamp_s - state.command_stamp_s
    if mode != "stand":
        return failure("fallen", "the robot was down when its controller was replaced")
    if silence_s > TAKE_OVER_S:
        text = f"nobody commanded the motors for {silence_s:.2f} s; they damp"
        return failure("controller_lost", text, silence_s=round(silence_s, 3))
    return None
