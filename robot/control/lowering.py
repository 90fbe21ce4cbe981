"""What is left to a robot one of whose motors broke: it squats on what it has, then damps."""

from __future__ import annotations

from collections.abc import Sequence

from robot.failures import Failure, failure
from robot.messages import MotorAlarm

LOW_SHARE = 0.7
"""Of the standing height: about as low as it can squat."""
SQUAT_S = 4.0
"""If it is not down by then, it never will be."""


class Lowering:
    """Begins with the first alarm that wants it; latched.

    Attributes:
        reason: why the robot is lowered; None while all is well.
        height_m: of the base, at the end.
    """

    def __init__(self, height_m: float) -> None:
        """Of a robot that stands at such a height of its base."""
        self.reason: Failure | None = None
        self.height_m = LOW_SHARE * height_m
        self._begun_s = 0.0

    def heed(self, alarms: Sequence[MotorAlarm], now_s: float) -> bool:
        """Look at the alarms of a period; whether the lowering begins with it."""
        if self.reason is not None or not alarms or alarms[0].level != "SIT":
            return False
        worst = alarms[0]
        text = f"{worst.who}: {worst.cause}"
        evidence = {"who": worst.who, "alarm": worst.code}
        self.reason = failure("motor_fault", text, suggestion=worst.cure, **evidence)
        self._begun_s = now_s
        return True

    def is_over(self, now_s: float, *, is_low: bool) -> bool:
        """Whether the motors may damp now."""
        return self.reason is not None and (is_low or now_s - self._begun_s > SQUAT_S)
