"""The software's emergency stop: a latch. It is no replacement for a switch that cuts the power.

It is the topmost latch: it ends jobs and has the controller sit, so it wants a controller that
obeys. The lowest is a row of `robot.owner.reactions`, in the process that has the buses, whose stop
input takes all torque without anybody above; clamps (`robot.control.limits`,
`robot.drivers.motors.limiter`) know neither.
"""

from __future__ import annotations

from msgspec.structs import replace

from executive.health import Finding, Health, Level
from robot.errors import RobotError
from robot.failures import failure

_NAME = "emergency stop"


class StillPressed(RobotError):
    """The emergency stop was to be reset while it is pressed."""


class EmergencyStop:
    """Pressed, it ends all jobs and keeps new ones from moving until it is released and reset.

    Attributes:
        why: who pressed it or why, in words; empty while nothing is latched.
        pressed: whether it is held down now.
    """

    def __init__(self) -> None:
        """Neither pressed nor latched."""
        self.why = ""
        self.pressed = False

    @property
    def latched(self) -> bool:
        """Whether the robot has to stay at rest."""
        return bool(self.why)

    @property
    def finding(self) -> Finding | None:
        """What it says of the robot's health; None while nothing is latched."""
        if not self.latched:
            return None
        return Finding(name=_NAME, level=Level.SIT, failure=failure("emergency_stop", self.why))

    def seen_in(self, health: Health) -> Health:
        """The robot's health as it was at some tick, with this as it is now."""
        others = [one for one in health.findings if one.name != _NAME]
        now = [*others, *filter(None, [self.finding])]
        return replace(health, findings=tuple(sorted(now, key=lambda one: -one.level)))

    def press(self, why: str = "the emergency stop was pressed") -> None:
        """Hold it down; from any thread."""
        self.pressed = True
        self.why = self.why or why or "the emergency stop was pressed"

    def release(self) -> None:
        """Let go of it; it stays latched."""
        self.pressed = False

    def reset(self) -> None:
        """Allow motion again.

        Raises:
            StillPressed: while it is pressed.
        """
        if self.pressed:
            raise StillPressed("the emergency stop is still pressed: release it, then reset")
        self.why = ""
