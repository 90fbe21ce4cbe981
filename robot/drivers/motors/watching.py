"""What may be wrong with a motor of any family, as alarms; and which of a joint's have ended."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from robot.drivers.motors.alarms import Alarm, Alarms, Level
from robot.drivers.motors.jumps import JUMPS_BELIEVED
from robot.drivers.motors.limiter import WARM_K
from robot.drivers.motors.mounting import MountedJoints
from robot.drivers.motors.speed_check import SpeedCheck
from robot.se3 import Array

SILENT_PERIODS = 3
SILENT_S = 0.020


def unplugged(line: str, why: str, cure: str) -> Alarm:
    """The interface of a bus or port went away."""
    return Alarm("unplugged", line, Level.SIT, why, cure, is_latched=True)


class JointAlarms:
    """Of all joints of a map.

    Attributes:
        speeds: how reported speeds compare with reported positions.
        names: the joints.
    """

    def __init__(self, joints: MountedJoints, alarms: Alarms) -> None:
        """Sounds these alarms."""
        self.names = tuple(joints.joints)
        self._alarms = alarms
        self._hot_c: Array = np.array([one.over_temperature_c for one in joints.joints.values()])
        self._periods = max(SILENT_PERIODS + 1, round(SILENT_S / joints.period_s))
        self._troubled: set[str] = set()
        self.speeds = SpeedCheck(len(self.names))

    def forget(self) -> None:
        """Begin to look anew."""
        self.speeds = SpeedCheck(len(self.names))

    def are_due(
        self,
        *,
        misses: npt.NDArray[np.intp],
        jumps: npt.NDArray[np.intp],
        temperature_c: Array,
        is_odd: bool,
    ) -> bool:
        """Whether any joint has to be looked at: one is odd, or was.

        Args:
            misses: periods in a row without a reply, shape (n,).
            jumps: replies in a row that were not believed, shape (n,).
            temperature_c: of windings, NaN where it is not known, shape (n,).
            is_odd: whether something is that a family alone has.
        """
        return (
            is_odd
            or bool(self._troubled)
            or bool(misses.any())
            or bool(self.speeds.wrong.any())
            or bool(np.fmax.reduce(temperature_c - self._hot_c) > -WARM_K)
            or bool(jumps.any())
        )

    def silence(self, index: int, misses: int, motor: str, cure: str) -> Iterator[Alarm]:
        """It did not answer: HOLD, and when that has gone on for too long SIT, latched.

        Args:
            index: of the joint.
            misses: periods in a row.
            motor: where it is, for people.
            cure: what a person does about it.
        """
        if misses < SILENT_PERIODS:
            return
        name, text = self.names[index], f"silent for {misses} periods ({motor})"
        if misses < self._periods:
            yield Alarm("silent", name, Level.HOLD, text, cure)
        else:
            yield Alarm("silent", name, Level.SIT, text, cure, is_latched=True)

    def motion(self, index: int, jumps: int, cure_of_speed: str) -> Iterator[Alarm]:
        """Its speed is not that of its positions, or its position jumped.

        Args:
            index: of the joint.
            jumps: replies in a row that were not believed.
            cure_of_speed: what a person does about a speed that is wrong.
        """
        name = self.names[index]
        if self.speeds.wrong[index]:
            text = f"its speed is {self.speeds.ratio[index]:.2f} times that of its positions"
            yield Alarm("speed_mismatch", name, Level.HOLD, text, cure_of_speed)
        if jumps >= JUMPS_BELIEVED:
            text = f"its position jumped, {jumps} times in a row"
            cure = "look at its encoder and its power"
            yield Alarm("encoder_jump", name, Level.SIT, text, cure, is_latched=True)

    def heat(self, index: int, celsius: float) -> Iterator[Alarm]:
        """It is warm, and gives less."""
        hot_c = float(self._hot_c[index])
        if celsius > hot_c - WARM_K:
            text = f"{celsius:.0f} °C of {hot_c:g}: less torque"
            yield Alarm("warm", self.names[index], Level.DERATE, text, "let it rest")

    def sound(self, index: int, alarms: list[Alarm]) -> None:
        """These are a joint's now: what it had beside them has ended, unless it is latched."""
        name = self.names[index]
        for alarm in alarms:
            self._alarms.sound(alarm)
        sounding = {alarm.code for alarm in alarms}
        for alarm in self._alarms.on:
            if alarm.who == name and alarm.code not in sounding:
                self._alarms.quiet(alarm.code, name)
        (self._troubled.add if alarms else self._troubled.discard)(name)
