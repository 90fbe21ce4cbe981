"""What servos told last: who is late, what is not believed, what it says at the joints."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from robot.drivers.motors.dynamixel import load
from robot.drivers.motors.dynamixel.control_table import HARDWARE_ERROR
from robot.drivers.motors.dynamixel.interview import MIDDLE
from robot.drivers.motors.dynamixel.joint_map import ServoMap
from robot.drivers.motors.dynamixel.models import RAD_A_PULSE, RAD_S_A_STEP
from robot.drivers.motors.dynamixel.packets import Status
from robot.drivers.motors.heard import Heard
from robot.se3 import Array

_SHORT = np.dtype([("current", "<i2"), ("velocity", "<i4"), ("position", "<i4")])
_LONG = np.dtype([*_SHORT.descr, ("trajectories", "V8"), ("decivolts", "<u2"), ("celsius", "u1")])


class Reception(Heard):
    """What servos told, beside what all motors tell (`Heard`); arrays of shape (n,).

    A miss is a period in which a servo was asked and did not answer.

    Attributes:
        volts: as told.
        alerts: whether it has a hardware error to tell.
        errors: bits of its hardware error, as far as it was asked.
        ignored: answers that were nobody's, or nothing of ours.
    """

    def __init__(self, joints: ServoMap) -> None:
        """Nothing was heard yet."""
        count = len(joints.joints)
        servos = list(joints.joints.values())
        super().__init__(joints, np.array([one.sold.velocity_rad_s for one in servos]))
        self.volts: Array = np.full(count, np.nan)
        self.alerts: npt.NDArray[np.bool_] = np.zeros(count, np.bool_)
        self.errors: npt.NDArray[np.intp] = np.zeros(count, np.intp)
        self.ignored = 0
        self._came: npt.NDArray[np.bool_] = np.zeros(count, np.bool_)
        self._step_nm: Array = np.array([one.sold.nm_a_step for one in servos])
        self._index = {
            port: {one.id: index for index, one in enumerate(servos) if one.port == port}
            for port in joints.ports
        }

    def take(self, port: str, heard: Sequence[Status], now_s: float) -> None:
        """Answers of a port's servos."""
        names = self._index[port]
        short: list[tuple[int, bytes]] = []
        for status in heard:
            index = names.get(status.id)
            size = len(status.data)
            if index is None or status.error or size not in (1, load.SHORT, load.LONG):
                self.ignored += 1
                continue
            self.alerts[index] = status.is_alert
            if size == HARDWARE_ERROR.size:
                self.errors[index] = status.data[0]
                continue
            if size == load.LONG:
                told = np.frombuffer(status.data, _LONG)[0]
                self.temperature_c[index] = told["celsius"]
                self.volts[index] = 0.1 * told["decivolts"]
            short.append((index, status.data[: load.SHORT]))
        if short:
            self._believe(short, now_s)

    def _believe(self, short: Sequence[tuple[int, bytes]], now_s: float) -> None:
        """Take what servos said, but for positions that nobody can have come to."""
        which = np.array([index for index, _ in short], np.intp)
        told = np.frombuffer(b"".join(data for _, data in short), _SHORT)
        self._came[which] = True
        q = (told["position"] - MIDDLE) * RAD_A_PULSE
        calm = self._calm(which, q, now_s)
        if calm is not None:
            which, told, q = which[calm], told[calm], q[calm]
        self.q[which], self.qd[which] = q, told["velocity"] * RAD_S_A_STEP
        self.tau[which] = told["current"] * self._step_nm[which]
        self.heard_s[which] = now_s

    def end_period(self, asked: npt.NDArray[np.bool_]) -> None:
        """Count who of those that were asked did not answer; bridge the first time that it is."""
        silent = asked & ~self._came
        if silent.any():
            self.lost += int(np.count_nonzero(silent))
        self.misses = np.where(silent, self.misses + 1, np.where(self._came, 0, self.misses))
        self._bridge(~self._came & (self.misses <= 1))
        self._came[:] = False
