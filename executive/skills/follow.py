"""Walk behind a person: to where they are now, again and again, until they stop or arrive."""

from __future__ import annotations

import math

from executive.skills.context import SkillContext
from executive.skills.forecast import Forecast, Outlook
from executive.skills.motions.gaze import look_at
from executive.skills.motions.script import GaveUp, Script, give_up
from executive.skills.motions.standpoints import stances_around
from executive.skills.motions.stow import stow_arms
from executive.skills.motions.walk import follow, plan_path, stand_still
from executive.skills.parameters import SkillParams
from executive.skills.scripted import ScriptedSkill
from robot.messages import PersonInfo, Place
from robot.se3 import SE3

DISTANCE_M = 1.2
NEAR_M = 1.7
MOVED_M = 0.4
STOPPED_S = 5.0
ARRIVED_M = 1.5
SEEN_S = 1.0
LOST_S = 6.0
CHEST_M = 1.2
LOOK_EVERY_S = 0.5
NO_WAY = ("no_path", "goal_in_collision", "start_in_collision", "planner_timeout")


class FollowParams(SkillParams, frozen=True, kw_only=True):
    """Walk behind a person, until they stop or, if one is given, until they are at a place."""

    person_id: str
    place_id: str | None = None


class Follow(ScriptedSkill[FollowParams]):
    """Stay a step behind a person; ends when they have stood still for a while, or are there."""

    name = "follow"
    summary = "walk behind a person until they stop"
    takes = FollowParams
    resources = frozenset({"legs", "head", "left_arm", "right_arm"})

    @classmethod
    def forecast(cls, wanted: FollowParams, outlook: Outlook) -> Forecast:
        """The way to where the map has them; to a place, on from there to it if they are not there.

        How far they lead when no place is said nobody knows: they are taken to stand.
        """
        person = outlook.map.person(wanted.person_id)
        place = outlook.map.place(wanted.place_id or "")
        if person is None:
            return Forecast(STOPPED_S)
        told = _forecast_closing_up(person, outlook)
        if place is None:
            return told if told.takes_s > STOPPED_S else told.then(STOPPED_S - told.takes_s)
        if not told.problem and not _is_at(person.X_WO, place):
            onwards = outlook.walk_to_place(place)
            told = Forecast(told.takes_s + onwards.takes_s, onwards.problem)
        return told.then(SEEN_S)

    def __init__(self, parameters: FollowParams, context: SkillContext) -> None:
        """Whom, and where to."""
        super().__init__(parameters, context)
        self._looked_s = self._moved_s = self._begin_s = -math.inf
        self._at = SE3()

    def script(self) -> Script[None]:
        """Find them, then close up whenever they have gone on."""
        body = self.body
        person = body.person(self.parameters.person_id)
        place = body.place(self.parameters.place_id) if self.parameters.place_id else None
        body.companion = person.id
        yield from stow_arms(body)
        body.phase = f"looking for {person.name}"
        self._begin_s = self._moved_s = body.now_s
        self._at = body.X_WPerson(person.id)
        while not self._is_over(place):
            yield from self._watch(person)
            if math.dist(self._at.p[:2], body.X_WS.p[:2]) > NEAR_M:
                yield from self._close_up(person)

    def _watch(self, person: PersonInfo) -> Script[None]:
        """Look at them for a tick; note where they are and since when.

        Gives up with `person_not_seen` when they have been out of sight for `LOST_S`.
        """
        body = self.body
        if body.now_s - self._looked_s > LOOK_EVERY_S:
            look_at(body, (*self._at.p[:2], CHEST_M))
            self._looked_s = body.now_s
        yield
        track = next((track for track in body.world.people if track.id == person.id), None)
        begun_s = self._begin_s if track is None else max(track.seen_s, self._begin_s)
        if track is None or track.X_WO is None or body.now_s - track.seen_s > SEEN_S:
            if body.now_s - begun_s > LOST_S:
                raise give_up(
                    "person_not_seen",
                    f"{person.name} is out of sight for {body.now_s - begun_s:.0f} s",
                    person=person.id,
                )
            return
        if math.dist(track.X_WO.p[:2], self._at.p[:2]) > MOVED_M:
            self._at, self._moved_s = track.X_WO, body.now_s

    def _close_up(self, person: PersonInfo) -> Script[None]:
        """Walk up behind them; leaves off as soon as they have moved on."""
        body, begun = self.body, self._moved_s
        body.phase = f"following {person.name}"
        goal = stances_around(self._at.p, body.X_WS, distance_m=DISTANCE_M)[0]
        try:
            path = yield from plan_path(body, goal)
        except GaveUp as end:
            if end.failure.code not in NO_WAY:
                raise
            yield from body.wait(LOOK_EVERY_S)
            return
        walk = follow(body, path)
        for _ in walk:
            yield from self._watch(person)
            if self._moved_s != begun:
                walk.close()
                return
        yield from stand_still(body)

    def _is_over(self, place: Place | None) -> bool:
        """Whether they have stood still for long enough, or are at the place, the robot near."""
        body = self.body
        near = math.dist(self._at.p[:2], body.X_WS.p[:2]) <= NEAR_M
        still = body.now_s - self._moved_s
        if place is None:
            return near and still >= STOPPED_S
        return near and still >= SEEN_S and _is_at(self._at, place)


def _forecast_closing_up(person: PersonInfo, outlook: Outlook) -> Forecast:
    if math.dist(person.X_WO.p[:2], outlook.X_WS.p[:2]) <= NEAR_M:
        return Forecast(0.0)
    way = outlook.walk(stances_around(person.X_WO.p, outlook.X_WS, distance_m=DISTANCE_M)[:1])
    exact_s = outlook.robot.paces.step_in_s  # without which it stops
    return Forecast(max(0.0, way.takes_s - exact_s), way.problem)


def _is_at(X_WO: SE3, place: Place) -> bool:
    """Whether a person stands on a floor place, or within a step of a surface."""
    x_m, y_m, _ = place.X_WP.inverse().apply(X_WO.p)
    reach_m = 0.0 if place.floor and place.size_m[0] > ARRIVED_M else ARRIVED_M
    half_x, half_y = (0.5 * size + reach_m for size in place.size_m)
    return bool(abs(x_m) <= half_x and abs(y_m) <= half_y)
