"""What a body feels in one period of its controller: motors, IMU, forces."""

from __future__ import annotations

from dataclasses import dataclass

from robot.drivers.motor_bus import MotorState
from robot.se3 import Array


@dataclass(slots=True)
class ImuReading:
    """What the inertial measurement unit measured, in its own frame; shape (3,) each.

    `accel_m_s2` includes gravity: at rest it reads +9.81 upwards.
    """

    stamp_s: float
    gyro_rad_s: Array
    accel_m_s2: Array


@dataclass(slots=True)
class ForceReading:
    """Force [N] and torque [N m] at every ankle and wrist, left then right, shape (2, 6) each.

    In each sensor's own frame: as the foot acts on the leg, as the hand acts on the arm.
    """

    stamp_s: float
    ankle_wrench: Array
    wrist_wrench: Array


@dataclass(slots=True)
class BodySample:
    """The newest of each; they need not be of one instant, their stamps say of which they are."""

    motors: MotorState
    imu: ImuReading
    force: ForceReading
