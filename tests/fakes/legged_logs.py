"""A recording of a robot that stands still, as its sensors with a bias would make it."""

import math

import numpy as np

from robot.model import description
from robot.model import urdf as writer
from robot.physics import GRAVITY_M_S2

BIAS_RAD_S = math.radians(0.5) * np.array([0.6, -0.48, 0.64])
PERIOD_S = 0.01


def urdf_file(folder):
    """The shipped robot's URDF in a folder."""
    path = folder / "robot.urdf"
    path.write_text(writer.urdf(description.load()))
    return path


def standing(*, samples=600, seed=1):
    """The fields of a recording in the nominal posture."""
    robot, rng = description.load(), np.random.default_rng(seed)
    posture = np.array(robot.posture("nominal"))
    noise = rng.standard_normal
    weight_n = 34.9 * GRAVITY_M_S2
    return {
        "t": PERIOD_S * np.arange(samples),
        "joint_names": np.array([motor.joint for motor in robot.motors.values()]),
        "joint_pos": posture + 2e-4 * noise((samples, len(posture))),
        "imu_gyro": BIAS_RAD_S + 0.003 * noise((samples, 3)),
        "imu_acc": np.array([0.0, 0.0, GRAVITY_M_S2]) + 0.05 * noise((samples, 3)),
        "l_foot_fz": 0.5 * weight_n + 2.0 * noise(samples),
        "r_foot_fz": 0.5 * weight_n + 2.0 * noise(samples),
        "gt_base_pos0": np.array([1.0, 2.0, 0.59]),
        "gt_base_rpy0": np.array([0.01, -0.02, 2.5]),
    }


def write(folder, fields):
    """The recording as a file."""
    path = folder / "log.npz"
    np.savez(path, **fields)
    return path
