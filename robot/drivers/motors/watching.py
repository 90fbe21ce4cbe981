"""What may be wrong with a motor of any family, as alarms; and which of a joint's have ended."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator
from typing import ClassVar, Generic, TypeVar

import numpy as np
import numpy.typing as npt

from robot.drivers.motors.alarms import Alarm, Alarms, Kind, Level
from robot.drivers.motors.heard import Heard
from robot.drivers.motors.jumps import JUMPS_BELIEVED
from robot.drivers.motors.limiter import LEAST_SHARE, WARM_K
from robot.drivers.motors.motor_map import MotorMap
from robot.drivers.motors.mounting import MountedJoints
from robot.drivers.motors.speed_check import WINDOW_S, SpeedCheck
from robot.se3 import Array

SILENT_PERIODS = 3
SILENT_S = 0.020
IMPOSSIBLE_PERIODS = 3
UNKNOWN = 1000
"""Periods without a reply, of one that never came."""


SILENT = Kind(
    "silent",
    Level.HOLD,
    f"{SILENT_PERIODS} replies in a row did not come",
    f"{SILENT_PERIODS} periods",
)
DEAD = Kind(
    "silent",
    Level.SIT,
    f"no reply for {1000 * SILENT_S:g} ms, and {SILENT_PERIODS + 1} periods at least",
    f"{1000 * SILENT_S:g} ms",
    is_latched=True,
)
WARM = Kind(
    "warm",
    Level.DERATE,
    f"a winding is within {WARM_K:g} K of its limit: torque falls linearly to "
    f"{100 * LEAST_SHARE:g} % there",
    "1 period",
)
WRONG_SPEED = Kind(
    "speed_mismatch",
    Level.HOLD,
    f"its speed is not that of its positions, over two windows of {1000 * WINDOW_S:g} ms in motion",
    f"{2000 * WINDOW_S:g} ms",
)
JUMPED = Kind(
    "encoder_jump",
    Level.SIT,
    f"{JUMPS_BELIEVED} positions in a row were too far from the one before; none is believed",
    f"{JUMPS_BELIEVED} periods",
    is_latched=True,
)
UNPLUGGED = Kind(
    "unplugged",
    Level.SIT,
    "the interface of a bus or port went away; the others go on",
    "1 period",
    is_latched=True,
)
IMPOSSIBLE = Kind(
    "linkage",
    Level.SIT,
    f"cranks of a linkage stood where its joints cannot be, {IMPOSSIBLE_PERIODS} periods in a row",
    f"{IMPOSSIBLE_PERIODS} periods",
    is_latched=True,
)
"""Of families whose motors may move joints together."""
KINDS = (SILENT, DEAD, WARM, WRONG_SPEED, JUMPED, UNPLUGGED)
"""What is watched for in every family."""


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

    def feel(
        self, now_s: float, q: Array, qd: Array, misses: npt.NDArray[np.intp], heard_s: Array
    ) -> None:
        """Compare speeds with positions, of joints that have said where they are.

        Before its first reply a joint stands nowhere: from there to where it is nothing moved.

        Args:
            now_s: when.
            q: angles of the joints, shape (n,).
            qd: their speeds, shape (n,).
            misses: periods in a row without a reply, shape (n,).
            heard_s: when each told where it is; -inf: never, shape (n,).
        """
        self.speeds.feel(now_s, q, qd, np.where(np.isfinite(heard_s), misses, UNKNOWN))

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
        yield (SILENT if misses < self._periods else DEAD).alarm(name, text, cure)

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
            yield WRONG_SPEED.alarm(name, text, cure_of_speed)
        if jumps >= JUMPS_BELIEVED:
            text = f"its position jumped, {jumps} times in a row"
            yield JUMPED.alarm(name, text, "look at its encoder and its power")

    def heat(self, index: int, celsius: float) -> Iterator[Alarm]:
        """It is warm, and gives less."""
        hot_c = float(self._hot_c[index])
        if celsius > hot_c - WARM_K:
            text = f"{celsius:.0f} °C of {hot_c:g}: less torque"
            yield WARM.alarm(self.names[index], text, "let it rest")

    def linkages(self, unsolved: Iterable[tuple[str, int]]) -> None:
        """Linkages, and for how many periods in a row cranks stood where no joints can be."""
        for name, periods in unsolved:
            if periods >= IMPOSSIBLE_PERIODS:
                text = f"its cranks stand where its joints cannot be, {periods} periods in a row"
                cure = "look for a loose rod or crank, or measure the linkage again"
                self._alarms.sound(IMPOSSIBLE.alarm(name, text, cure))

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


M = TypeVar("M", bound=MotorMap)
H = TypeVar("H", bound=Heard)


class Watch(ABC, Generic[M, H]):
    """Looks at what the motors of a map tell, period by period, and sounds alarms.

    A family says what is wrong with one of its motors, and what is with its lines.

    Attributes:
        unplugged_cure: what a person does about a line that went away.
        joints: what every family looks at.
    """

    unplugged_cure: ClassVar[str] = ""

    def __init__(self, joints: M, alarms: Alarms) -> None:
        """Sounds these alarms."""
        self._alarms, self._map = alarms, joints
        self.joints = JointAlarms(joints, alarms)

    def forget(self) -> None:
        """Begin to look anew."""
        self.joints.forget()

    def unplugged(self, line: str, why: str) -> None:
        """A line went away."""
        self._alarms.sound(UNPLUGGED.alarm(line, why, self.unplugged_cure))

    def look(self, now_s: float, heard: H, q: Array, qd: Array, *, is_armed: bool) -> None:
        """A period ended.

        Args:
            now_s: when.
            heard: what motors told.
            q: angles of the joints, shape (n,).
            qd: their speeds, shape (n,).
            is_armed: whether the motors were enabled from here.
        """
        self._feel(now_s, heard, q, qd)
        if self.joints.are_due(
            misses=heard.misses,
            jumps=heard.jumps,
            temperature_c=heard.temperature_c,
            is_odd=self._is_odd(heard),
        ):
            for index in range(len(self.joints.names)):
                self.joints.sound(index, self._of_one(index, heard, is_armed=is_armed))
        self._of_lines(now_s, heard, is_armed=is_armed)

    def _feel(self, now_s: float, heard: H, q: Array, qd: Array) -> None:
        self.joints.feel(now_s, q, qd, heard.misses, heard.heard_s)

    @abstractmethod
    def _is_odd(self, heard: H) -> bool:
        """Whether something is that this family alone has, so that all have to be looked at."""

    @abstractmethod
    def _of_one(self, index: int, heard: H, *, is_armed: bool) -> list[Alarm]:
        """All that is wrong with a joint's motor now."""

    @abstractmethod
    def _of_lines(self, now_s: float, heard: H, *, is_armed: bool) -> None:
        """Sound what is wrong with lines."""
