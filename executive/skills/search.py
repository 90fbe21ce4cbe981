"""Look for an object until it is seen."""

from __future__ import annotations

from executive.skills.motions.object_search import find
from executive.skills.motions.script import Script
from executive.skills.motions.stow import stow_arms
from executive.skills.parameters import SkillParams
from executive.skills.scripted import ScriptedSkill


class SearchParams(SkillParams, frozen=True, kw_only=True):
    """Look for an object: here, where it was last, then at each of the places (none: all)."""

    object_id: str
    place_ids: tuple[str, ...] = ()


class Search(ScriptedSkill[SearchParams]):
    """Look around, then go from place to place; ends when the object is in sight."""

    name = "search"
    summary = "look for a thing, here and then from place to place"
    takes = SearchParams
    resources = frozenset({"legs", "head", "left_arm", "right_arm"})

    def script(self) -> Script[None]:
        """Find it with the eyes, wherever it is believed to be."""
        yield from stow_arms(self.body)
        yield from find(
            self.body, self.parameters.object_id, place_ids=self.parameters.place_ids, by_sight=True
        )
