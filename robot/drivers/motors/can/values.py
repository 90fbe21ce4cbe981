"""What motors on CAN are told and tell, at their shafts, whatever their frames look like."""

from __future__ import annotations

from typing import NamedTuple, Protocol

import numpy as np
import numpy.typing as npt

from robot.drivers.motors.can.packed import Bytes
from robot.se3 import Array

DISABLED, ENABLED = 0x0, 0x1
"""Status codes that every family has; its others begin where no other family's are."""
NOBODY = -1
"""Whose a frame is that is no motor's feedback."""


class Ranges(NamedTuple):
    """What the largest numbers in a motor's frames stand for.

    Position, velocity and torque go as far to the other side of zero, gains begin at zero.
    """

    position_rad: float
    velocity_rad_s: float
    torque_nm: float
    kp: float = 500.0
    kd: float = 5.0


class Target(NamedTuple):
    """What one motor is told, at its own shaft: kp (q - q_now) + kd (qd - qd_now) + tau."""

    q_rad: float
    qd_rad_s: float
    kp: float
    kd: float
    tau_nm: float


class Feedback(NamedTuple):
    """What one motor answered, at its own shaft.

    Attributes:
        motor_id: its identifier, or as many of its bits as the frame tells.
        status: its status code.
        q_rad, qd_rad_s, tau_nm: position, velocity, torque.
        driver_c, winding_c: temperatures of the electronics and of the windings, NaN where one is
            not told.
    """

    motor_id: int
    status: int
    q_rad: float
    qd_rad_s: float
    tau_nm: float
    driver_c: float
    winding_c: float


class Status(NamedTuple):
    """What a status code says.

    Attributes:
        code: for programs, as in `over_current`.
        is_fault: whether the motor gives no torque because of it.
        cure: what a person does about it.
    """

    code: str
    is_fault: bool
    cure: str = ""


def unknown(code: int) -> Status:
    """A status that no manual lists is a fault."""
    cure = "compare the motor's firmware with its manual"
    return Status(f"unknown_status_{code:x}", is_fault=True, cure=cure)


class RegisterReply(NamedTuple):
    """A register's value as its motor told it, with the whole of the motor's identifier."""

    motor_id: int
    register: int
    value: float


class Feedbacks(NamedTuple):
    """What several motors answered, at their shafts; arrays of shape (k,).

    Attributes:
        motion: positions, velocities, torques, shape (3, k).
        status: their status codes.
        winding_c: temperatures of their windings, NaN where they are not told.
    """

    motion: Array
    status: npt.NDArray[np.intp]
    winding_c: Array


class ManyMotors(Protocol):
    """The codec of several motors of one family, each with ranges of its own.

    Attributes:
        width: bytes of data that its commands have, and its replies at most.
    """

    @property
    def width(self) -> int:
        """8, or more of CAN FD."""
        ...

    def commands(self, targets: Array) -> tuple[npt.NDArray[np.uint32], Bytes, Array]:
        """Everybody's frame and what it really says.

        Args:
            targets: q, qd, kp, kd, tau, shape (5, n), at the shafts.

        Returns:
            Identifiers as `packed` has them, shape (n,), data, shape (n, width), and what they say,
            shape (5, n).

        Raises:
            DriverError: if a value is not finite, or does not fit its range: with both.
        """
        ...

    def is_feedback(self, data: Bytes, lengths: Bytes) -> npt.NDArray[np.bool_]:
        """Whether data, shape (k, width), of which so much came, can be a reply, shape (k,)."""
        ...

    def feedback(
        self,
        ids: npt.NDArray[np.uint32],
        data: Bytes,
        lengths: Bytes,
        which: npt.NDArray[np.intp],
    ) -> Feedbacks:
        """What replies say.

        Args:
            ids: their identifiers, as `packed` has them, shape (k,).
            data: shape (k, width), zeros where less came.
            lengths: how much of it came, shape (k,).
            which: whose each is, shape (k,).
        """
        ...
