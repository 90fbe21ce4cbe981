"""The last clamp on every motor command, whatever stands above it."""

from __future__ import annotations

import numpy as np

from robot.drivers.motors import MotorCommand, MotorState
from robot.model.body import BodyModel

REFUSALS_TO_DAMP = 3
OVERSPEED = 1.6


class Limits:
    """Clamps positions, velocities and torques, refuses what is not finite, and counts both.

    Attributes:
        clamped: motor values clamped so far.
        refused: commands refused so far.
        tripped: why the motors must damp, empty while all is well; latched.
    """

    def __init__(self, body: BodyModel) -> None:
        """Take the limits from the description and the MJCF's joint ranges."""
        self.body = body
        self.clamped = 0
        self.refused = 0
        self.tripped = ""
        self._in_a_row = 0
        self._last_good: MotorCommand | None = None

    def reset(self) -> None:
        """Forget a trip."""
        self.tripped = ""
        self._in_a_row = 0

    def apply(self, command: MotorCommand, state: MotorState) -> MotorCommand:
        """What may be sent: the command clamped, the last good one, or damping."""
        body = self.body
        speed = np.abs(state.qd)
        if (speed > OVERSPEED * body.velocity_limit_rad_s).any():
            worst = int(np.argmax(speed / body.velocity_limit_rad_s))
            name = body.description.motor_names[worst]
            self.tripped = f"{name} overspeed, {speed[worst]:.1f} rad/s"
        if self.tripped:
            return MotorCommand.damping(body.count, command.stamp_s, body.kd)
        if not self._finite(command):
            self.refused += 1
            self._in_a_row += 1
            if self._in_a_row >= REFUSALS_TO_DAMP or self._last_good is None:
                self.tripped = f"{self._in_a_row} commands in a row were not finite"
                return MotorCommand.damping(body.count, command.stamp_s, body.kd)
            self._last_good.stamp_s = command.stamp_s
            return self._last_good
        self._in_a_row = 0
        self._clamp(command, state)
        self._last_good = command
        return command

    def _finite(self, command: MotorCommand) -> bool:
        total = (
            command.q_des.sum()
            + command.qd_des.sum()
            + command.tau_ff.sum()
            + command.kp.sum()
            + command.kd.sum()
        )
        return bool(np.isfinite(total))

    def _clamp(self, command: MotorCommand, state: MotorState) -> None:
        """In place: position target, velocity target, then what the firmware's law would give."""
        body = self.body
        q_des = np.minimum(np.maximum(command.q_des, body.lower_rad), body.upper_rad)
        limit = body.velocity_limit_rad_s
        qd_des = np.minimum(np.maximum(command.qd_des, -limit), limit)
        feedback = command.kp * (q_des - state.q) + command.kd * (qd_des - state.qd)
        torque = body.torque_limit_nm
        total = feedback + command.tau_ff
        kept = np.minimum(np.maximum(total, -torque), torque)
        tau_ff = np.where(kept == total, command.tau_ff, kept - feedback)
        self.clamped += int(
            np.count_nonzero(q_des != command.q_des)
            + np.count_nonzero(qd_des != command.qd_des)
            + np.count_nonzero(kept != total)
        )
        command.q_des, command.qd_des, command.tau_ff = q_des, qd_des, tau_ff
