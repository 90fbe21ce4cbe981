"""The controlled sit from a step: a controller of the owner's own ends the step, and squats.

A motion that is played without feedback does not get a robot out of a step. So the owner keeps a
copy of the controller, loaded and never ticked before it is needed. It takes the robot over as a
spare would, and does what any controller does for an alarm at SIT (`robot.control.lowering`).

What ended the controller may be in its code, and then in its copy: whatever this one raises, or
where it does not stay up, the owner damps, as it did without one. A robot that stands at rest is
lowered without it (`robot.owner.sit`).
"""

from __future__ import annotations

from dataclasses import replace
from typing import Protocol

from robot.control.loop import ControlLoop
from robot.drivers.body_sample import BodySample
from robot.drivers.motor_bus import MotorCommand
from robot.messages import MotorAlarm
from robot.model.description import RobotDescription

AT_LONGEST_S = 5.0
"""A step and a squat take 2 to 3 s."""
_ALARM = MotorAlarm(
    "controller_lost", "bus owner", "SIT", "the controller is lost", "start it anew"
)


class Balancing(Protocol):
    """Lowers a robot that is in a step."""

    @property
    def is_up(self) -> bool:
        """Whether it keeps the robot up; True before it began."""
        ...

    @property
    def is_low(self) -> bool:
        """Whether the robot squats, on both feet and at rest, or this has taken too long."""
        ...

    def command(self, sample: BodySample) -> MotorCommand:
        """What to send in this period; the first one begins."""
        ...


class OwnController:
    """The controller's copy."""

    def __init__(self, robot: RobotDescription) -> None:
        """Load it; nothing is commanded."""
        self._loop = ControlLoop(robot)
        self._begun_s: float | None = None
        self._now_s = 0.0
        self._is_broken = False

    @property
    def is_up(self) -> bool:
        """Whether it keeps the robot up."""
        begun = self._begun_s is not None
        return not self._is_broken and (not begun or self._loop.mode in ("stand", "walk"))

    @property
    def is_low(self) -> bool:
        """Whether it has squatted, or had time enough."""
        if self._begun_s is None:
            return False
        return self._loop.is_lowered or self._now_s - self._begun_s > AT_LONGEST_S

    def command(self, sample: BodySample) -> MotorCommand:
        """One period; damping from the first on in which it does not work."""
        self._now_s = sample.motors.stamp_s
        if self._begun_s is None:
            self._begun_s = self._now_s
        alarms = (_ALARM, *sample.motors.alarms)
        felt = replace(sample, motors=replace(sample.motors, alarms=alarms))
        try:
            if not self._is_broken:
                return self._loop.tick(felt)
        except Exception:  # whatever ended the controller may end its copy
            self._is_broken = True
        body = self._loop.body
        return MotorCommand.damping(body.count, self._now_s, body.kd)
