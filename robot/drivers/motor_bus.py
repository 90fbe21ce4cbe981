"""The one interface to motors, simulated or real.

A motor here is a MIT-mode actuator: its firmware applies, at its own rate,

    tau = kp (q_des - q) + kd (qd_des - qd) + tau_ff, clamped to its torque limit

and damps (kp = 0, qd_des = 0) when no command has come for its watchdog time. Motors that are less
than that say so in their driver's `capabilities`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, Protocol, Self, get_args

import numpy as np

from robot.closing import Closing
from robot.messages import MotorAlarm
from robot.se3 import Array

Capability = Literal["position", "torque", "temperature", "gains"]
"""What motors may be able to do.

position: measures q and qd; else they are those of the last command (hobby servos).
torque: takes tau_ff and measures tau, in N m; else tau is NaN (position servos).
temperature: measures temperature_c; else it is NaN.
gains: takes kp and kd with every command; else the firmware has its own (Dynamixel).
"""
MIT_MODE: frozenset[Capability] = frozenset(get_args(Capability))
"""What a MIT-mode actuator can do: all of it."""


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
    """What the motors measured, at one instant.

    Attributes:
        stamp_s: clock of the plant.
        q, qd, tau: joint positions, velocities, applied torques, shape (n,), motor order.
        temperature_c: winding temperatures, shape (n,).
        age_s: how old each motor's feedback was at the stamp, shape (n,); where replies come one
            by one, a lost one is seen here; inf of one that never said anything, as hobby servos
            do, whose position is assumed. Not to be written to.
        watchdog: True where the firmware damps because commands stopped coming.
        command_stamp_s: stamp of the last command the firmware took, -inf if none; on a bus whose
            frames carry no stamp, the last that this driver sent.
        alarms: what is wrong with motors and buses, the most severe first. From HOLD on the driver
            keeps the last targets; at SIT its commands pass again, so that whoever commands lowers
            the robot with what it has left.
    """

    stamp_s: float
    q: Array
    qd: Array
    tau: Array
    temperature_c: Array
    age_s: Array
    watchdog: bool
    command_stamp_s: float
    alarms: tuple[MotorAlarm, ...] = ()


class MotorBus(Closing, Protocol):
    """A driver of all motors: a context manager that leaves the motors damped.

    `__init__` opens nothing. Reading never blocks longer than one period. One driver at a time
    commands; any number may read.
    """

    @property
    def capabilities(self) -> frozenset[Capability]:
        """What these motors can do; known before they are opened."""
        ...

    def __enter__(self) -> Self:
        """Open the device. Raises DriverError if it is not there."""
        ...

    def close(self) -> None:
        """Leave every motor damped, unless another driver commands them, and close. Idempotent."""
        ...

    def claim(self) -> bool:
        """Become the one that commands the motors, until closed; False while another one is.

        The claim of a process that dies is free at once. Raises DriverError if it is not open.
        """
        ...

    def read(self) -> MotorState:
        """The newest state. Raises DriverError if the device went away."""
        ...

    def write(self, command: MotorCommand) -> MotorCommand:
        """Send a command and return what was really sent; claims the motors if they are free.

        Raises:
            DriverError: if a value is not finite or a shape is wrong (nothing is sent), or another
                driver commands.
        """
        ...
