"""Poses in the plane, as arrays (..., 3) of x [m], y [m] and heading [rad]."""

from __future__ import annotations

import numpy as np

from robot.se3 import Array


def wrapped(angles_rad: Array) -> Array:
    """Angles in [-pi, pi)."""
    return np.mod(angles_rad + np.pi, 2.0 * np.pi) - np.pi


def compose(first: Array, second: Array) -> Array:
    """X_AC of X_AB and X_BC."""
    cos, sin = np.cos(first[..., 2]), np.sin(first[..., 2])
    x, y = second[..., 0], second[..., 1]
    return np.stack(
        [
            first[..., 0] + cos * x - sin * y,
            first[..., 1] + sin * x + cos * y,
            wrapped(first[..., 2] + second[..., 2]),
        ],
        axis=-1,
    )


def between(first: Array, second: Array) -> Array:
    """X_AB of X_WA and X_WB."""
    cos, sin = np.cos(first[..., 2]), np.sin(first[..., 2])
    x, y = second[..., 0] - first[..., 0], second[..., 1] - first[..., 1]
    return np.stack(
        [cos * x + sin * y, cos * y - sin * x, wrapped(second[..., 2] - first[..., 2])], axis=-1
    )


def inverse(pose: Array) -> Array:
    """X_BA of X_AB."""
    return between(pose, np.zeros(3))


def turn(angle_rad: float) -> Array:
    """The matrix that turns rows of points by an angle when it stands to their right."""
    cos, sin = np.cos(angle_rad), np.sin(angle_rad)
    return np.array([[cos, sin], [-sin, cos]])


def placed(pose: Array, points: Array) -> Array:
    """Points (n, 2) of a frame, seen from the frame that its pose is given in."""
    return points @ turn(float(pose[2])) + pose[:2]
