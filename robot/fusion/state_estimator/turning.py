"""Small rotations as matrices and vectors, in plain floats: numpy costs more than they do."""

from __future__ import annotations

import math

import numpy as np

from robot.se3 import Array


def exponential(x: float, y: float, z: float) -> Array:
    """Rotation matrix of a rotation vector [rad], shape (3, 3) (Rodrigues)."""
    square = x * x + y * y + z * z
    if square < 1e-8:
        a, b = 1.0 - square / 6.0, 0.5 - square / 24.0
    else:
        angle = math.sqrt(square)
        a, b = math.sin(angle) / angle, (1.0 - math.cos(angle)) / square
    xy, xz, yz = b * x * y, b * x * z, b * y * z
    return np.array(
        (
            (1.0 - b * (y * y + z * z), xy - a * z, xz + a * y),
            (xy + a * z, 1.0 - b * (x * x + z * z), yz - a * x),
            (xz - a * y, yz + a * x, 1.0 - b * (x * x + y * y)),
        )
    )


def small_turn(rotation: Array) -> Array:
    """Rotation vector [rad] of a turn of less than a right angle, shape (3,)."""
    (_, a, b), (c, _, d), (e, f, _) = rotation.tolist()
    x, y, z = 0.5 * (f - d), 0.5 * (b - e), 0.5 * (c - a)
    sine = math.sqrt(x * x + y * y + z * z)
    scale = 1.0 + sine * sine / 6.0 if sine < 0.1 else math.asin(min(1.0, sine)) / sine
    return np.array((scale * x, scale * y, scale * z))


def orthogonal(rotation: Array) -> Array:
    """The rotation nearest to a matrix that rounding took a little off, to first order."""
    return 1.5 * rotation - 0.5 * (rotation @ rotation.T @ rotation)


def skew_into(levers: Array, row: int, vector: Array) -> None:
    """Write [vector]x into three rows, shape (3, 3); the diagonal is zero."""
    x, y, z = vector.tolist()
    levers[row, 1], levers[row, 2] = -z, y
    levers[row + 1, 0], levers[row + 1, 2] = z, -x
    levers[row + 2, 0], levers[row + 2, 1] = -y, x
