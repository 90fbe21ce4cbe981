"""The frames of `mit11` for all motors of a cycle at once: same bits, a few array operations.

Fields of a frame, in the order of rows here: position, velocity, kp, kd, torque.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from robot.drivers.motors.can.mit11 import AK_ERRORS, ENABLED, KD_MAX, KP_MAX, Ranges
from robot.drivers.motors.can.packed import Bytes
from robot.errors import DriverError
from robot.se3 import Array

FIELDS = ("position", "velocity", "kp", "kd", "torque")
_MOST: Array = np.array([[65535.0], [4095.0], [4095.0], [4095.0], [4095.0]])
_SHIFTS = np.array([[48], [36], [24], [12], [0]], np.uint64)
_REPLY_SHIFTS = np.array([[40], [28], [16]], np.uint64)
_REPLY_MASKS = np.array([[0xFFFF], [0xFFF], [0xFFF]], np.uint64)
_REPLY_MOST: Array = np.array([[65535.0], [4095.0], [4095.0]])
FULL, OLD_AK = 8, 6
"""Bytes of a reply; older firmware of an AK tells neither temperature nor errors."""


class Feedbacks(NamedTuple):
    """What several motors answered, at their shafts; arrays of shape (k,).

    Attributes:
        motion: positions, velocities, torques, shape (3, k).
        status: their status codes.
        winding_c: temperatures of their windings, NaN where they are not told.
    """

    motion: Array
    status: npt.NDArray[np.intp]
    winding_c: Array


class ManyMit11:
    """The codec of several motors, each with ranges of its own."""

    def __init__(
        self,
        ranges: Sequence[Ranges],
        *,
        tell: Callable[[Bytes, Bytes], tuple[npt.NDArray[np.intp], Array]],
        lengths: tuple[int, ...],
    ) -> None:
        """Take their ranges.

        Args:
            ranges: of each motor.
            tell: status and temperature out of replies, by the data and how much of it came.
            lengths: that their replies may have.
        """
        sides = np.array(ranges).reshape(-1, 3).T
        zero, count = np.zeros(len(ranges)), len(ranges)
        full = zero + 1.0
        self._low: Array = np.stack([-sides[0], -sides[1], zero, zero, -sides[2]])
        self._high: Array = np.stack([sides[0], sides[1], KP_MAX * full, KD_MAX * full, sides[2]])
        self._span: Array = self._high - self._low
        self._sides: Array = sides.reshape(3, count)
        self._tell, self._lengths = tell, lengths

    def commands(self, targets: Array) -> tuple[Bytes, Array]:
        """The data of everybody's frame, shape (n, 8), and what it really says, shape (5, n).

        Args:
            targets: shape (5, n), at the shafts.

        Raises:
            DriverError: if a value is not finite, or does not fit its range: with both.
        """
        low, span = self._low, self._span
        if not ((targets >= low) & (targets <= self._high)).all():  # NaN is not, either
            raise DriverError(self._misfit(targets))
        steps = np.floor((targets - low) * _MOST / span + 0.5)
        bits = np.bitwise_or.reduce(steps.astype(np.uint64) << _SHIFTS, axis=0)
        return bits.astype(">u8").view(np.uint8).reshape(-1, 8), steps * span / _MOST + low

    def _misfit(self, targets: Array) -> str:
        fits = (targets >= self._low) & (targets <= self._high)
        row, motor = (int(index) for index in np.argwhere(~fits)[0])
        low, high = self._low[row, motor], self._high[row, motor]
        return f"{FIELDS[row]} {targets[row, motor]:g} does not fit into {low:g} to {high:g}"

    def is_feedback(self, lengths: Bytes) -> npt.NDArray[np.bool_]:
        """Whether so much data can be a reply, shape (k,)."""
        fits = lengths == self._lengths[0]
        for length in self._lengths[1:]:
            fits |= lengths == length
        return fits

    def feedback(self, data: Bytes, lengths: Bytes, which: npt.NDArray[np.intp]) -> Feedbacks:
        """What replies say.

        Args:
            data: shape (k, 8), zeros where less came.
            lengths: how much of it came, shape (k,).
            which: whose each is, shape (k,).
        """
        bits = np.ascontiguousarray(data).view(">u8").reshape(-1).astype(np.uint64)
        steps = (bits >> _REPLY_SHIFTS & _REPLY_MASKS).astype(np.float64)
        sides = self._sides[:, which]
        return Feedbacks(steps * (2.0 * sides) / _REPLY_MOST - sides, *self._tell(data, lengths))


def damiao(ranges: Sequence[Ranges]) -> ManyMit11:
    """The codec of Damiao's motors."""
    return ManyMit11(ranges, tell=_told_by_damiao, lengths=(FULL,))


def ak(ranges: Sequence[Ranges]) -> ManyMit11:
    """The codec of T-Motor's AK series."""
    return ManyMit11(ranges, tell=_told_by_ak, lengths=(FULL, OLD_AK))


def _told_by_damiao(data: Bytes, _lengths: Bytes) -> tuple[npt.NDArray[np.intp], Array]:
    return (data[:, 0] >> 4).astype(np.intp), data[:, 7].astype(np.float64)


def _told_by_ak(data: Bytes, lengths: Bytes) -> tuple[npt.NDArray[np.intp], Array]:
    errors = np.where(lengths == FULL, data[:, 7], 0).astype(np.intp)
    celsius = np.where(lengths == FULL, data[:, 6], np.nan)
    return np.where(errors > 0, AK_ERRORS + errors, ENABLED), celsius
