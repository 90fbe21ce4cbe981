"""Buildings of straight walls, a robot that drives in them, what its lidar and its wheels say."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from robot.fusion.slam.planar import between, compose
from robot.fusion.slam.recording import Recording
from robot.fusion.slam.scan import Scan, scan_of
from robot.se3 import Array

NO_RETURN_CM = 8183
RANGE_M = 20.0


@dataclass(frozen=True)
class Lidar:
    """Beams of a planar lidar."""

    beams: int = 180
    first_rad: float = -np.pi / 2
    step_rad: float = np.pi / 180
    noise_m: float = 0.01


def box(x: float, y: float, width: float, depth: float) -> list[tuple[float, float, float, float]]:
    """The four walls of a rectangle, as segments x1, y1, x2, y2."""
    a, b, c, d = x, y, x + width, y + depth
    return [(a, b, c, b), (c, b, c, d), (c, d, a, d), (a, d, a, b)]


def room() -> Array:
    """Unlike itself wherever one looks: a room with a pillar, a cupboard and an alcove."""
    walls = [*box(0, 0, 8, 5), *box(2.6, 1.2, 0.5, 0.5), *box(5.2, 4.3, 1.6, 0.7)]
    return np.array([*walls, (6.5, 0.0, 7.0, 1.0), (0.0, 3.4, 1.0, 3.4)])


def ring(side_m: float = 16.0, width_m: float = 2.0, *, seed: int = 3) -> Array:
    """A corridor around a block, with niches and pillars at places drawn from a seed."""
    rng = np.random.default_rng(seed)
    outer, inner = side_m, side_m - 2 * width_m
    walls = [*box(0, 0, outer, outer), *box(width_m, width_m, inner, inner)]
    for along in np.arange(1.5, side_m - 2.0, 2.0):
        for k in range(4):
            at, size = along + rng.uniform(-0.6, 0.6), rng.uniform(0.2, 0.5)
            near = {0: (at, 0.0), 1: (outer - size, at), 2: (at, outer - size), 3: (0.0, at)}[k]
            walls += box(*near, size, size)
    return np.array(walls)


def ranges_m(walls: Array, pose: Array, lidar: Lidar = Lidar()) -> Array:
    """How far each beam goes, inf where it meets nothing within range."""
    angles = pose[2] + lidar.first_rad + lidar.step_rad * np.arange(lidar.beams)
    dx, dy = np.cos(angles)[:, None], np.sin(angles)[:, None]
    x1, y1, x2, y2 = (walls[:, k] for k in range(4))
    ex, ey, px, py = x2 - x1, y2 - y1, x1 - pose[0], y1 - pose[1]
    across = dx * ey - dy * ex
    with np.errstate(divide="ignore", invalid="ignore"):
        along = (px * ey - py * ex) / across
        share = (px * dy - py * dx) / across
    met = (along > 0) & (share >= 0) & (share <= 1) & (along < RANGE_M)
    return np.where(met, along, np.inf).min(axis=1)


def scan(walls: Array, pose: Array, lidar: Lidar = Lidar(), *, seed: int = 0) -> Scan:
    """A sweep with noise."""
    noise = np.random.default_rng(seed).normal(0.0, lidar.noise_m, lidar.beams)
    found = ranges_m(walls, pose, lidar) + noise
    return scan_of(found, lidar.first_rad, lidar.step_rad, range_max_m=RANGE_M)


def rounds(side_m: float = 16.0, width_m: float = 2.0, *, times: float = 1.3) -> Array:
    """Poses of a robot that drives round a ring's corridor, 0.2 m apart; corners in arcs."""
    low, high = width_m / 2, side_m - width_m / 2
    poses: list[tuple[float, float, float]] = []
    length = 4 * (high - low)
    for at in np.arange(0.0, times * length, 0.2):
        side, along = divmod(at % length, high - low)
        # Within 0.8 m of a corner the heading turns.
        turn = np.clip((along - (high - low) + 0.8) / 0.8, 0.0, 1.0)
        heading = (side + turn) * np.pi / 2
        x, y = [(low + along, low), (high, low + along), (high - along, high), (low, high - along)][
            int(side)
        ]
        poses.append((x, y, heading))
    return np.array(poses)


def drifting(poses: Array, *, seed: int, scale: float = 1.0) -> Array:
    """What wheels say of a way: each step with an error of its own, and a bias to one side."""
    rng = np.random.default_rng(seed)
    steps = between(poses[:-1], poses[1:])
    way = np.hypot(steps[:, 0], steps[:, 1])
    steps[:, :2] *= 1.0 + scale * (0.02 + 0.03 * rng.normal(size=(len(steps), 1)))
    steps[:, 2] += scale * (0.02 * way + 0.005 * rng.normal(size=len(steps)))
    odometry = [np.zeros(3)]
    for step in steps:
        odometry.append(compose(odometry[-1], step))
    return np.array(odometry)


def recording(
    walls: Array, poses: Array, odometry: Array, lidar: Lidar = Lidar(), *, seed: int = 0
) -> Recording:
    """What a robot on a way records."""
    rng = np.random.default_rng(seed)
    rows = []
    for pose in poses:
        found = ranges_m(walls, pose, lidar) + rng.normal(0.0, lidar.noise_m, lidar.beams)
        rows.append(np.where(np.isfinite(found), np.round(100 * found), NO_RETURN_CM))
    return Recording(
        stamps_s=np.arange(len(poses)) * 0.2,
        odometry=odometry,
        ranges_cm=np.array(rows, dtype=np.uint16),
        angle_min_rad=lidar.first_rad,
        angle_step_rad=lidar.step_rad,
        range_max_m=RANGE_M,
    )


def clockwise(taken: Recording) -> Recording:
    """The same, from a lidar that turns the other way."""
    last = taken.angle_min_rad + taken.angle_step_rad * (taken.ranges_cm.shape[1] - 1)
    return replace(
        taken,
        ranges_cm=taken.ranges_cm[:, ::-1],
        angle_min_rad=last,
        angle_step_rad=-taken.angle_step_rad,
    )


def write(taken: Recording, path: Path) -> None:
    """As a file that `humanoid map build` reads."""
    np.savez_compressed(
        path,
        t=taken.stamps_s,
        odom=taken.odometry,
        ranges_cm=taken.ranges_cm,
        angle_min=taken.angle_min_rad,
        angle_inc=taken.angle_step_rad,
    )


def errors(found: Array, true: Array, *, apart: int) -> Array:
    """Errors (n, 3) of the relative poses of rows so far apart."""
    return between(between(true[:-apart], true[apart:]), between(found[:-apart], found[apart:]))
