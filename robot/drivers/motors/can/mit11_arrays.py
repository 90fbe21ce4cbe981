"""The frames of `mit11` for all motors of a cycle at once: same bits, a few array operations.

Fields of a frame, in the order of rows here: position, velocity, kp, kd, torque.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import numpy.typing as npt

from robot.drivers.motors.can.fields import limits, refuse_misfits
from robot.drivers.motors.can.frames import MAX_DATA
from robot.drivers.motors.can.mit11 import AK_ERRORS
from robot.drivers.motors.can.packed import Bytes
from robot.drivers.motors.can.values import ENABLED, Feedbacks, Ranges
from robot.se3 import Array

_MOST: Array = np.array([[65535.0], [4095.0], [4095.0], [4095.0], [4095.0]])
_SHIFTS = np.array([[48], [36], [24], [12], [0]], np.uint64)
_REPLY_SHIFTS = np.array([[40], [28], [16]], np.uint64)
_REPLY_MASKS = np.array([[0xFFFF], [0xFFF], [0xFFF]], np.uint64)
_REPLY_MOST: Array = np.array([[65535.0], [4095.0], [4095.0]])
FULL, OLD_AK = 8, 6
"""Bytes of a reply; older firmware of an AK tells neither temperature nor errors."""


class ManyMit11:
    """The codec of several motors, each with ranges of its own (`ManyMotors`)."""

    width = MAX_DATA

    def __init__(
        self,
        ids: Sequence[int],
        ranges: Sequence[Ranges],
        *,
        tell: Callable[[Bytes, Bytes], tuple[npt.NDArray[np.intp], Array]],
        lengths: tuple[int, ...],
    ) -> None:
        """Take their ranges.

        Args:
            ids: of each motor.
            ranges: of each motor.
            tell: status and temperature out of replies, by the data and how much of it came.
            lengths: that their replies may have.
        """
        self._ids = np.array(ids, np.uint32)
        self._low, self._high = limits(ranges)
        self._span: Array = self._high - self._low
        self._sides: Array = self._high[[0, 1, 4]]
        self._tell, self._lengths = tell, lengths

    def commands(self, targets: Array) -> tuple[npt.NDArray[np.uint32], Bytes, Array]:
        """Everybody's frame and what it really says; see `ManyMotors`."""
        low, span = self._low, self._span
        refuse_misfits(targets, low, self._high)
        steps = np.floor((targets - low) * _MOST / span + 0.5)
        bits = np.bitwise_or.reduce(steps.astype(np.uint64) << _SHIFTS, axis=0)
        data = bits.astype(">u8").view(np.uint8).reshape(-1, 8)
        return self._ids, data, steps * span / _MOST + low

    def is_feedback(self, data: Bytes, lengths: Bytes) -> npt.NDArray[np.bool_]:  # noqa: ARG002
        """Whether so much data can be a reply, shape (k,)."""
        fits = lengths == self._lengths[0]
        for length in self._lengths[1:]:
            fits |= lengths == length
        return fits

    def feedback(
        self,
        ids: npt.NDArray[np.uint32],  # noqa: ARG002 - all that is told stands in the data
        data: Bytes,
        lengths: Bytes,
        which: npt.NDArray[np.intp],
    ) -> Feedbacks:
        """What replies say; see `ManyMotors`."""
        bits = np.ascontiguousarray(data).view(">u8").reshape(-1).astype(np.uint64)
        steps = (bits >> _REPLY_SHIFTS & _REPLY_MASKS).astype(np.float64)
        sides = self._sides[:, which]
        return Feedbacks(steps * (2.0 * sides) / _REPLY_MOST - sides, *self._tell(data, lengths))


def damiao(ids: Sequence[int], ranges: Sequence[Ranges], _watchdog_s: float = 0.0) -> ManyMit11:
    """The codec of Damiao's motors."""
    return ManyMit11(ids, ranges, tell=_told_by_damiao, lengths=(FULL,))


def ak(ids: Sequence[int], ranges: Sequence[Ranges], _watchdog_s: float = 0.0) -> ManyMit11:
    """The codec of T-Motor's AK series."""
    return ManyMit11(ids, ranges, tell=_told_by_ak, lengths=(FULL, OLD_AK))


def _told_by_damiao(data: Bytes, _lengths: Bytes) -> tuple[npt.NDArray[np.intp], Array]:
    return (data[:, 0] >> 4).astype(np.intp), data[:, 7].astype(np.float64)


def _told_by_ak(data: Bytes, lengths: Bytes) -> tuple[npt.NDArray[np.intp], Array]:
    errors = np.where(lengths == FULL, data[:, 7], 0).astype(np.intp)
    celsius = np.where(lengths == FULL, data[:, 6], np.nan)
    return np.where(errors > 0, AK_ERRORS + errors, ENABLED), celsius
