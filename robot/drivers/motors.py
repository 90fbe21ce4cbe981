"""The one interface to motors and body sensors, simulated or real.

A motor here is a MIT-mode actuator: its firmware applies, at its own rate,

    tau = kp (q_des - q) + kd (qd_des - qd) + tau_ff, clamped to its torque limit

and damps (kp = 0, qd_des = 0) when no command has come for its watchdog time.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol, Self

import numpy as np

from robot.closing import Closing
from robot.se3 import Array


@dataclass(slots=True)
class MotorCommand:
    """One command to every motor, in the description's motor order; arrays of shape (n,).

    Once sent, its arrays are changed no more: a driver may keep them, and know them again.

    Units: rad, rad/s, N m, N m/rad, N m s/rad for joints; m, m/s, N ... for fingers.
    """

    stamp_s: float
    q_des: Array
    qd_des: Array
    tau_ff: Array
    kp: Array
    kd: Array

    @staticmethod
    def damping(count: int, stamp_s: float, kd: Array | float = 2.0) -> MotorCommand:
        """Zero stiffness, zero velocity target: the safe command."""
        zero = np.zeros(count)
        return MotorCommand(
            stamp_s, zero, zero.copy(), zero.copy(), zero.copy(), np.zeros(count) + kd
        )


@dataclass(slots=True)
class MotorState:
    """What the motors and the body's own sensors measured, at one instant.

    Attributes:
        stamp_s: clock of the plant.
        q, qd, tau: joint positions, velocities, applied torques, shape (n,), motor order.
        temperature_c: winding temperatures, shape (n,).
        gyro_rad_s, accel_m_s2: IMU, shape (3,), in the IMU frame; accel includes gravity
            (at rest it reads +9.81 upwards).
        ankle_wrench: force [N] and torque [N m] at the left then right ankle, shape (2, 6), in the
            sensor's frame, as the foot acts on the leg.
        wrist_wrench: the same for the left and right wrist, as the hand acts on the arm.
        watchdog: True where the firmware damps because commands stopped coming.
        command_stamp_s: stamp of the last command the firmware took, -inf if none.
    """

    stamp_s: float
    q: Array
    qd: Array
    tau: Array
    temperature_c: Array
    gyro_rad_s: Array
    accel_m_s2: Array
    ankle_wrench: Array
    wrist_wrench: Array
    watchdog: bool
    command_stamp_s: float


class MotorBus(Closing, Protocol):
    """A driver of all motors: a context manager that leaves the motors damped.

    `__init__` opens nothing. Reading never blocks longer than one period.
    """

    def __enter__(self) -> Self:
        """Open the device. Raises DriverError if it is not there."""
        ...

    def close(self) -> None:
        """Leave every motor damped and close; safe to call twice."""
        ...

    def read(self) -> MotorState:
        """The newest state. Raises DriverError if the device went away."""
        ...

    def write(self, command: MotorCommand) -> MotorCommand:
        """Send a command and return what was really sent.

        Raises:
            DriverError: if a value is not finite or a shape is wrong (nothing is sent).
        """
        ...
