"""Whether the IMU still feels: one that is silent, stands still or tells no numbers is not obeyed.

A robot that goes on by an IMU that died falls within two seconds, standing or walking, as it leans
and does not know it. So what it tells is looked at in every period; once it cannot be believed the
legs alone tell how the base turns (`BaseStateEstimator.coast`), and the robot is lowered.
"""

from __future__ import annotations

import math

import numpy as np

from robot.drivers.body_sample import BodySample, ImuReading
from robot.messages import IMU, MotorAlarm

SILENT_S, FROZEN_S = 0.010, 0.050
"""A reading is repeated for so long before it counts as silence, and the same numbers under new
stamps as frozen: the noise of any real one changes some of six numbers in every sample."""
NO_NUMBERS = 3
"""In a row: one or two are bridged by the last one that was finite."""
CURE = "look at its cable and its power, and start the robot anew"
SLACK_S = 1e-6
"""Sums of periods are not exact."""


class ImuWatch:
    """Looks at the readings of one IMU, period by period.

    Attributes:
        alarms: what is wrong with it, for whoever lowers the robot; latched.
    """

    def __init__(self) -> None:
        """Nothing was felt yet."""
        self.alarms: tuple[MotorAlarm, ...] = ()
        self._last: ImuReading | None = None
        self._stamp_s = self._new_s = self._changed_s = -math.inf
        self._joints = b""
        self._no_numbers = 0

    @property
    def is_blind(self) -> bool:
        """Whether the IMU is not to be believed any more."""
        return bool(self.alarms)

    def take(self, sample: BodySample) -> ImuReading:
        """The reading to go by in this period: the newest one that is finite.

        Time is that of the motors, so that the IMU may have a clock of its own.
        """
        now_s, imu, last = sample.motors.stamp_s, sample.imu, self._last
        if last is None:
            self._last, self._stamp_s = imu, imu.stamp_s
            self._new_s = self._changed_s = now_s
            return imu
        if self.alarms:
            return last
        is_new = imu.stamp_s != self._stamp_s
        if is_new:
            self._stamp_s, self._new_s = imu.stamp_s, now_s
            if not _is_finite(imu):
                self._no_numbers += 1
            else:
                self._no_numbers = 0
                self._compare(imu, last, sample, now_s)
                self._last = last = imu
        self._judge(now_s)
        return last

    def _compare(self, imu: ImuReading, last: ImuReading, sample: BodySample, now_s: float) -> None:
        """Note when its numbers changed; where not even an encoder's do, the whole world is still.

        A simulation without noise comes to rest to the last bit, and its IMU is not broken.
        """
        same = np.array_equal(imu.gyro_rad_s, last.gyro_rad_s) and np.array_equal(
            imu.accel_m_s2, last.accel_m_s2
        )
        joints = sample.motors.qd.tobytes() if same else b""
        if not same or joints == self._joints:
            self._changed_s = now_s
        self._joints = joints

    def _judge(self, now_s: float) -> None:
        silent_s, same_s = now_s - self._new_s, now_s - self._changed_s
        if self._no_numbers >= NO_NUMBERS:
            self._sound("imu_no_numbers", f"{self._no_numbers} readings in a row were no numbers")
        elif silent_s > SILENT_S + SLACK_S:
            self._sound("imu_silent", f"it is silent for {1000.0 * silent_s:.0f} ms")
        elif same_s > FROZEN_S + SLACK_S and silent_s <= SLACK_S:
            self._sound("imu_frozen", f"it tells the same for {1000.0 * same_s:.0f} ms")

    def _sound(self, code: str, cause: str) -> None:
        self.alarms = (MotorAlarm(code, IMU, "SIT", cause, CURE),)


def _is_finite(imu: ImuReading) -> bool:
    return math.isfinite(float(imu.gyro_rad_s.sum() + imu.accel_m_s2.sum()))
