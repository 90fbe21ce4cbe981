"""The error state of the contact filter: its covariance, and how a measurement moves it."""

from __future__ import annotations

import math

import numpy as np

from robot.fusion.state_estimator.parameters import Parameters
from robot.fusion.state_estimator.turning import exponential, orthogonal
from robot.se3 import Array

R, V, P, LEFT, RIGHT = (slice(k, k + 3) for k in range(0, 15, 3))
LEFT_TURN, RIGHT_TURN = slice(15, 18), slice(18, 21)
GYRO_BIAS, ACCEL_BIAS = slice(21, 24), slice(24, 27)
FLOOR = slice(27, 30)
SIZE = 30
FOOT, FOOT_TURN = (LEFT, RIGHT), (LEFT_TURN, RIGHT_TURN)


class ErrorState:
    """What is estimated and how far it may be off; `ContactFilter` says what each part is."""

    def __init__(self, parameters: Parameters) -> None:
        """Everything at zero, and sure."""
        self.parameters = parameters
        self.rotation: Array = np.eye(3)
        self.v: Array = np.zeros(3)
        self.p: Array = np.zeros(3)
        self.feet: Array = np.zeros((2, 3))
        self.turns: Array = np.zeros((2, 3, 3))
        self.gyro_bias: Array = np.zeros(3)
        self.accel_bias: Array = np.zeros(3)
        self.floor: Array = np.zeros(3)
        self.covariance: Array = np.zeros((SIZE, SIZE))
        self._diagonal: Array = self.covariance.reshape(-1)[:: SIZE + 1]
        self._H: Array = np.zeros((18, SIZE))
        self._z: Array = np.zeros(18)
        self._noise: Array = np.zeros(18)

    def _round_off(self) -> None:
        """Take back what rounding did: rotations are orthogonal, a covariance is symmetric."""
        self.rotation = orthogonal(self.rotation)
        for side in (0, 1):
            self.turns[side] = orthogonal(self.turns[side])
        self.covariance += self.covariance.T
        self.covariance *= 0.5

    def _update(self, rows: int, *, gate: float = math.inf) -> bool:
        """Take in the first `rows` measurements; False, and nothing done, past the gate.

        The gate is a squared distance for 6 rows; of more rows as many times more is normal.
        """
        H, z, covariance = self._H[:rows], self._z[:rows], self.covariance
        HP = H.dot(covariance)
        S = HP.dot(H.T)
        S.reshape(-1)[:: rows + 1] += self._noise[:rows]
        inverse = np.asarray(np.linalg.inv(S), dtype=np.float64)
        weighed = inverse.dot(z)
        if float(weighed.dot(z)) > gate + 1.5 * (rows - 6):
            return False
        self._move(HP.T.dot(weighed))
        covariance -= HP.T.dot(inverse.dot(HP))
        return True

    def _move(self, step: Array) -> None:
        """Apply an error: ``Exp(step) state_hat``."""
        rx, ry, rz = step[:3].tolist()
        turn = exponential(rx, ry, rz)
        self.rotation = turn.dot(self.rotation)
        self.v = turn.dot(self.v)
        self.v += step[V]
        self.p = turn.dot(self.p)
        self.p += step[P]
        self.feet = self.feet.dot(turn.T)
        self.feet += step[9:15].reshape(2, 3)
        for side in (0, 1):
            x, y, z = step[FOOT_TURN[side]].tolist()
            self.turns[side] = exponential(x, y, z).dot(self.turns[side])
        self.gyro_bias += step[GYRO_BIAS]
        self.accel_bias += step[ACCEL_BIAS]
        self.floor += step[FLOOR]
