"""The controller's last clamp on every motor command, whatever stands above it in that process.

Under it, in the driver of real motors, `robot.drivers.motors.limiter` clamps once more by the
motors' own map and is the last software there is; simulated motors have this one alone. Its trip
damps until the controller lets it go again; latches of others are `robot.owner.reactions` (below
it) and `executive.engine.estop` (above).
"""

from __future__ import annotations

import math

import numpy as np

from robot.drivers.motor_bus import MotorCommand, MotorState
from robot.model.body import BodyModel
from robot.se3 import Array

REFUSALS_TO_DAMP = 3
"""A command or two that are no numbers are bridged by the last good one; a third is no accident."""
OVERSPEED = 1.6
"""Faster than this part of its limit, for so many periods, no joint gets unless something broke."""
OVERSPEED_CYCLES = 3

CLAMPED = ("range", "speed", "torque")


class Limits:
    """Clamps positions, velocities and torques, refuses what is not finite, and counts both.

    Attributes:
        clamped: motor values clamped so far.
        most_clamped: the motor and the limit of most of them, with how many; empty while none was.
        refused: commands refused so far.
        tripped: why the motors must damp, empty while all is well; latched.
    """

    def __init__(self, body: BodyModel) -> None:
        """Take the limits from the description and the MJCF's joint ranges."""
        self.body = body
        self.clamped = 0
        self.most_clamped = ""
        self.refused = 0
        self.tripped = ""
        self._in_a_row = 0
        self._last_good: MotorCommand | None = None
        self._measured: MotorCommand | None = None
        self._middle: Array = 0.5 * (body.lower_rad + body.upper_rad)
        half = 0.5 * (body.upper_rad - body.lower_rad)
        overspeed = 1.0 / (OVERSPEED * body.velocity_limit_rad_s)
        names = body.description.motor_names
        for hand in body.description.hands.values():
            overspeed[names.index(hand.motor)] = 0.0  # fingers snap shut harmlessly
        bounds = np.array((half, body.velocity_limit_rad_s, body.torque_limit_nm))
        self._inverse: Array = np.vstack([1.0 / bounds, overspeed])
        # Rows: target position from the middle, target velocity, torque, measured velocity, each
        # as a share of its limit. The last two change while a command is repeated.
        self._share: Array = np.zeros_like(self._inverse)
        self._moving = self._share[2:], self._inverse[2:]
        self._drive: Array = np.zeros(body.count)  # what the measured command gives at rest at 0
        self._product: Array = np.zeros(body.count)
        self._fast_in_a_row = 0
        self._clamps = np.zeros((len(CLAMPED), body.count), dtype=np.int64)

    def reset(self) -> None:
        """Forget a trip."""
        self.tripped = ""
        self._in_a_row = 0
        self._fast_in_a_row = 0

    def apply(self, command: MotorCommand, state: MotorState) -> MotorCommand:
        """What may be sent: the command clamped, the last good one, or damping.

        A command that came out of here may come in again; what it wants is not checked anew, what
        it gives for the newest state is.
        """
        body = self.body
        if self.tripped:
            return MotorCommand.damping(body.count, command.stamp_s, body.kd)
        worst = self._measure(command, state)
        if worst <= 1.0:
            self._fast_in_a_row = 0
        else:
            self._check_speed(state)
            if self.tripped:
                return MotorCommand.damping(body.count, command.stamp_s, body.kd)
            if not math.isfinite(worst):
                return self._refuse(command)
            self._clamp(command, state)
            self._measured = None
        if command is not self._last_good:
            self._in_a_row = 0  # a repeated command says nothing of newer ones
            self._last_good = command
        return command

    def _measure(self, command: MotorCommand, state: MotorState) -> float:
        """The largest share of a limit that command and state take; not finite if either is not."""
        targets, drive, product = self._share, self._drive, self._product
        again = command is self._measured
        if not again:
            self._measured = command
            np.subtract(command.q_des, self._middle, out=targets[0])
            targets[1] = command.qd_des
            np.multiply(command.kp, command.q_des, out=drive)
            np.multiply(command.kd, command.qd_des, out=product)
            drive += product
            drive += command.tau_ff
        share, inverse = self._moving if again else (targets, self._inverse)
        torque = targets[2]
        np.multiply(command.kp, state.q, out=torque)
        np.multiply(command.kd, state.qd, out=product)
        torque += product
        torque -= drive
        targets[3] = state.qd
        np.multiply(share, inverse, out=share)
        np.abs(share, out=share)
        return float(np.maximum.reduce(share, axis=None))

    def _check_speed(self, state: MotorState) -> None:
        """A joint far over its speed for a few cycles means that something broke: damp."""
        share = self._share[3]
        if float(np.maximum.reduce(share)) < 1.0:
            self._fast_in_a_row = 0
            return
        self._fast_in_a_row += 1
        if self._fast_in_a_row >= OVERSPEED_CYCLES:
            worst = int(share.argmax())
            name = self.body.description.motor_names[worst]
            self.tripped = f"{name} overspeed, {abs(float(state.qd[worst])):.1f} rad/s"

    def _refuse(self, command: MotorCommand) -> MotorCommand:
        """Not finite: hold the last good command, damp from the third in a row."""
        self.refused += 1
        self._in_a_row += 1
        body, last = self.body, self._last_good
        if self._in_a_row >= REFUSALS_TO_DAMP or last is None:
            self.tripped = f"{self._in_a_row} commands in a row were not finite"
            return MotorCommand.damping(body.count, command.stamp_s, body.kd)
        last.stamp_s = command.stamp_s
        return last

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
        self._clamps += (q_des != command.q_des, qd_des != command.qd_des, kept != total)
        self.clamped = int(self._clamps.sum())
        if self.clamped:
            kind, motor = divmod(int(self._clamps.argmax()), body.count)
            name, count = body.description.motor_names[motor], int(self._clamps[kind, motor])
            self.most_clamped = f"{name}'s {CLAMPED[kind]}, {count} times"
        command.q_des, command.qd_des, command.tau_ff = q_des, qd_des, tau_ff
