"""Turn the head towards something."""

from __future__ import annotations

import math

from executive.skills.context import SkillContext
from executive.skills.motions.body_access import Body
from executive.skills.motions.gaze import see, turn_head
from executive.skills.motions.planning import stance_of
from executive.skills.motions.script import Script
from executive.skills.motions.scripted import ScriptedSkill
from executive.skills.parameters import LookParams

FACE_HEIGHT_M = 1.5
GAZE_S = 0.5


AROUND_RAD = (0.0, 0.9, -0.9, 0.0)
AROUND_M, AROUND_HEIGHT_M = 2.0, 0.8


class Look(ScriptedSkill):
    """Look at an object until it is seen; at a place, a person, a point, all sides for a moment."""

    resources = frozenset({"head"})

    def __init__(self, parameters: LookParams, context: SkillContext) -> None:
        """At what."""
        super().__init__(context)
        self.parameters = parameters

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
