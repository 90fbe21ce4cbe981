"""Which links of a robot are its soles and its IMU, and where they are in every sample of a log.

Names are conventions, so they are only where the search begins: a sole must hang on joints that the
log has, and of the frames called IMU it is the one in which the accelerometer, at the start, feels
the floor's push the way the soles do.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

import numpy as np

from robot.errors import ConfigError, Problem
from robot.fusion.state_estimator.legged_log import LeggedLog
from robot.fusion.state_estimator.urdf_chains import Chains
from robot.se3 import Array

SIDES = (r"(^|_)(l|left)(_|$)|^l_|left", r"(^|_)(r|right)(_|$)|^r_|right")
FOOT_WORDS = ("sole", "foot", "ankle")
IMU_WORDS = ("imu", "gyro", "accel", "inertial")
AT_START = 20
"""So many first samples say which way is up."""
AGREE_RAD = math.radians(20.0)
FEWEST_JOINTS = 3


@dataclass(frozen=True)
class LeggedBody:
    """Kinematics of a recording, for every sample.

    Attributes:
        soles: names of the left and the right one.
        imu: name of the IMU's frame.
        R_BI: its orientation in the base, shape (3, 3).
        p_BI: its position in the base [m], shape (3,).
        positions: of both soles in I [m], shape (n, 2, 3).
        rotations: their orientations in I, z up, shape (n, 2, 3, 3).
        accel_sign: -1 where the accelerometer reads gravity rather than the push against it.
        mass_kg: of the whole robot, 0 if unknown.
    """

    soles: tuple[str, str]
    imu: str
    R_BI: Array
    p_BI: Array
    positions: Array
    rotations: Array
    accel_sign: float
    mass_kg: float


def find(
    chains: Chains, log: LeggedLog, *, soles: tuple[str, str] | None = None, imu: str | None = None
) -> LeggedBody:
    """Find soles and IMU, by name where they are told.

    Raises:
        ConfigError: there are none that fit the log.
    """
    names = soles or (_sole(chains, log, 0), _sole(chains, log, 1))
    poses = [chains.poses(_checked(chains, log, name), log.joints) for name in names]
    at_start = [rotations[:AT_START].mean(axis=0) for rotations, _ in poses]
    ups = [_up(rotation) for rotation in at_start]
    up_B = sum(rotation @ up for rotation, up in zip(at_start, ups, strict=True))
    name, sign = _imu(chains, log, np.asarray(up_B), imu)
    rotations_BI, positions_BI = chains.poses(name, log.joints)
    R_BI, p_BI = rotations_BI[0], positions_BI[0]
    positions = np.stack([(p - p_BI) @ R_BI for _, p in poses], axis=1)
    rotations = np.stack(
        [R_BI.T @ R @ _level(up) for (R, _), up in zip(poses, ups, strict=True)], axis=1
    )
    return LeggedBody(
        (names[0], names[1]), name, R_BI, p_BI, positions, rotations, sign, chains.mass_kg
    )


def _sole(chains: Chains, log: LeggedLog, side: int) -> str:
    """The link that is most likely the sole of a side: named so, shortest, on a leg of the log."""
    named = [link for link in chains.links if re.search(SIDES[side], link.lower())]
    for word in FOOT_WORDS:
        for link in sorted((n for n in named if word in n.lower()), key=len):
            joints = chains.moving(link)
            if len(joints) >= FEWEST_JOINTS and all(joint in log.joints for joint in joints):
                return link
    which = ("left", "right")[side]
    text = f"has no {which} foot on joints that the log has"
    raise _misfit(chains, text, "name them: --feet LEFT_LINK,RIGHT_LINK; the log's joints are "
                  + ", ".join(list(log.joints)[:40]))  # fmt: skip


def _checked(chains: Chains, log: LeggedLog, link: str) -> str:
    """A link whose place the log's joints tell."""
    if link not in chains.links:
        raise _misfit(chains, f"has no link {link!r}", "its links are in the file")
    missing = [joint for joint in chains.moving(link) if joint not in log.joints]
    if missing:
        text = f"needs the joints {', '.join(missing)} for {link}, which the log has not"
        raise _misfit(chains, text, "give the URDF of the robot that recorded the log")
    return link


def _imu(chains: Chains, log: LeggedLog, up_B: Array, told: str | None) -> tuple[str, float]:
    """The IMU's frame on the base, and the sign of its accelerometer."""
    felt = np.median(log.accel_m_s2[:AT_START], axis=0)
    named = [n for n in chains.links if any(word in n.lower() for word in IMU_WORDS)]
    fixed = [n for n in named if not chains.moving(n) and (n == chains.base or chains.path(n))]
    candidates = [_checked(chains, log, told)] if told else [*fixed, chains.base]
    offs: list[tuple[float, str, float]] = []
    at_first = {joint: values[:1] for joint, values in log.joints.items()}
    for name in candidates:
        up = chains.poses(name, at_first)[0][0] @ felt
        norm = float(np.linalg.norm(up)) * float(np.linalg.norm(up_B))
        cosine = float(up @ up_B) / max(norm, 1e-9)
        sign = 1.0 if cosine >= 0.0 else -1.0
        offs.append((math.acos(min(1.0, abs(cosine))), name, sign))
    off_rad, name, sign = min(offs, key=lambda off: off[0])
    if off_rad > AGREE_RAD:
        text = (
            f"puts the IMU {name} so that it feels {math.degrees(off_rad):.0f} degrees beside "
            "what the soles call up"
        )
        raise _misfit(chains, text, "name its frame: --imu LINK; the robot must stand at the start")
    return name, sign


def _up(rotation: Array) -> Array:
    """Which axis of a sole points to the base, as it stands: the nearest of six, shape (3,).

    The base is taken to be nearer upright than on its side.
    """
    towards = rotation[2]
    k = int(np.argmax(np.abs(towards)))
    up = np.zeros(3)
    up[k] = math.copysign(1.0, towards[k])
    return up


def _level(up: Array) -> Array:
    """A rotation that takes z to that axis, shape (3, 3)."""
    k = int(np.argmax(np.abs(up)))
    turn = np.zeros((3, 3))
    turn[:, 2] = up
    turn[(k + 1) % 3, 0] = 1.0
    turn[:, 1] = np.cross(turn[:, 2], turn[:, 0])
    return turn


def _misfit(chains: Chains, what: str, cure: str) -> ConfigError:
    return ConfigError([Problem(what, chains.file, suggestion=cure)])
