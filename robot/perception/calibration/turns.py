# pyright: basic
# SciPy ships no types.
"""Rotations as vectors and back, and least squares over them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

Array = NDArray[np.float64]


def to_vector(rotation: Array) -> Array:
    """Axis times angle [rad] of rotation matrices, shape (..., 3)."""
    return Rotation.from_matrix(rotation).as_rotvec()


def pose(numbers: Array) -> Array:
    """The homogeneous matrix of a rotation vector [rad] and a position [m], together shape (6,)."""
    result = np.eye(4)
    result[:3, :3] = Rotation.from_rotvec(numbers[:3]).as_matrix()
    result[:3, 3] = numbers[3:]
    return result


def six_numbers(matrix: Array) -> Array:
    """The inverse of `pose`."""
    return np.concatenate((to_vector(matrix[:3, :3]), matrix[:3, 3]))


def least(residuals: Callable[[Array], Array], start: Array) -> Array:
    """The numbers that make the sum of squares of residuals least, from a start that is near."""
    return least_squares(residuals, start, method="lm", x_scale="jac").x
