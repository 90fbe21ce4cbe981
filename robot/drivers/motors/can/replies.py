"""Whose a reply is, and which are feedback: a late answer about a register is none."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
import numpy.typing as npt

from robot.drivers.motors.can.frames import Frame
from robot.drivers.motors.can.joint_map import JointMotor
from robot.drivers.motors.can.packed import Bytes
from robot.drivers.motors.can.ports import Heard
from robot.drivers.motors.can.values import NOBODY, Feedback, Ranges

_REGISTER_AT, _READ, _WRITE = 2, 0x33, 0x55
"""Of Damiao's: other families tell both apart by identifiers."""


def senders(joints: Mapping[str, JointMotor]) -> Callable[[Heard], str]:
    """A function that says which of these joints' motors a frame is from; "": none of them."""
    short = {(one.bus, one.answers_as): name for name, one in joints.items() if not one.is_wide}
    short |= {
        (one.bus, number): name
        for name, one in joints.items()
        for number in one.family.short_replies(one.id)
    }
    wide = {(one.bus, one.answers_as): name for name, one in joints.items() if one.is_wide}
    read = {one.family.senders for one in joints.values()}

    def sender(heard: Heard) -> str:
        frame = heard.frame
        if frame is None:
            return ""
        if not frame.is_extended:
            return short.get((heard.bus, frame.id), "")
        for whose in read:
            number = NOBODY if whose is None else int(whose(np.array([frame.id]))[0])
            if number != NOBODY:
                return wide.get((heard.bus, number), "")
        return ""

    return sender


def feedback_of(joint: JointMotor, frame: Frame, ranges: Ranges) -> Feedback | None:
    """What a frame of a joint's motor says; None if it is no feedback."""
    return None if is_about_register(joint, frame) else joint.family.feedback(frame, ranges)


def is_about_register(joint: JointMotor, frame: Frame) -> bool:
    """Whether it answers a question about a register, be it an old one or another program's.

    Feedback of a disabled Damiao looks the same at two of its 65536 positions, which lie at the
    lower end of its range: there it is not heard.
    """
    asking = joint.family.asking
    reply = None if asking is None else asking.reply(frame)
    return reply is not None and reply.motor_id == joint.id


def may_be_about_register(data: Bytes) -> npt.NDArray[np.bool_]:
    """Which of many replies, shape (n, 8), are worth to be looked at by `is_about_register`."""
    what = data[:, _REGISTER_AT]
    return (what == _READ) | (what == _WRITE)
