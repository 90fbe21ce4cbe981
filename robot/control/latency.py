"""How late the motors obey: what they give now, held against what they were told before.

A command is in force some time after it was computed: buses, drivers and firmware each keep it for
a while. The torques that motors measure tell for how long, with nothing to calibrate: of the last
commands, the one that explains how the torques change is the one in force. A motor closes its loop
on where its joint is by then, and gives no more than it can; so does what it is held against. (Held
against torques as they were computed from older joints, a body that pushes itself off the floor at
the limits of its motors looked 10 ms late, and swung itself to pieces once it stood.)
"""

from __future__ import annotations

import math

import numpy as np

from robot.drivers.motor_bus import MotorCommand, MotorState
from robot.se3 import Array

LONGEST_PERIODS = 10
"""20 ms at 500 Hz: what simulators train for (docs/realities.md), and when the watchdog damps."""
AGES = LONGEST_PERIODS + 1
"""Of commands that may be in force, in periods from 0."""
LOOK_EVERY = 4
"""Of so many periods one change of torques is looked at: enough, and half the time."""
CLEAR = 0.05
"""Evidence, in squared shares of peak torques, from which a delay is believed: the first weight
that comes onto the soles gives as much; without a delay it stays at 0."""
MOST_EVIDENCE = 1.0
"""So much is kept, that a delay which changes is found within seconds of walking."""


class Latency:
    """Keeps what the motors were told, and finds when they obey it.

    Attributes:
        delay_s: from a measurement to the torque that it leads to; 0 until something else is clear.
    """

    def __init__(self, torque_limit_nm: Array, period_s: float) -> None:
        """Know nothing yet.

        Args:
            torque_limit_nm: of every motor, shape (n,).
            period_s: of the bus.
        """
        self.delay_s = 0.0
        self._period_s = period_s
        self._limit_nm, self._inverse = torque_limit_nm, 1.0 / torque_limit_nm
        # Feedforward, kp, kd of what was told; rows are kept twice: any window of ages is a view.
        self._told: Array = np.zeros((3, 2 * AGES, len(torque_limit_nm)))
        self._last: MotorState | None = None
        self._error: Array | None = None
        self._row = 0
        self._periods = 0
        self._against: Array = np.zeros(AGES)
        self._command: MotorCommand | None = None

    def told(self, command: MotorCommand) -> None:
        """What is sent in this period; a command may be sent again."""
        before, self._row = self._row, (self._row + 1) % AGES
        told = self._told[:, self._row]
        if command is self._command:
            told[:] = self._told[:, before]
        else:
            self._command = command
            np.multiply(command.kp, command.q_des, out=told[0])
            told[0] += command.kd * command.qd_des
            told[0] += command.tau_ff
            told[1], told[2] = command.kp, command.kd
        self._told[:, self._row + AGES] = told

    def felt(self, state: MotorState) -> None:
        """What the motors measured after that, before the next command is told.

        Each age of a command collects the squared changes of the torques that it leaves
        unexplained, less those that the best one does. Changes, since offsets are constant.
        """
        self._periods += 1
        look = self._periods % LOOK_EVERY
        last, self._last = self._last, state
        if look > 1 or last is None:
            return
        error = (state.tau - self._owed(last, state)) * self._inverse
        error[:, np.isnan(state.tau)] = 0.0  # a motor that measures no torque tells nothing
        before, self._error = self._error, error
        if look == 0 or before is None or not math.isfinite(float(error[0].sum())):
            return
        change = error - before
        against = self._against
        against += np.einsum("ij,ij->i", change, change)
        against -= against.min()
        np.minimum(against, MOST_EVIDENCE, out=against)
        best = int(against.argmin())
        if float(against[0]) > CLEAR or best == 0:
            self.delay_s = best * self._period_s

    def _owed(self, last: MotorState, state: MotorState) -> Array:
        """What motors give under each age of command between two measurements [N m], (ages, n)."""
        newest = self._row + AGES
        feedforward, kp, kd = self._told[:, newest : newest - AGES : -1]
        torque = kp * (-0.5 * (last.q + state.q))
        torque += kd * (-0.5 * (last.qd + state.qd))
        torque += feedforward
        np.minimum(torque, self._limit_nm, out=torque)
        return np.maximum(torque, -self._limit_nm, out=torque)
