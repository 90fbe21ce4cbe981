"""Rigid transforms as values, in monogram notation: `X_WO = X_WC @ X_CO`."""

from __future__ import annotations

import math
from typing import TypeAlias

import msgspec
import numpy as np
from numpy.typing import ArrayLike, NDArray

Array: TypeAlias = NDArray[np.float64]
Vector3: TypeAlias = tuple[float, float, float]
Quaternion: TypeAlias = tuple[float, float, float, float]
NO_SINE = 1e-6
"""Below it the sine of an angle does not say about which axis: there is no turn, or half a turn."""


class SE3(msgspec.Struct, frozen=True):
    """Pose of one frame in another: position [m] and unit quaternion (w, x, y, z)."""

    p: Vector3 = (0.0, 0.0, 0.0)
    quat_wxyz: Quaternion = (1.0, 0.0, 0.0, 0.0)

    def __matmul__(self, other: SE3) -> SE3:
        """Compose: `X_AC = X_AB @ X_BC`."""
        x, y, z = rotate(self.quat_wxyz, other.p)
        px, py, pz = self.p
        return SE3((px + x, py + y, pz + z), multiply(self.quat_wxyz, other.quat_wxyz))

    def inverse(self) -> SE3:
        """`X_BA` of `X_AB`."""
        w, x, y, z = self.quat_wxyz
        conjugate = (w, -x, -y, -z)
        px, py, pz = rotate(conjugate, self.p)
        return SE3((-px, -py, -pz), conjugate)

    def apply(self, point: ArrayLike) -> Array:
        """Coordinates in A of a point given in B, shape (3,) [m]."""
        return self.rotation() @ np.asarray(point, dtype=np.float64) + np.array(self.p)

    def rotation(self) -> Array:
        """Rotation matrix R_AB, shape (3, 3)."""
        return quat_to_matrix(self.quat_wxyz)

    def matrix(self) -> Array:
        """Homogeneous matrix, shape (4, 4)."""
        result = np.eye(4)
        result[:3, :3] = self.rotation()
        result[:3, 3] = self.p
        return result

    @property
    def yaw_rad(self) -> float:
        """Heading of the x axis in the horizontal plane [rad]."""
        w, x, y, z = self.quat_wxyz
        return math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))

    @property
    def rpy_rad(self) -> Vector3:
        """Fixed-axis roll, pitch, yaw [rad]: what `from_rpy` takes; pitch within a quarter turn."""
        w, x, y, z = self.quat_wxyz
        roll = math.atan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y))
        pitch = math.asin(max(-1.0, min(1.0, 2.0 * (w * y - z * x))))
        return roll, pitch, self.yaw_rad

    def flat(self) -> SE3:
        """Same x, y and yaw, on the floor and upright."""
        return SE3.from_xy_yaw(self.p[0], self.p[1], self.yaw_rad)

    def towards(self, other: SE3, share: float) -> SE3:
        """The pose a share of the way to another, whose turn from this is small.

        Quaternions are blended and normed: over 0.5 rad that is within 0.001 rad of a steady turn.
        """
        p = [(1.0 - share) * a + share * b for a, b in zip(self.p, other.p, strict=True)]
        if self.quat_wxyz == other.quat_wxyz:
            return SE3((p[0], p[1], p[2]), self.quat_wxyz)
        pairs = zip(self.quat_wxyz, other.quat_wxyz, strict=True)
        w, x, y, z = ((1.0 - share) * a + share * b for a, b in pairs)
        norm = math.sqrt(w * w + x * x + y * y + z * z)
        return SE3((p[0], p[1], p[2]), (w / norm, x / norm, y / norm, z / norm))

    @staticmethod
    def from_xy_yaw(x_m: float, y_m: float, yaw_rad: float, *, z_m: float = 0.0) -> SE3:
        """Upright pose from planar coordinates."""
        half = 0.5 * yaw_rad
        return SE3((x_m, y_m, z_m), (math.cos(half), 0.0, 0.0, math.sin(half)))

    @staticmethod
    def from_rotation(rotation: ArrayLike, position: ArrayLike) -> SE3:
        """Pose from a rotation matrix, shape (3, 3), and a position, shape (3,)."""
        x, y, z = np.asarray(position, dtype=np.float64).reshape(3).tolist()
        return SE3((x, y, z), matrix_to_quat(np.asarray(rotation, dtype=np.float64)))

    @staticmethod
    def from_rpy(roll_rad: float, pitch_rad: float, yaw_rad: float, p: Vector3) -> SE3:
        """Pose from fixed-axis roll, pitch, yaw (Rz @ Ry @ Rx)."""
        cr, sr = math.cos(roll_rad / 2), math.sin(roll_rad / 2)
        cp, sp = math.cos(pitch_rad / 2), math.sin(pitch_rad / 2)
        cy, sy = math.cos(yaw_rad / 2), math.sin(yaw_rad / 2)
        return SE3(
            p,
            (
                cr * cp * cy + sr * sp * sy,
                sr * cp * cy - cr * sp * sy,
                cr * sp * cy + sr * cp * sy,
                cr * cp * sy - sr * sp * cy,
            ),
        )


def multiply(a: Quaternion, b: Quaternion) -> Quaternion:
    """Hamilton product, normalised."""
    aw, ax, ay, az = a
    bw, bx, by, bz = b
    w = aw * bw - ax * bx - ay * by - az * bz
    x = aw * bx + ax * bw + ay * bz - az * by
    y = aw * by - ax * bz + ay * bw + az * bx
    z = aw * bz + ax * by - ay * bx + az * bw
    norm = math.sqrt(w * w + x * x + y * y + z * z)
    return (w / norm, x / norm, y / norm, z / norm)


def rotate(quat_wxyz: Quaternion, v: Vector3) -> Vector3:
    """Rotate a vector by a unit quaternion."""
    w, x, y, z = quat_wxyz
    vx, vy, vz = v
    tx, ty, tz = 2 * (y * vz - z * vy), 2 * (z * vx - x * vz), 2 * (x * vy - y * vx)
    return (
        vx + w * tx + y * tz - z * ty,
        vy + w * ty + z * tx - x * tz,
        vz + w * tz + x * ty - y * tx,
    )


def quat_to_matrix(quat_wxyz: Quaternion) -> Array:
    """Rotation matrix of a unit quaternion, shape (3, 3)."""
    w, x, y, z = quat_wxyz
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def matrix_to_quat(rotation: Array) -> Quaternion:
    """Unit quaternion of a rotation matrix, w >= 0 (Shepperd's method)."""
    r = rotation.tolist()
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = r
    trace = xx + yy + zz
    if trace > 0.0:
        s = 2.0 * math.sqrt(trace + 1.0)
        quat = [0.25 * s, (zy - yz) / s, (xz - zx) / s, (yx - xy) / s]
    else:
        diagonal = (xx, yy, zz)
        i = diagonal.index(max(diagonal))
        j, k = (i + 1) % 3, (i + 2) % 3
        s = 2.0 * math.sqrt(max(1e-12, 1.0 + diagonal[i] - diagonal[j] - diagonal[k]))
        quat = [0.0] * 4
        quat[0] = (r[k][j] - r[j][k]) / s
        quat[1 + i] = 0.25 * s
        quat[1 + j] = (r[j][i] + r[i][j]) / s
        quat[1 + k] = (r[k][i] + r[i][k]) / s
    w, x, y, z = quat
    norm = math.copysign(math.sqrt(w * w + x * x + y * y + z * z), w)
    return (w / norm, x / norm, y / norm, z / norm)


def rotation_vector(rotation: Array) -> Array:
    """Axis times angle [rad] of a rotation matrix, shape (3,): the logarithm of SO(3).

    By atan2, which keeps its digits at every angle: an arccosine of the trace loses half of them
    near zero. Of the two of a half turn, one is given.
    """
    r = rotation
    skew = np.array([r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]])
    sine = 0.5 * math.sqrt(float(skew @ skew))
    cosine = 0.5 * (float(np.trace(r)) - 1.0)
    if sine < NO_SINE:
        return 0.5 * skew if cosine > 0.0 else math.pi * _half_turn_axis(r)
    return skew * (math.atan2(sine, cosine) / (2.0 * sine))


def rotation_vectors(rotations: Array) -> Array:
    """`rotation_vector` of many to 1e-6 rad, shapes (n, 3, 3) and (n, 3).

    A form of its own, as it would cost one matrix twice the time, in the loop of 500 Hz.
    """
    r = rotations
    axis = np.empty((len(r), 3))
    axis[:, 0] = 0.5 * (r[:, 2, 1] - r[:, 1, 2])
    axis[:, 1] = 0.5 * (r[:, 0, 2] - r[:, 2, 0])
    axis[:, 2] = 0.5 * (r[:, 1, 0] - r[:, 0, 1])
    sine = np.sqrt(np.sum(axis**2, axis=1))
    cosine = 0.5 * (r[:, 0, 0] + r[:, 1, 1] + r[:, 2, 2] - 1.0)
    vectors = axis * (np.arctan2(sine, cosine) / np.maximum(sine, NO_SINE))[:, None]
    for i in np.flatnonzero((sine < NO_SINE) & (cosine < 0.0)):
        vectors[i] = math.pi * _half_turn_axis(r[i])
    return vectors


def _half_turn_axis(rotation: Array) -> Array:
    """A unit vector a of R = 2 a a^T - I."""
    outer = 0.5 * (rotation + np.eye(3))
    column = outer[:, int(np.argmax(np.diag(outer)))]
    return column / np.linalg.norm(column)


def wrap_angle(angle_rad: float) -> float:
    """The same angle in [-pi, pi)."""
    return (angle_rad + math.pi) % (2.0 * math.pi) - math.pi
