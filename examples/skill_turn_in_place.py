"""A skill: turn on the spot. It would be `executive/skills/turn_in_place.py`."""

from __future__ import annotations

from executive.skills.forecast import Forecast, Outlook
from executive.skills.motions.final_steps import step_to
from executive.skills.motions.pacing import turning_s
from executive.skills.motions.planning import stance_of
from executive.skills.motions.script import Script
from executive.skills.motions.walk import turn_by
from executive.skills.parameters import SkillParams, finite
from executive.skills.scripted import ScriptedSkill
from robot.se3 import SE3


class TurnInPlaceParams(SkillParams, frozen=True, kw_only=True):
    """Turn by an angle, to the left where it is positive."""

    angle_rad: float

    def __post_init__(self) -> None:
        """Check the angle."""
        finite(self.angle_rad)


class TurnInPlace(ScriptedSkill[TurnInPlaceParams]):
    """Turn by an angle, and stand."""

    name = "turn_in_place"
    summary = "turn on the spot"
    takes = TurnInPlaceParams
    resources = frozenset({"legs", "head", "left_arm", "right_arm"})

    @classmethod
    def forecast(cls, wanted: TurnInPlaceParams, outlook: Outlook) -> Forecast:
        """As long as the angle takes; the robot then faces elsewhere."""
        outlook.move(SE3.from_xy_yaw(0.0, 0.0, wanted.angle_rad))
        return Forecast(turning_s(wanted.angle_rad))

    def script(self) -> Script[None]:
        """Turn, then step into the exact stance; that ends standing."""
        body, angle_rad = self.body, self.parameters.angle_rad
        body.phase = "turning"
        X_WS_turned = body.X_WS @ SE3.from_xy_yaw(0.0, 0.0, angle_rad)
        yield from turn_by(body, angle_rad)
        yield from step_to(body, stance_of(X_WS_turned))
