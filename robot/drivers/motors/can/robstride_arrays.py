"""The frames of `robstride` for all motors of a cycle at once: same bits, few operations."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from robot.drivers.motors.can.fields import limits, refuse_misfits
from robot.drivers.motors.can.frames import MAX_DATA
from robot.drivers.motors.can.packed import EXTENDED, Bytes
from robot.drivers.motors.can.robstride import COMMAND, STATES, STEPS
from robot.drivers.motors.can.values import Feedbacks, Ranges
from robot.se3 import Array

_TORQUE = 4
"""The last of the five numbers stands in the identifier."""
FULL = 8


class ManyRobStrides:
    """The codec of several motors, each with ranges of its own (`ManyMotors`)."""

    width = MAX_DATA

    def __init__(
        self, ids: Sequence[int], ranges: Sequence[Ranges], _watchdog_s: float = 0.0
    ) -> None:
        """Take who they are, and what their frames stand for."""
        self._to = np.array([EXTENDED | COMMAND << 24 | number for number in ids], np.uint32)
        self._low, self._high = limits(ranges)
        self._span: Array = self._high - self._low
        self._sides: Array = self._high[[0, 1, _TORQUE]]

    def commands(self, targets: Array) -> tuple[npt.NDArray[np.uint32], Bytes, Array]:
        """Everybody's frame and what it really says; see `ManyMotors`."""
        low, span = self._low, self._span
        refuse_misfits(targets, low, self._high)
        steps = np.floor((targets - low) * STEPS / span + 0.5)
        whole = steps.astype(np.uint32)
        data = np.ascontiguousarray(whole[:_TORQUE].T).astype(">u2").view(np.uint8)
        return self._to | whole[_TORQUE] << 8, data, steps * span / STEPS + low

    def is_feedback(self, data: Bytes, lengths: Bytes) -> npt.NDArray[np.bool_]:  # noqa: ARG002
        """Whether so much data can be a reply, shape (k,)."""
        return lengths == FULL

    def feedback(
        self,
        ids: npt.NDArray[np.uint32],
        data: Bytes,
        lengths: Bytes,  # noqa: ARG002 - all are whole
        which: npt.NDArray[np.intp],
    ) -> Feedbacks:
        """What replies say; see `ManyMotors`."""
        words = np.ascontiguousarray(data).view(">u2").astype(np.float64).T
        sides = self._sides[:, which]
        motion = words[:3] * (2.0 * sides) / STEPS - sides
        return Feedbacks(motion, STATES[ids >> 16 & 0xFF], 0.1 * words[3])
