"""The five numbers of a command: position, velocity, kp, kd, torque, and how far each may go."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from robot.drivers.motors.can.values import Ranges
from robot.errors import DriverError
from robot.se3 import Array

FIELDS = ("position", "velocity", "kp", "kd", "torque")


def limits(ranges: Sequence[Ranges]) -> tuple[Array, Array]:
    """The least and the most of each number, of several motors, shape (5, n) each."""
    position, velocity, torque, kp, kd = np.array(ranges).reshape(-1, 5).T
    high = np.stack([position, velocity, kp, kd, torque])
    return high * [[-1.0], [-1.0], [0.0], [0.0], [-1.0]], high


def refuse_misfits(targets: Array, low: Array, high: Array) -> None:
    """Whether all numbers fit, shape (5, n) each.

    Raises:
        DriverError: naming the first that is not finite or does not, and where it would have to be.
    """
    fits = (targets >= low) & (targets <= high)  # NaN does not, either
    if fits.all():
        return
    row, motor = (int(index) for index in np.argwhere(~fits)[0])
    text = f"{FIELDS[row]} {targets[row, motor]:g} does not fit into"
    raise DriverError(f"{text} {low[row, motor]:g} to {high[row, motor]:g}")
