"""What motors told last: who is late, what is not believed, what it says at the joints."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from robot.drivers.motors.can.frames import Frame
from robot.drivers.motors.can.gearing import Gearing
from robot.drivers.motors.can.joint_map import JointMap
from robot.drivers.motors.can.mit11 import DISABLED, Feedback, Ranges
from robot.se3 import Array

JUMPS_BELIEVED = 3
"""So many in a row that agree with each other are where the joint is."""
JUMP_SLACK_RAD = 0.05
FASTER = 1.5
"""Than its range, at most, a motor may turn from one reply to the next."""


class Reception:
    """The newest feedback of all motors of a map, at their shafts; arrays of shape (n,).

    Attributes:
        q, qd, tau, temperature_c: as told, a lost reply bridged for one period.
        heard_s: when each told it.
        misses: periods in a row without a reply.
        jumps: replies in a row that were too far from the one before.
        doubles: periods in a row with more than one reply.
        status: status codes.
        lost, ignored: replies that did not come; frames that were nobody's, or no feedback.
        most_replies: that any motor gave in the last period.
    """

    def __init__(self, joints: JointMap, ranges: list[Ranges]) -> None:
        """Nothing was heard yet."""
        count = len(joints.joints)
        self.q: Array = np.zeros(count)
        self.qd: Array = np.zeros(count)
        self.tau: Array = np.zeros(count)
        self.temperature_c: Array = np.full(count, np.nan)
        self.heard_s: Array = np.full(count, -np.inf)
        self.misses: npt.NDArray[np.int_] = np.zeros(count, np.int_)
        self.status = [DISABLED] * count
        self.jumps = [0] * count
        self.doubles = [0] * count
        self.lost = self.ignored = self.most_replies = 0
        self._replies = [0] * count
        self._ranges = ranges
        self._period_s = joints.period_s
        self._motors = list(joints.joints.values())
        self._decode = [one.family.feedback for one in self._motors]
        self._register_of = [
            None if one.family.asking is None else one.family.asking.reply for one in self._motors
        ]
        self._by_reply = {(one.bus, one.answers_as): i for i, one in enumerate(self._motors)}
        self._fastest = [FASTER * one.velocity_rad_s for one in ranges]

    def take(self, bus: str, frame: Frame, now_s: float) -> None:
        """A frame that came in; what is no feedback of ours is ignored and counted."""
        index = self._by_reply.get((bus, frame.id))
        found = None if index is None else self._decode[index](frame.data, self._ranges[index])
        if index is None or found is None or self._is_register(index, frame):
            self.ignored += 1
            return
        self._replies[index] += 1
        self._believe(index, found, now_s)

    def _is_register(self, index: int, frame: Frame) -> bool:
        """Whether it answers another program that asked for a register."""
        if frame.data[2] not in (0x33, 0x55):
            return False
        read = self._register_of[index]
        reply = None if read is None else read(frame.data)
        return reply is not None and reply.motor_id == self._motors[index].id

    def _believe(self, index: int, found: Feedback, now_s: float) -> None:
        since_s = now_s - self.heard_s[index]
        allowed = JUMP_SLACK_RAD + self._fastest[index] * since_s
        if abs(found.q_rad - self.q[index]) > allowed and self.jumps[index] < JUMPS_BELIEVED:
            self.jumps[index] += 1
            return
        self.jumps[index] = 0
        self.q[index], self.qd[index], self.tau[index] = found[2:5]
        self.temperature_c[index] = found.winding_c
        self.status[index] = found.status
        self.heard_s[index] = now_s

    def end_period(self) -> None:
        """Count who did not answer, and bridge the first reply that anyone did not give."""
        replies = self._replies
        self.most_replies = max(replies)
        if all(count == 1 for count in replies) and not self.misses.any():
            self.doubles = [0] * len(replies)
        else:
            silent = np.array(replies) == 0
            self.misses = np.where(silent, self.misses + 1, 0)
            self.lost += int(np.count_nonzero(silent))
            self.q += np.where(self.misses == 1, self.qd * self._period_s, 0.0)
            self.doubles = [
                before + 1 if count > 1 else 0
                for before, count in zip(self.doubles, replies, strict=True)
            ]
        self._replies = [0] * len(replies)

    def at_joints(self, gearing: Gearing) -> tuple[Array, Array, Array]:
        """Angles, speeds and torques of the joints; arrays of their own."""
        return gearing.joint_q(self.q), gearing.joint_qd(self.qd), gearing.joint_tau(self.tau)
