"""Turn the head towards something."""

from __future__ import annotations

import math
from typing import Literal

from executive.skills.forecast import Forecast, Outlook
from executive.skills.motions.body_access import Body
from executive.skills.motions.gaze import see, turn_head
from executive.skills.motions.planning import pose_of, stance_of
from executive.skills.motions.script import Script
from executive.skills.parameters import SkillParams, exactly_one, finite
from executive.skills.scripted import ScriptedSkill
from robot.model.description import RobotDescription
from robot.se3 import SE3, Vector3

FACE_HEIGHT_M = 1.5
"""Of a person who stands."""
GAZE_S = 0.5
AROUND_M, AROUND_HEIGHT_M = 2.0, 0.8
Side = Literal["ahead", "left", "right", "up", "down"]
SIDES: dict[Side, Vector3] = {
    "ahead": (AROUND_M, 0.0, AROUND_HEIGHT_M),
    "left": (0.0, AROUND_M, AROUND_HEIGHT_M),
    "right": (0.0, -AROUND_M, AROUND_HEIGHT_M),
    "up": (1.0, 0.0, 3.0),
    "down": (0.5, 0.0, 0.0),
}
"""Points p_S beside where the robot stands; a neck goes as far towards one as it turns. "Up" is the
far end of a ceiling, "down" the floor before the feet."""


class LookParams(SkillParams, frozen=True, kw_only=True):
    """Turn the head towards an object, a place, a person or a point p_W, to a side, or to all."""

    object_id: str | None = None
    place_id: str | None = None
    person_id: str | None = None
    p_W: Vector3 | None = None
    towards: Side | None = None
    around: Literal[True] | None = None

    def __post_init__(self) -> None:
        """Check that there is one target."""
        exactly_one(self, "object_id", "place_id", "person_id", "p_W", "towards", "around")
        if self.p_W is not None:
            finite(*self.p_W)


class Look(ScriptedSkill[LookParams]):
    """Look at an object until it is seen; at a place, a person, a point, a side for a moment."""

    name = "look"
    summary = "turn the head towards something, or to all sides"
    takes = LookParams
    resources = frozenset({"head"})

    @classmethod
    def lack(cls, wanted: LookParams, robot: RobotDescription) -> str:
        """A neck, or a waist that turns instead."""
        turns = robot.groups["head"] or robot.gaze.waist_yaw_rad > 0.0
        return "" if turns else "has no neck, and does not turn its waist to see"

    @classmethod
    def forecast(cls, wanted: LookParams, outlook: Outlook) -> Forecast:
        """A moment."""
        return Forecast(outlook.robot.paces.look_s)

    def script(self) -> Script[None]:
        """Turn the head; the body stays."""
        body, wanted = self.body, self.parameters
        if wanted.around:
            yield from look_around(body)
            return
        if wanted.object_id is not None:
            body.phase = f"looking at the {body.object_info(wanted.object_id).name}"
            yield from see(body, wanted.object_id)
            return
        if wanted.place_id is not None:
            place = body.place(wanted.place_id)
            body.phase, p_W = f"looking at the {place.name}", place.X_WP.p
        elif wanted.person_id is not None:
            body.phase = f"looking at {body.person(wanted.person_id).name}"
            x_m, y_m, _ = body.X_WPerson(wanted.person_id).p
            p_W = (x_m, y_m, FACE_HEIGHT_M)
        elif wanted.towards is not None:
            body.phase = f"looking {wanted.towards}"
            p_W = (pose_of(stance_of(body.X_WS)) @ SE3(SIDES[wanted.towards])).p
        else:
            assert wanted.p_W is not None
            body.phase, p_W = "looking", wanted.p_W
        yield from turn_head(body, p_W)
        yield from body.wait(GAZE_S)


def look_around(body: Body) -> Script[None]:
    """Let the eyes rest ahead, to the left and to the right; the body stays."""
    body.phase = "looking around"
    x_m, y_m, yaw_rad = stance_of(body.X_WS)
    for aside_rad in body.description.gaze.around_rad:
        at_rad = yaw_rad + aside_rad
        p_W = (
            x_m + AROUND_M * math.cos(at_rad),
            y_m + AROUND_M * math.sin(at_rad),
            AROUND_HEIGHT_M,
        )
        yield from turn_head(body, p_W)
        yield from body.wait(GAZE_S)
