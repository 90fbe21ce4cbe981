"""A driver of motors: joints that are where they were told to be, without a body or physics.

It would be `robot/drivers/motors/loopback.py`. With a wire in the place of `Joints` it is a driver
of real motors: what is refused, who commands and how it is left stay as they are.
"""

from __future__ import annotations

from dataclasses import fields, replace
from typing import Self

import numpy as np

from robot.clock import Clock
from robot.closing import Closing
from robot.drivers.motor_bus import Capability, MotorBus, MotorCommand, MotorState
from robot.drivers.wiring import Wiring
from robot.errors import DriverError


class Joints:
    """The device: it does what the last command says, at once. Drivers of it share it.

    Attributes:
        command: the last that was taken.
        commander: the driver that commands, if one does.
    """

    def __init__(self, count: int) -> None:
        """So many joints, all at 0."""
        self.command = MotorCommand.damping(count, -np.inf)
        self.commander: object | None = None
        self.q = np.zeros(count)

    def take(self, command: MotorCommand) -> None:
        """Follow a command; where its stiffness is 0 a joint stays."""
        self.command = command
        self.q = np.where(command.kp > 0.0, command.q_des, self.q)


class LoopbackMotors(Closing):
    """A `MotorBus` onto `Joints`. They have no torque to measure, and no windings."""

    capabilities: frozenset[Capability] = frozenset({"position", "gains"})

    def __init__(self, joints: Joints, clock: Clock) -> None:
        """Know the joints; nothing is opened."""
        self._joints, self._clock = joints, clock
        self._open = False

    def __enter__(self) -> Self:
        """Open; these joints are always there."""
        self._open = True
        return self

    def close(self) -> None:
        """Damp the joints, if this driver commands them, and let them go."""
        if self._open and self._joints.commander is self:
            self._joints.take(MotorCommand.damping(len(self._joints.q), self._clock.now_s()))
            self._joints.commander = None
        self._open = False

    def claim(self) -> bool:
        """Become the one that commands; False while another one does."""
        self._check_open()
        # One process has them, whose death frees them. Two would need a lock that the system frees.
        self._joints.commander = self._joints.commander or self
        return self._joints.commander is self

    def read(self) -> MotorState:
        """Where the joints are. Raises DriverError if the driver is not open."""
        self._check_open()
        zero = np.zeros_like(self._joints.q)
        return MotorState(
            stamp_s=self._clock.now_s(),
            q=self._joints.q.copy(),
            qd=zero,
            tau=zero + np.nan,
            temperature_c=zero + np.nan,
            age_s=zero.copy(),
            watchdog=False,
            command_stamp_s=self._joints.command.stamp_s,
        )

    def write(self, command: MotorCommand) -> MotorCommand:
        """Send a command; returns what was sent: without torque, which these motors do not take."""
        if not self.claim():
            raise DriverError("another controller commands the motors")
        for field in fields(command):
            value = getattr(command, field.name)
            if field.name != "stamp_s" and value.shape != self._joints.q.shape:
                raise DriverError(f"{field.name} has the shape {value.shape}")
            if not np.isfinite(value).all():
                raise DriverError(f"{field.name} is not finite")
        sent = replace(command, tau_ff=np.zeros_like(self._joints.q))
        self._joints.take(sent)
        return sent

    def _check_open(self) -> None:
        if not self._open:
            raise DriverError("the motors are not open")


def make(wiring: Wiring) -> MotorBus:
    """Motors for every joint of the description."""
    return LoopbackMotors(Joints(len(wiring.robot.motors)), wiring.clock)
