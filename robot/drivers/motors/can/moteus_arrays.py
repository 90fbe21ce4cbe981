"""The frames of `moteus` for all motors of a cycle at once: same bits, few operations."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from robot.drivers.motors.can import moteus
from robot.drivers.motors.can.fields import refuse_misfits
from robot.drivers.motors.can.moteus import BEGINS, COMMAND_BYTES, REPLY_BYTES
from robot.drivers.motors.can.packed import EXTENDED, Bytes
from robot.drivers.motors.can.values import Feedbacks, Ranges
from robot.se3 import Array

_ORDER = [0, 1, 4, 2, 3]
"""In a frame torque stands before the gains."""
_AT = len(BEGINS)
_WORDS = slice(_AT, _AT + 10)
_MODE, _MOTION, _MOTOR_C, _FAULT = 3, slice(5, 11), 14, 19
"""Where in a reply they begin."""


class ManyMoteus:
    """The codec of several motors, each with ranges of its own (`ManyMotors`)."""

    width = COMMAND_BYTES

    def __init__(
        self, ids: Sequence[int], ranges: Sequence[Ranges], watchdog_s: float = 0.0
    ) -> None:
        """Take who they are, how far numbers go, and for how long a command counts."""
        frames = [
            moteus.command(number, most, moteus.Target(0.0, 0.0, 0.0, 0.0, 0.0), watchdog_s)
            for number, most in zip(ids, ranges, strict=True)
        ]
        self._to = np.array([EXTENDED | frame.id for frame in frames], np.uint32)
        self._data = np.array([list(frame.data) for frame in frames], np.uint8)
        self._low, self._high = moteus.within(list(ranges))
        self._per: Array = np.array([moteus.steps_of(most) for most in ranges]).T

    def commands(self, targets: Array) -> tuple[npt.NDArray[np.uint32], Bytes, Array]:
        """Everybody's frame and what it really says; see `ManyMotors`."""
        refuse_misfits(targets, self._low, self._high)
        steps = np.floor(targets / self._per + 0.5)
        words = np.ascontiguousarray(steps[_ORDER].T).astype("<i2")
        self._data[:, _WORDS] = words.view(np.uint8)
        return self._to, self._data, steps * self._per

    def is_feedback(self, data: Bytes, lengths: Bytes) -> npt.NDArray[np.bool_]:
        """Whether they answer the query, and know their state, shape (k,)."""
        begins = np.array(list(moteus.TOLD), np.uint8)
        also = np.array(list(moteus.ALSO_TOLD), np.uint8)
        fits = (lengths == REPLY_BYTES) & (data[:, :3] == begins).all(1)
        fits &= (data[:, 11:14] == also).all(1)
        return fits & (_motion(data) != moteus.NONE).all(1)

    def feedback(
        self,
        ids: npt.NDArray[np.uint32],  # noqa: ARG002 - all that is told stands in the data
        data: Bytes,
        lengths: Bytes,  # noqa: ARG002 - all are whole
        which: npt.NDArray[np.intp],  # noqa: ARG002 - what steps stand for is everybody's
    ) -> Feedbacks:
        """What replies say; see `ManyMotors`."""
        per = [[moteus.STEP_Q_RAD], [moteus.STEP_QD_RAD_S], [moteus.STEP_NM]]
        modes = np.ascontiguousarray(data[:, _MODE : _MODE + 2]).view("<i2")[:, 0].astype(np.intp)
        motor_c = data[:, _MOTOR_C].view(np.int8).astype(np.float64)
        return Feedbacks(
            _motion(data).T * per,
            moteus.states(modes, data[:, _FAULT].astype(np.intp)),
            np.where(motor_c > 0.0, motor_c, np.nan),
        )


def _motion(data: Bytes) -> Array:
    """Position, velocity, torque as they stand in replies, shape (k, 3)."""
    return np.ascontiguousarray(data[:, _MOTION]).view("<i2").astype(np.float64)
