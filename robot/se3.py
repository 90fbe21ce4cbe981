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

    def flat(self) -> SE3:
        """Same x, y and yaw, on the floor and upright."""
        return SE3.from_xy_yaw(self.p[0], self.p[1], self.yaw_rad)

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


def wrap_angle(angle_rad: float) -> float:
    """The same angle in [-pi, pi)."""
    return (angle_rad + math.pi) % (2.0 * math.pi) - math.pi
