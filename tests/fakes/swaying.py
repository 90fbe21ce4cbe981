"""A base that sways over two standing feet, and what a perfect IMU and legs would say of it."""

import math

import numpy as np

from robot.physics import GRAVITY_M_S2
from robot.se3 import SE3, rotation_vector

GRAVITY = np.array([0.0, 0.0, -GRAVITY_M_S2])


class Sway:
    """Sways in all six directions; `dt_s` a sample. The feet are at y = 0.1 m and -0.1 m."""

    def __init__(self, *, dt_s=0.005, height_m=0.6, size=1.0, hz=0.4):
        self.dt_s, self.height_m, self.size, self.hz = dt_s, height_m, size, hz
        self.feet = np.array([[0.0, 0.1, 0.0], [0.0, -0.1, 0.0]])
        self.foot_yaw_rad = np.zeros(2)

    def pose(self, t_s):
        """R, p of the base."""
        a = 2.0 * math.pi * self.hz * t_s
        s = self.size
        roll, pitch = 0.05 * s * math.sin(a), 0.04 * s * math.sin(1.3 * a)
        yaw = 0.10 * s * math.sin(0.7 * a)
        x, y = 0.02 * s * math.sin(0.9 * a), 0.05 * s * math.sin(a)
        z = self.height_m + 0.01 * s * math.sin(1.7 * a)
        X = SE3.from_rpy(roll, pitch, yaw, (x, y, z))
        return X.rotation(), np.array(X.p)

    def imu(self, t_s):
        """Gyro and accelerometer between t and t + dt."""
        dt = self.dt_s
        R0, p0 = self.pose(t_s)
        R1, p1 = self.pose(t_s + dt)
        _, p2 = self.pose(t_s + 2 * dt)
        gyro = rotation_vector(R0.T @ R1) / dt
        return gyro, R0.T @ ((p2 - 2 * p1 + p0) / dt**2 - GRAVITY)

    def legs(self, t_s):
        """Positions (2, 3) and rotations (2, 3, 3) of the soles in the base."""
        R, p = self.pose(t_s)
        turns = [SE3.from_xy_yaw(0.0, 0.0, yaw).rotation() for yaw in self.foot_yaw_rad]
        return (self.feet - p) @ R, np.stack([R.T @ turn for turn in turns])
