"""Which replies of a motor are feedback: a late answer about a register is none."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from robot.drivers.motors.can.joint_map import JointMotor
from robot.drivers.motors.can.mit11 import Feedback, Ranges
from robot.drivers.motors.can.packed import Bytes

_REGISTER_AT, _READ, _WRITE = 2, 0x33, 0x55


def feedback_of(joint: JointMotor, data: bytes, ranges: Ranges) -> Feedback | None:
    """What a frame under the identifier of a joint's replies says; None if it is no feedback."""
    return None if is_about_register(joint, data) else joint.family.feedback(data, ranges)


def is_about_register(joint: JointMotor, data: bytes) -> bool:
    """Whether it answers a question about a register, be it an old one or another program's.

    Feedback of a disabled motor looks the same at two of its 65536 positions, which lie at the
    lower end of its range: there it is not heard.
    """
    asking = joint.family.asking
    reply = None if asking is None else asking.reply(data)
    return reply is not None and reply.motor_id == joint.id


def may_be_about_register(data: Bytes) -> npt.NDArray[np.bool_]:
    """Which of many replies, shape (n, 8), are worth to be looked at by `is_about_register`."""
    what = data[:, _REGISTER_AT]
    return (what == _READ) | (what == _WRITE)
