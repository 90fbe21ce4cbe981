"""How late the motors obey: what they give now, held against what they were told before.

A command is in force some time after it was computed: buses, drivers and firmware each keep it for
a while. The torques that motors measure tell for how long, with nothing to calibrate: of the last
commands, the one that explains how the torques change is the one in force.
"""

from __future__ import annotations

import math

import numpy as np

from robot.drivers.motor_bus import MotorCommand, MotorState
from robot.se3 import Array

LONGEST_PERIODS = 10
"""20 ms at 500 Hz: what simulators train for (docs/realities.md), and when the watchdog damps."""
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
        rows, self._period_s = LONGEST_PERIODS + 1, period_s
        self._inverse = 1.0 / torque_limit_nm
        self._told: Array = np.zeros((rows, len(torque_limit_nm)))
        self._error: Array | None = None
        self._row = 0
        self._periods = 0
        self._ages = [(row - np.arange(rows)) % rows for row in range(rows)]
        self._against: Array = np.zeros(rows)
        self._command: MotorCommand | None = None

    def told(self, command: MotorCommand, state: MotorState) -> None:
        """What is sent in this period, for that state; a command may be sent again."""
        self._row = (self._row + 1) % len(self._told)
        if command is self._command:
            self._told[self._row] = self._told[self._row - 1]
            return
        self._command = command
        torque = self._told[self._row]
        np.subtract(command.q_des, state.q, out=torque)
        torque *= command.kp
        torque += command.kd * (command.qd_des - state.qd)
        torque += command.tau_ff

    def felt(self, state: MotorState) -> None:
        """What the motors measured after that, before the next command is told.

        Each age of a command collects the squared changes of the torques that it leaves
        unexplained, less those that the best one does. Changes, since offsets are constant.
        """
        self._periods += 1
        look = self._periods % LOOK_EVERY
        if look > 1:
            return
        error = (state.tau - self._told[self._ages[self._row]]) * self._inverse
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
