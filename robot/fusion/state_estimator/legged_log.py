"""Recordings of a legged robot's own senses: joints, IMU and the force under each foot.

An `.npz` of arrays, one row a sample: `t` [s], `joint_names`, `joint_pos` [rad], `imu_acc` [m/s²]
(specific force), `imu_gyro` [rad/s], `l_foot_fz` and `r_foot_fz` [N] (or wrenches whose third
column is the vertical force), and where the base began: `gt_base_pos0`, `gt_base_rpy0`, or the
first row of `gt_base_pos`, `gt_base_rpy`. What else there is, is not looked at.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import cast

import numpy as np
from numpy.typing import NDArray

from robot.errors import ConfigError, Problem
from robot.files.archives import Archive
from robot.se3 import SE3, Array

MOST_BYTES = 200_000_000
"""Of all arrays: 20 minutes of 30 joints, 500 times a second."""
MOST_SAMPLES, MOST_JOINTS = 5_000_000, 1000
LARGEST = {"t": 1e12, "joint_pos": 1e4, "imu_gyro": 1e4, "imu_acc": 1e5}
"""What no clock, joint or sensor says [s, rad, rad/s, m/s²]: larger numbers are no measurement."""
LARGEST_FORCE_N, LARGEST_M, LARGEST_RAD = 1e6, 1e6, 1e3
LEFT = ("l_foot_fz", "left_foot_fz", "l_foot_force", "left_foot_force", "fz_left", "left_fz")
RIGHT = ("r_foot_fz", "right_foot_fz", "r_foot_force", "right_foot_force", "fz_right", "right_fz")
CURE = "docs/state_estimation.md shows the fields of a recording"
BURST_SHARE, BURST_OF_PERIOD = 0.05, 0.25
BACKLOG_S = 1.0
"""Samples that waited in a queue for longer than this are not put back to where they belong."""


@dataclass(frozen=True)
class LeggedLog:
    """One recording of n samples; what was no number is filled in, and `gaps` says where.

    Attributes:
        t: stamps as recorded [s], shape (n,).
        taken_s: when the samples were taken [s], never decreasing, shape (n,).
        joints: positions by name [rad, m], shape (n,) each.
        gyro_rad_s, accel_m_s2: in the IMU's frame, shape (n, 3).
        force_n: upward force on the left and the right foot, shape (n, 2).
        blind: whether a sample's joints were no numbers, shape (n,).
        X_WB: first pose of the base, None where the recording does not say.
        filled: samples in which anything was no number.
        bursts: whether the stamps are of when samples arrived, many at once.
    """

    t: Array
    taken_s: Array
    joints: dict[str, Array]
    gyro_rad_s: Array
    accel_m_s2: Array
    force_n: Array
    blind: NDArray[np.bool_]
    X_WB: SE3 | None
    filled: int
    bursts: bool

    def __len__(self) -> int:
        """How many samples."""
        return len(self.t)


def load(path: Path) -> LeggedLog:
    """Read a recording.

    Raises:
        ConfigError: it cannot be read, is no such file, or lacks a field, with the field's name.
    """
    fields = _Fields(path)
    t = fields.rows("t")
    fields.count = n = len(t)
    if n < 2:
        raise fields.wrong("t", "holds fewer than two samples")
    names = fields.names("joint_names")
    positions = fields.rows("joint_pos", len(names))
    gyro, accel = fields.rows("imu_gyro", 3), fields.rows("imu_acc", 3)
    force = np.stack([fields.force(LEFT), fields.force(RIGHT)], axis=1)
    blind = np.asarray(~np.isfinite(positions).all(axis=1))
    unknown = blind | ~np.isfinite(np.column_stack([t, gyro, accel, force])).all(axis=1)
    stamps = _filled(fields, "t", t[:, None])[:, 0]
    taken_s, bursts = _taken(stamps)
    positions = _filled(fields, "joint_pos", positions)
    force = _filled(fields, "foot forces", force)
    if float(np.median(force.sum(axis=1))) < 0.0:
        force = -force  # as the foot presses on the floor
    return LeggedLog(
        t=stamps,
        taken_s=taken_s,
        joints={name: positions[:, k] for k, name in enumerate(names)},
        gyro_rad_s=_filled(fields, "imu_gyro", gyro),
        accel_m_s2=_filled(fields, "imu_acc", accel),
        force_n=force,
        blind=blind,
        X_WB=fields.first_pose(),
        filled=int(unknown.sum()),
        bursts=bursts,
    )


class _Fields:
    """The arrays of one file, and complaints that name it."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.archive = Archive(path, limit=MOST_BYTES, cure=CURE)
        self.count = 0

    def wrong(self, name: str, what: str) -> ConfigError:
        return ConfigError([Problem(f"{name} {what}", str(self.path), suggestion=CURE)])

    def need(self, name: str) -> str:
        """A field that has to be there."""
        if name not in self.archive.names:
            there = ", ".join(sorted(self.archive.names)[:20]) or "nothing"
            raise self.wrong(f"the field {name!r}", f"is missing; there are {there}")
        return name

    def rows(self, name: str, width: int = 0, *, largest: float = 0.0) -> Array:
        """A field of numbers, a row a sample; 0: not of columns. What is not finite is a gap."""
        shape = (self.count or None, width) if width else (self.count or None,)
        values = self.archive.numbers(self.need(name), shape=shape, most_rows=MOST_SAMPLES)
        most = largest or LARGEST[name]
        if (np.isfinite(values) & (np.abs(values) > most)).any():
            raise self.wrong(name, f"holds numbers beyond {most:g}, which nothing measures")
        return values

    def names(self, name: str) -> list[str]:
        """A field of names, each one once."""
        if math.prod(self.archive.claim(self.need(name)).shape) > MOST_JOINTS:
            raise self.wrong(name, f"holds more than {MOST_JOINTS} names")
        values = self.archive.array(name)
        if values.dtype.kind not in "SU" or values.ndim != 1:
            raise self.wrong(name, "is no list of names")
        listed = cast("list[str | bytes]", values.tolist())
        names = [n if isinstance(n, str) else n.decode("utf-8", "replace") for n in listed]
        if len(set(names)) < len(names):
            raise self.wrong(name, "holds a name twice")
        return names

    def force(self, keys: tuple[str, ...]) -> Array:
        """The vertical force under a foot, by the first of these names that is there."""
        name = next((key for key in keys if key in self.archive.names), keys[0])
        shape = self.archive.claim(self.need(name)).shape
        if len(shape) == 2 and shape[1] in (3, 6):
            return self.rows(name, shape[1], largest=LARGEST_FORCE_N)[:, 2]
        return self.rows(name, largest=LARGEST_FORCE_N)

    def first_pose(self) -> SE3 | None:
        """Where the base began, if the file says."""
        pairs = (("gt_base_pos0", "gt_base_rpy0"), ("gt_base_pos", "gt_base_rpy"))
        for place, angles in pairs:
            if {place, angles} <= self.archive.names:
                p, rpy = self.first(place, LARGEST_M), self.first(angles, LARGEST_RAD)
                if np.isfinite(p).all() and np.isfinite(rpy).all():
                    roll, pitch, yaw = rpy.tolist()
                    x, y, z = p.tolist()
                    return SE3.from_rpy(roll, pitch, yaw, (x, y, z))
        return None

    def first(self, name: str, largest: float) -> Array:
        """Three numbers, or the first of rows of three, shape (3,)."""
        rows = len(self.archive.claim(name).shape) == 2
        values = self.archive.numbers(name, shape=(None, 3) if rows else (3,)).reshape(-1, 3)
        if not len(values) or (np.isfinite(values[0]) & (np.abs(values[0]) > largest)).any():
            raise self.wrong(name, f"does not begin with three numbers up to {largest:g}")
        return values[0]


def _filled(fields: _Fields, name: str, values: Array) -> Array:
    """What is no number, between its neighbours in the same column."""
    known = np.isfinite(values)
    if known.all():
        return values
    if not known.any(axis=0).all():
        raise fields.wrong(name, "holds a column without any number")
    values, rows = values.copy(), np.arange(len(values))
    for k in range(values.shape[1]):
        good = known[:, k]
        values[~good, k] = np.interp(rows[~good], rows[good], values[good, k])
    return values


def _taken(t: Array) -> tuple[Array, bool]:
    """When samples were taken that are stamped as they arrive, and whether they came in bursts.

    A sensor samples steadily; a queue on the way lets its samples wait, then come all at once. A
    sample is never stamped early, so the lower envelope of the stamps less a steady clock tells
    when that clock ticked, and a step that stays tells of samples that were lost.
    """
    steps = np.diff(t)
    period_s = float(np.median(steps))
    bursts = period_s > 0.0 and bool(np.mean(steps < BURST_OF_PERIOD * period_s) > BURST_SHARE)
    if not bursts:
        return np.maximum.accumulate(t), False
    index = np.arange(len(t), dtype=np.float64)
    period_s = float((t[-1] - t[0]) / index[-1])
    if period_s <= 0.0:  # the clock went back: no stamps of any clock that ticks
        return np.maximum.accumulate(t), True
    late = t - period_s * index
    window = max(1, round(min(BACKLOG_S / period_s, len(t))))
    envelope = np.maximum(_least_ahead(late, window), _least_ahead(late[::-1], window)[::-1])
    return np.maximum.accumulate(period_s * index + envelope), True


def _least_ahead(values: Array, window: int) -> Array:
    """The least of each value and the `window` after it."""
    least, width, size = np.concatenate([values, np.full(window, np.inf)]), 1, window + 1
    while 2 * width <= size:  # the least of twice as many, from two that touch
        least, width = np.minimum(least[:-width], least[width:]), 2 * width
    return np.minimum(least[: len(values)], least[size - width :])
