"""Look for an object until it is seen."""

from __future__ import annotations

from executive.skills.context import SkillContext
from executive.skills.motions.object_search import find
from executive.skills.motions.script import Script
from executive.skills.motions.scripted import ScriptedSkill
from executive.skills.motions.stow import stow_arms
from executive.skills.parameters import SearchParams


class Search(ScriptedSkill):
    """Look around, then go from place to place; ends when the object is in sight."""

    resources = frozenset({"legs", "head", "left_arm", "right_arm"})

    def __init__(self, parameters: SearchParams, context: SkillContext) -> None:
        """For what, and where."""
        super().__init__(context)
        self.parameters = parameters

    def script(self) -> Script[None]:
        """Find it with the eyes, wherever it is believed to be."""
        yield from stow_arms(self.body)
        yield from find(
            self.body, self.parameters.object_id, place_ids=self.parameters.place_ids, by_sight=True
        )
