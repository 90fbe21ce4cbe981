"""The last word on what motors are told: position, speed, torque, gains, how fast a target moves.

After `robot.control.limits`, the controller's clamp, this is the last one before packets, for every
family of real motors and whoever commands: the controller, or `robot.owner` in its stead. It
latches nothing: a level that stays is `watching`'s alarm, or a row of `robot.owner.reactions`.

Whatever comes in leaves inside the limits, or not at all: what is not finite is refused, the rest
is clipped and counted. Torque is limited as the firmware will make it of the newest measurement:

    tau = kp (q_des - q) + kd (qd_des - qd) + tau_ff

Where |tau| is too much, kp, kd and tau_ff are made smaller by the same factor: it is then the
limit, and falls as the joint moves.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from robot.drivers.motor_bus import MotorCommand
from robot.drivers.motors.mounting import MountedJoints
from robot.errors import DriverError
from robot.se3 import Array

FIELDS = ("q_des", "qd_des", "tau_ff", "kp", "kd")
WARM_K = 20.0
"""Below a joint's `over_temperature_c` its torque begins to be taken back, linearly, ..."""
LEAST_SHARE = 0.3
"""... down to this part of it: enough to stand up from a chair, for most."""


class Measured(NamedTuple):
    """The newest state of all joints, shape (n,) each."""

    q: Array
    qd: Array
    temperature_c: Array


class Limiter:
    """Of all joints of a map.

    Attributes:
        clipped: values clipped so far, by what they were.
    """

    def __init__(self, joints: MountedJoints) -> None:
        """Take the limits of a map."""
        motors = joints.joints.values()
        self.clipped = {"position": 0, "speed": 0, "torque": 0, "gain": 0, "rate": 0}
        self._names = tuple(joints.joints)
        self._lower: Array = np.array([motor.lower_rad for motor in motors])
        self._upper: Array = np.array([motor.upper_rad for motor in motors])
        self._speed: Array = np.array([motor.velocity_limit_rad_s for motor in motors])
        self._torque: Array = np.array([motor.torque_limit_nm for motor in motors])
        self._kp: Array = np.array([motor.kp_most for motor in motors])
        self._kd: Array = np.array([motor.kd_most for motor in motors])
        self._hot_c: Array = np.array([motor.over_temperature_c for motor in motors])
        self._period_s = joints.period_s
        self._last: tuple[Array, float] | None = None

    def forget(self) -> None:
        """The next target starts from where the joints are."""
        self._last = None

    def share(self, temperature_c: Array) -> Array:
        """Of its torque that each joint may give, as warm as it is; 1 of one that does not tell."""
        above = (temperature_c - (self._hot_c - WARM_K)) / WARM_K
        share = 1.0 - (1.0 - LEAST_SHARE) * np.clip(above, 0.0, 1.0)
        return np.where(np.isnan(share), 1.0, share)

    def apply(self, command: MotorCommand, measured: Measured) -> MotorCommand:
        """A command inside every limit, with arrays of its own.

        Raises:
            DriverError: if a value is not finite or a shape is wrong; nothing changes.
        """
        self.check(command)
        q_des = self._clip("position", command.q_des, self._lower, self._upper)
        q_des = self._steady(q_des, command, measured.q)
        qd_des = self._clip("speed", command.qd_des, -self._speed, self._speed)
        kp = self._clip("gain", command.kp, 0.0, self._kp)
        kd = self._clip("gain", command.kd, 0.0, self._kd)
        most = self._torque * self.share(measured.temperature_c)
        tau_ff = np.minimum(np.maximum(command.tau_ff, -most), most)
        total = np.abs(kp * (q_des - measured.q) + kd * (qd_des - measured.qd) + tau_ff)
        over = total > most
        if count := int(np.count_nonzero(over)) or int(np.count_nonzero(tau_ff != command.tau_ff)):
            self.clipped["torque"] += count
            scale = np.divide(most, total, out=np.ones_like(total), where=over)
            kp, kd, tau_ff = kp * scale, kd * scale, tau_ff * scale
        self._last = np.where(kp > 0.0, q_des, measured.q), command.stamp_s
        return MotorCommand(command.stamp_s, q_des, qd_des, tau_ff, kp, kd)

    def check(self, command: MotorCommand) -> None:
        """Refuse what is no command. Raises DriverError naming the field and the joint."""
        shape = self._lower.shape
        for name in FIELDS:
            values: Array = getattr(command, name)
            if values.shape != shape:
                raise DriverError(f"{name} has shape {values.shape}, motors want {shape}")
            if not math.isfinite(float(np.add.reduce(values))):
                bad = int(np.argmin(np.isfinite(values)))
                raise DriverError(f"{name} of {self._names[bad]} is {values[bad]:g}")

    def _clip(self, what: str, values: Array, low: Array | float, high: Array) -> Array:
        kept = np.minimum(np.maximum(values, low), high)
        self.clipped[what] += int(np.count_nonzero(kept != values))
        return kept

    def _steady(self, q_des: Array, command: MotorCommand, q: Array) -> Array:
        """No target moves faster than its joint may, from the one before or from where it is."""
        begin, since_s = q, self._period_s
        if self._last is not None:
            begin, since_s = self._last[0], command.stamp_s - self._last[1]
        step = self._speed * min(max(since_s, self._period_s), 2.0 * self._period_s)
        begin = np.minimum(np.maximum(begin, self._lower), self._upper)
        kept = np.minimum(np.maximum(q_des, begin - step), begin + step)
        stiff = command.kp > 0.0
        self.clipped["rate"] += int(np.count_nonzero((kept != q_des) & stiff))
        return np.where(stiff, kept, q_des)
