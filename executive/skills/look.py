"""Turn the head towards something."""

from __future__ import annotations

from executive.skills.context import SkillContext
from executive.skills.looking import see, turn_head
from executive.skills.parameters import LookParams
from executive.skills.script import Script
from executive.skills.scripted import ScriptedSkill

FACE_HEIGHT_M = 1.5
GAZE_S = 0.5


class Look(ScriptedSkill):
    """Look at an object until it is seen; at a place, a person or a point for a moment."""

    resources = frozenset({"head"})

    def __init__(self, parameters: LookParams, context: SkillContext) -> None:
        """At what."""
        super().__init__(context)
        self.parameters = parameters

    def script(self) -> Script[None]:
        """Turn the head; the body stays."""
        body, wanted = self.body, self.parameters
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
