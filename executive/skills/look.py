"""Turn the head towards something."""

from __future__ import annotations

import math
from typing import Literal

from executive.skills.forecast import Forecast, Outlook
from executive.skills.motions.body_access import Body
from executive.skills.motions.gaze import see, turn_head
from executive.skills.motions.planning import stance_of
from executive.skills.motions.script import Script
from executive.skills.parameters import SkillParams, exactly_one, finite
from executive.skills.scripted import ScriptedSkill
from robot.se3 import Vector3

FACE_HEIGHT_M = 1.5
GAZE_S = 0.5
AROUND_RAD = (0.0, 0.9, -0.9, 0.0)
AROUND_M, AROUND_HEIGHT_M = 2.0, 0.8
LOOK_S = 1.1
"""Of turning the head and looking: for the forecast."""


class LookParams(SkillParams, frozen=True, kw_only=True):
    """Turn the head towards an object, a place, a person or a point p_W, or to all sides."""

    object_id: str | None = None
    place_id: str | None = None
    person_id: str | None = None
    p_W: Vector3 | None = None
    around: Literal[True] | None = None

    def __post_init__(self) -> None:
        """Check that there is one target."""
        exactly_one(self, "object_id", "place_id", "person_id", "p_W", "around")
        if self.p_W is not None:
            finite(*self.p_W)


class Look(ScriptedSkill[LookParams]):
    """Look at an object until it is seen; at a place, a person, a point, all sides for a moment."""

    name = "look"
    summary = "turn the head towards something, or to all sides"
    takes = LookParams
    resources = frozenset({"head"})

    @classmethod
    def forecast(cls, wanted: LookParams, outlook: Outlook) -> Forecast:
        """A moment."""
        return Forecast(LOOK_S)

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
        else:
            assert wanted.p_W is not None
            body.phase, p_W = "looking", wanted.p_W
        yield from turn_head(body, p_W)
        yield from body.wait(GAZE_S)


def look_around(body: Body) -> Script[None]:
    """Let the eyes rest ahead, to the left and to the right; the body stays."""
    body.phase = "looking around"
    x_m, y_m, yaw_rad = stance_of(body.X_WS)
    for aside_rad in AROUND_RAD:
        at_rad = yaw_rad + aside_rad
        p_W = (
            x_m + AROUND_M * math.cos(at_rad),
            y_m + AROUND_M * math.sin(at_rad),
            AROUND_HEIGHT_M,
        )
        yield from turn_head(body, p_W)
        yield from body.wait(GAZE_S)
