"""Look for an object until it is seen."""

from __future__ import annotations

from executive.skills.forecast import Forecast, Outlook
from executive.skills.motions.look_over import limit_s
from executive.skills.motions.object_search import find
from executive.skills.motions.script import Script
from executive.skills.motions.stow import stow_arms
from executive.skills.motions.walk import stand_still
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

    @classmethod
    def forecast(cls, wanted: SearchParams, outlook: Outlook) -> Forecast:
        """As if it were at the first place asked for, or where it stands."""
        asked = [outlook.map.place(place_id) for place_id in wanted.place_ids]
        at = next(iter(asked), None) or outlook.place_of(wanted.object_id)
        return outlook.walk_to_place(at).then(outlook.robot.paces.search_s)

    def limit_s(self) -> float:
        """As long as it takes to look everywhere, and then some."""
        return limit_s(self.body)

    def script(self) -> Script[None]:
        """Find it with the eyes, wherever it is believed to be."""
        yield from stow_arms(self.body)
        yield from find(
            self.body, self.parameters.object_id, place_ids=self.parameters.place_ids, by_sight=True
        )
        if self.body.state.mode != "stand":  # seen on the way, and nobody walks on
            yield from stand_still(self.body)
