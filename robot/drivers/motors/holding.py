"""What joints are told while an alarm says HOLD: where they were sent last, and nothing new."""

from __future__ import annotations

import numpy as np

from robot.drivers.motor_bus import MotorCommand
from robot.drivers.motors.alarms import Level
from robot.se3 import Array


class Holding:
    """Decides between a command and the last targets before an alarm."""

    def __init__(self) -> None:
        """Nothing is held."""
        self._held: MotorCommand | None = None

    def forget(self) -> None:
        """Hold nothing."""
        self._held = None

    def decided(
        self, command: MotorCommand, level: Level, *, obeyed: MotorCommand | None, q: Array
    ) -> MotorCommand:
        """The command, or what an alarm wants in its place.

        Args:
            command: what was asked for.
            level: of the alarms.
            obeyed: what joints were told last; None: nothing yet, and then they damp.
            q: where they are: a joint that had no stiffness is held there, shape (n,).
        """
        if level != Level.HOLD:
            self._held = None
            return command
        if obeyed is None:
            return MotorCommand.damping(len(q), command.stamp_s)
        if self._held is None:
            last = obeyed
            q_des = np.where(last.kp > 0.0, last.q_des, q)
            self._held = MotorCommand(0.0, q_des, np.zeros_like(q), last.tau_ff, last.kp, last.kd)
        held = self._held
        return MotorCommand(command.stamp_s, held.q_des, held.qd_des, held.tau_ff, held.kp, held.kd)
