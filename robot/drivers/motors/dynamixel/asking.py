"""What goes to each port in a period: currents for its servos, and one question for all of them."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import numpy.typing as npt

from robot.drivers.motors.dynamixel import instructions, load
from robot.drivers.motors.dynamixel.control_table import (
    GOAL_CURRENT,
    HARDWARE_ERROR,
    PRESENT_CURRENT,
)
from robot.drivers.motors.dynamixel.joint_map import ServoMap
from robot.drivers.motors.dynamixel.packets import Receiver
from robot.drivers.motors.dynamixel.reception import Reception
from robot.se3 import Array

HEALTH_EVERY = 25
"""Periods: volts and heat are asked for so seldom, one port after the other."""
MOST_KEPT = 64
"""Questions."""
ERRORS_EVERY = 50
"""Periods: while a servo is alert, its error is asked for again."""


class Asking:
    """Of all ports of a map.

    What servos do behind one that is missing is not said by their maker, and may be nothing. So the
    first that did not answer is asked last from then on.

    Attributes:
        asked: whose state was asked for in the last period, shape (n,).
    """

    def __init__(self, joints: ServoMap) -> None:
        """Nothing was asked yet."""
        servos = list(joints.joints.values())
        self.asked: npt.NDArray[np.bool_] = np.zeros(len(servos), np.bool_)
        self._members = {
            port: np.array([i for i, one in enumerate(servos) if one.port == port], np.intp)
            for port in joints.ports
        }
        self._ids = np.array([one.id for one in servos])
        self._questions: dict[tuple[str, bytes, int], bytes] = {}
        self._periods = 0
        self._errors_asked = dict.fromkeys(joints.ports, -ERRORS_EVERY)

    def packets(
        self, steps: Array | None, heard: Reception, receivers: Mapping[str, Receiver]
    ) -> dict[str, bytes]:
        """What to send now, by port.

        Args:
            steps: of current, shape (n,); None: nothing is commanded.
            heard: what servos told so far.
            receivers: of the ports; they are told what to expect.
        """
        self._periods += 1
        self.asked[:] = False
        packets: dict[str, bytes] = {}
        for number, (port, members) in enumerate(self._members.items()):
            if not len(members):
                continue
            currents = b"" if steps is None else self._currents(members, steps)
            packets[port] = currents + self._question(number, port, members, heard, receivers[port])
        return packets

    def _currents(self, members: npt.NDArray[np.intp], steps: Array) -> bytes:
        values = steps[members].astype("<i2").tobytes()
        ids = self._ids[members].tolist()
        return instructions.sync_write(
            GOAL_CURRENT.address,
            {one: values[2 * i : 2 * i + 2] for i, one in enumerate(ids)},
        )

    def _question(
        self, number: int, port: str, members: npt.NDArray[np.intp], heard: Reception,
        receiver: Receiver,
    ) -> bytes:  # fmt: skip
        alert = members[heard.alerts[members]]
        if len(alert) and self._periods - self._errors_asked[port] >= ERRORS_EVERY:
            self._errors_asked[port] = self._periods
            receiver.expect(None)
            ids = self._ids[alert].tolist()
            return instructions.sync_read(ids, HARDWARE_ERROR.address, HARDWARE_ERROR.size)
        is_long = (self._periods + number) % HEALTH_EVERY == 0 or bool(
            np.isnan(heard.temperature_c[members]).any()
        )
        size = load.LONG if is_long else load.SHORT
        order = self._order(port, heard)
        self.asked[members] = True
        receiver.expect(size)
        key = port, order.tobytes(), size
        if len(self._questions) > MOST_KEPT:
            self._questions.clear()
        if (question := self._questions.get(key)) is None:
            question = self._questions[key] = instructions.sync_read(
                self._ids[order].tolist(), PRESENT_CURRENT.address, size, is_fast=True
            )
        return question

    def _order(self, port: str, heard: Reception) -> npt.NDArray[np.intp]:
        order = self._members[port]
        missing = np.flatnonzero(heard.misses[order])
        if len(missing) and missing[0] < len(order) - 1:
            first = order[missing[0]]
            order = self._members[port] = np.append(order[order != first], first)
        return order
