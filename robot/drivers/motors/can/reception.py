"""What motors told last: who is late, what is not believed, what it says at the joints."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from robot.drivers.motors.can.coding import Coding
from robot.drivers.motors.can.joint_map import JointMap
from robot.drivers.motors.can.packed import (
    BUS_OFF,
    ERROR,
    EXTENDED,
    FD_RECORD,
    FD_SIZE,
    RECORD,
    REMOTE,
    SHORT_IDS,
    Records,
    size_on,
    unpacked,
    wide,
)
from robot.drivers.motors.can.replies import is_about_register, may_be_about_register
from robot.drivers.motors.can.values import DISABLED, NOBODY, Feedback, Ranges
from robot.drivers.motors.heard import Heard

MOST_OWED = 10
"""Replies that a motor may still give to what it was told before, one a period."""


class Reception(Heard):
    """What motors on CAN told, beside what all tell (`Heard`); arrays of shape (n,).

    Attributes:
        doubles: periods in a row with more replies than were still owed: late ones are.
        status: status codes.
        ignored: frames that were nobody's, or no feedback.
        most_replies: that any motor gave in the last period.
    """

    def __init__(self, joints: JointMap, ranges: list[Ranges], coding: Coding) -> None:
        """Nothing was heard yet."""
        super().__init__(joints, np.array([one.velocity_rad_s for one in ranges]))
        count = len(joints.joints)
        self.status: npt.NDArray[np.intp] = np.full(count, DISABLED, np.intp)
        self.doubles: npt.NDArray[np.intp] = np.zeros(count, np.intp)
        self.ignored = self.most_replies = 0
        self._owed: npt.NDArray[np.intp] = np.zeros(count, np.intp)
        self._replies: npt.NDArray[np.intp] = np.zeros(count, np.intp)
        self._coding = coding
        self._motors = list(joints.joints.values())
        self._sizes = {bus: size_on(is_fd=one.is_fd) for bus, one in joints.buses.items()}
        self._first_key = {bus: number * SHORT_IDS for number, bus in enumerate(joints.buses)}
        wide = {one.family.senders for one in self._motors} - {None}
        self._wide = [whose for whose in wide if whose is not None]
        block = SHORT_IDS * len(joints.buses)  # that of short identifiers; behind it one a family
        self._block = block
        self._by_key = np.full(block * (1 + len(self._wide)) + 1, NOBODY, np.intp)
        for index, one in enumerate(self._motors):
            whose = one.family.senders
            number = 0 if whose is None else block * (1 + self._wide.index(whose))
            self._by_key[number + self._first_key[one.bus] + one.answers_as] = index
            for short in one.family.short_replies(one.id):
                self._by_key[self._first_key[one.bus] + short] = index

    def found(self, told: Sequence[Feedback], now_s: float) -> None:
        """What every motor told as it was enabled, outside of a period: it is there."""
        self._motion[:] = np.array([(one.q_rad, one.qd_rad_s, one.tau_nm) for one in told]).T
        self.temperature_c[:] = [one.winding_c for one in told]
        self.status[:] = [one.status for one in told]
        self.heard_s[:] = now_s
        self.misses[:] = 0

    def take(self, came: Sequence[tuple[str, bytes]], now_s: float) -> Sequence[str]:
        """Packed frames that came in, by bus; returns the buses that went off.

        What is no feedback of ours is ignored and counted. Of several replies of one motor each is
        looked at, in their order.
        """
        frames, counts = self._together(came)
        keys = frames["id"].astype(np.intp)
        first = np.repeat(np.array([self._first_key[bus] for bus, _ in came]), counts)
        is_short = keys < SHORT_IDS
        at = np.where(is_short, keys + first, NOBODY)
        off: Sequence[str] = ()
        if not is_short.all():
            self._find_wide(at, keys, first)
            off = self._off(keys, first)
        which = self._by_key[at]
        ours = which != NOBODY
        ours[ours] = self._coding.is_feedback(frames[ours], which[ours])
        for index in np.flatnonzero(ours & may_be_about_register(frames["data"])).tolist():
            joint, frame = self._motors[int(which[index])], unpacked(frames[index].tobytes())
            ours[index] = frame is not None and not is_about_register(joint, frame)
        if not ours.all():
            self.ignored += int(np.count_nonzero(~ours))
            which, frames = which[ours], frames[ours]
        replies = np.bincount(which, minlength=len(self._replies))
        self._replies += replies
        if int(replies.max()) <= 1:
            self._believe(which, frames, now_s)
            return off
        order = np.argsort(which, kind="stable")
        turn = np.empty(len(which), np.intp)  # its first reply, its second, and so on
        turn[order] = np.arange(len(which)) - np.repeat(np.cumsum(replies) - replies, replies)
        for number in range(int(replies.max())):
            now = turn == number
            self._believe(which[now], frames[now], now_s)
        return off

    def _together(self, came: Sequence[tuple[str, bytes]]) -> tuple[Records, list[int]]:
        """All frames that came in one array, and how many are of each."""
        counts = [len(data) // self._sizes[bus] for bus, data in came]
        if FD_SIZE not in self._sizes.values():
            return np.frombuffer(b"".join(data for _, data in came), RECORD), counts
        parts = [data if self._sizes[bus] == FD_SIZE else wide(data) for bus, data in came]
        return np.frombuffer(b"".join(parts), FD_RECORD), counts

    def _find_wide(
        self,
        at: npt.NDArray[np.intp],
        keys: npt.NDArray[np.intp],
        first: npt.NDArray[np.intp],
    ) -> None:
        """Say where in `_by_key` frames with identifiers of 29 bits stand."""
        is_wide = (keys & EXTENDED != 0) & (keys & (ERROR | REMOTE) == 0)
        for number, whose in enumerate(self._wide, start=1):
            sender = whose(keys & ~EXTENDED)
            mine = is_wide & (sender != NOBODY)
            at[mine] = self._block * number + first[mine] + sender[mine]

    def _off(self, keys: npt.NDArray[np.intp], first: npt.NDArray[np.intp]) -> Sequence[str]:
        """Buses whose error frames say that their controller went off."""
        told = first[(keys & ERROR != 0) & (keys & BUS_OFF != 0)].tolist()
        return [bus for bus, key in self._first_key.items() if key in told]

    def _believe(self, which: npt.NDArray[np.intp], frames: Records, now_s: float) -> None:
        """Take what different motors said, but for positions that nobody can have come to."""
        motion, status, winding_c = self._coding.feedback(frames, which)
        calm = self._calm(which, motion[0], now_s)
        if calm is not None:
            which, motion, status = which[calm], motion[:, calm], status[calm]
            winding_c = winding_c[calm]
        self._motion[:, which] = motion
        self.temperature_c[which] = winding_c
        self.status[which] = status
        self.heard_s[which] = now_s

    def end_period(self) -> None:
        """Count who did not answer, and bridge the first reply that anyone did not give."""
        replies = self._replies
        self.most_replies = int(replies.max())
        if self.most_replies == int(replies.min()) == 1 and not self.misses.any():
            self.doubles[:] = 0
        else:
            silent = replies == 0
            self.misses = np.where(silent, self.misses + 1, 0)
            self.lost += int(np.count_nonzero(silent))
            self._bridge(self.misses == 1)
            owed = np.minimum(self._owed + 1, MOST_OWED)
            self.doubles = np.where(replies > owed, self.doubles + 1, 0)
            self._owed = np.maximum(owed - replies, 0)
        self._replies = np.zeros_like(replies)
