"""Look over places: all of them, or until one of some things is seen there."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from executive.skills.forecast import Forecast, Outlook
from executive.skills.motions.likelihood import surfaces_of
from executive.skills.motions.look_closer import (
    MOST_NAMES,
    look_closer,
    unclear,
    unclear_words,
)
from executive.skills.motions.look_over import limit_s, look_over
from executive.skills.motions.script import Script, give_up
from executive.skills.motions.stow import stow_arms
from executive.skills.motions.support import stands_on, surroundings
from executive.skills.motions.survey import Prospect, Survey
from executive.skills.parameters import SkillParams
from executive.skills.scripted import ScriptedSkill
from executive.skills.skill import Resource
from robot.messages import Place, Track, Unnamed

RECENT_S = 120.0
"""What was seen that long ago is taken to be so still: the length of a short job."""
HIDDEN = 0.1
"""Where more of a surface may hide a thing, nothing is said of what is not there."""
NEAR_M = 1.5
"""Somebody that near to a surface may be what hides it."""
FROM_ALL_SIDES = "from all sides"
"""Evidence that it is the home itself that hides a part: no wait and no help changes that."""
THERE_M, THERE = 0.35, 8.0
"""It is looked first near to where such a thing is believed to be."""


class InspectParams(SkillParams, frozen=True, kw_only=True):
    """Look over places (none: what can be seen from here without walking).

    With objects it ends as soon as one of them is seen there, or all are known to be elsewhere. All
    of the places is looked over for `about_ids`. What has no name and may be one of either is
    looked at closer; that none of the objects, or fewer than `least` of those that it is about, was
    seen is not known while such a thing stands there (None: that is nobody's question).
    """

    place_ids: tuple[str, ...] = ()
    object_ids: tuple[str, ...] = ()
    about_ids: tuple[str, ...] = ()
    least: int | None = None


class Inspect(ScriptedSkill[InspectParams]):
    """See all of some surfaces; what was seen lately is not looked at again."""

    name = "inspect"
    summary = "look over a place, all of it"
    takes = InspectParams
    resources: frozenset[Resource] = frozenset({"legs", "head", "left_arm", "right_arm"})

    @classmethod
    def forecast(cls, wanted: InspectParams, outlook: Outlook) -> Forecast:
        """A walk to every place."""
        told = Forecast(0.0 if wanted.place_ids else outlook.robot.paces.inspect_s)
        for place_id in wanted.place_ids:
            way = outlook.walk_to_place(outlook.map.place(place_id))
            told = Forecast(
                told.takes_s + way.takes_s + outlook.robot.paces.inspect_s,
                told.problem or way.problem,
            )
        return told

    def limit_s(self) -> float:
        """As long as it takes to look at the places, and then some."""
        return limit_s(self.body, len(self.parameters.place_ids))

    def script(self) -> Script[None]:
        """Look until it is known."""
        body = self.body
        self._since_s = body.now_s - RECENT_S
        survey = self._survey()
        survey.take(body.world.looked)
        asked = (*self.parameters.object_ids, *self.parameters.about_ids)
        stay = not self.parameters.place_ids
        if self._is_known():
            return
        if len(survey.left) or unclear(body.world, asked, survey.places):
            yield from stow_arms(body)
        if (yield from look_over(body, survey, self._is_known, stay=stay)):
            return
        if not stay and (yield from look_closer(body, asked, survey.places, self._is_known)):
            return
        self._check_made_out(survey.places)
        if stay:
            return
        for place in survey.places:
            if self._may_hide(survey, place):
                told = {"place": place.id}
                if self._stays_hidden(survey, place):
                    told["looked"] = FROM_ALL_SIDES
                raise give_up("place_not_seen", _unseen_words(survey, place), **told)

    def _check_made_out(self, places: Sequence[Place]) -> None:
        """Give up when what was asked may be there and have no name."""
        body, wanted = self.body, self.parameters
        ids = wanted.object_ids
        if not ids and wanted.least is not None and self._count(places) < wanted.least:
            ids = wanted.about_ids
        things = unclear(body.world, ids, places)
        if things:
            names = " or ".join(body.object_info(id).full_name for id in _may_be(things, ids))
            cause = f"cannot tell whether {unclear_words(things, body.map)} is {names}"
            raise give_up("not_made_out", cause, things=len(things))

    def _count(self, places: Sequence[Place]) -> int:
        """How many of those that it is about are believed to stand there."""
        ids = self.parameters.about_ids
        tracks = [track for track in self.body.world.tracks if track.id in ids]
        return sum(self._is_there(track, places) for track in tracks if not track.missing)

    def _survey(self) -> Survey:
        body, wanted = self.body, self.parameters
        asked = [body.place(place_id) for place_id in wanted.place_ids]
        places = [place for place in asked or surfaces_of(body.map) if not place.floor]
        survey = Survey((Prospect(place=place) for place in places), since_s=self._since_s)
        for track in self._tracks():
            if track.X_WO is not None:
                survey.favour(track.X_WO.p, within_m=THERE_M, factor=THERE)
        return survey

    def _may_hide(self, survey: Survey, place: Place) -> bool:
        """Whether what was asked for may stand where the surface could not be seen."""
        unseen = survey.unseen_W(place)
        for thing in surroundings(self.body).objects:
            if thing.id not in self.parameters.object_ids:  # where one stands stands nothing else
                half_m = 0.5 * np.array(thing.shape.size_m[:2])
                off_O = (unseen - np.array(thing.X_WO.p)) @ thing.X_WO.rotation()
                unseen = unseen[(np.abs(off_O[:, :2]) > half_m).any(axis=1)]
        believed = [track.X_WO.p for track in self._tracks() if track.X_WO is not None]
        near = any((np.linalg.norm(unseen - np.array(p), axis=1) < THERE_M).any() for p in believed)
        return near or len(unseen) > HIDDEN * len(place.samples())

    def _stays_hidden(self, survey: Survey, place: Place) -> bool:
        """Whether nobody and no thing hides the rest of it: a board above the eyes, say."""
        world = self.body.world
        people = [track.X_WO.p for track in world.people if track.X_WO is not None]
        near = any(math.dist(p[:2], place.X_WP.p[:2]) < NEAR_M for p in people)
        things = [track.X_WO for track in world.tracks if track.X_WO is not None]
        full = any(stands_on(X_WO, place) for X_WO in things)
        return survey.seen_share(place) > 0.0 and not near and not full

    def _tracks(self) -> list[Track]:
        wanted = self.parameters.object_ids
        return [track for track in self.body.world.tracks if track.id in wanted]

    def _is_known(self) -> bool:
        """Whether one of the objects was seen there lately, or all of them elsewhere."""
        tracks = self._tracks()
        if not tracks:
            return False
        places = [self.body.place(place_id) for place_id in self.parameters.place_ids]
        if any(self._is_there(track, places) for track in tracks if self._is_fresh(track)):
            return True
        return bool(self.parameters.place_ids) and all(map(self._is_fresh, tracks))

    def _is_fresh(self, track: Track) -> bool:
        return track.held_by is not None or (track.seen_s >= self._since_s and not track.missing)

    def _is_there(self, track: Track, places: Sequence[Place]) -> bool:
        X_WO = track.X_WO
        if X_WO is None or track.held_by is not None:
            return False
        return not places or any(stands_on(X_WO, place) for place in places)


def _may_be(things: Sequence[Unnamed], ids: Sequence[str]) -> list[str]:
    """Which of some objects things may be, the likeliest first."""
    return list(dict.fromkeys(id for one in things for id in one.may_be if id in ids))[:MOST_NAMES]


def _unseen_words(survey: Survey, place: Place) -> str:
    """That something may stand where a place could not be seen."""
    share = survey.seen_share(place)
    if not share:
        return f"could not look over the {place.name}; {survey.words()}"
    return f"saw only {100 * share:.0f} % of the {place.name}: the rest is hidden from all sides"
