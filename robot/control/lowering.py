"""What is left to a robot whose motor or IMU broke: it squats on what it has, and stays there.

Low, it falls least deep if more breaks, and a person can take it. It takes no orders for its legs
any more; who starts it anew has looked at the motor before.
"""

from __future__ import annotations

from collections.abc import Sequence

from robot.failures import Failure, failure
from robot.messages import IMU, MotorAlarm

LOW_SHARE = 0.7
"""Of the standing height: about as low as it can squat."""


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

    def heed(self, alarms: Sequence[MotorAlarm]) -> bool:
        """Look at the alarms of a period; whether the lowering begins with it."""
        if self.reason is not None or not alarms or alarms[0].level != "SIT":
            return False
        worst = alarms[0]
        text = f"{worst.who}: {worst.cause}"
        evidence = {"who": worst.who, "alarm": worst.code}
        code = "imu_fault" if worst.who == IMU else "motor_fault"
        self.reason = failure(code, text, suggestion=worst.cure, **evidence)
        return True
