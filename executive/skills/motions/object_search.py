"""Finding an object: look where it was, look around from here, then go and look place by place."""

from __future__ import annotations

import math
from collections.abc import Sequence

from executive.skills.motions.body_access import Body
from executive.skills.motions.gaze import fresh_track, see, turn_head
from executive.skills.motions.planning import stance_of
from executive.skills.motions.script import GaveUp, Script, give_up
from executive.skills.motions.standpoints import has_room, stances_around, stances_at, walk_to_any
from executive.skills.motions.survey import Survey
from executive.skills.motions.walk import stand_still, turn_by
from robot.messages import Place
from robot.se3 import SE3, wrap_angle

GLANCE_S = 0.35
SIGHT_M = 3.0
LOOK_FROM_M = 1.0
TURNS = 3
SMALL_TURN_RAD = 0.3


def find(
    body: Body, object_id: str, *, place_ids: Sequence[str] = (), by_sight: bool = False
) -> Script[SE3]:
    """Find an object: returns its pose X_WO, seen or (unless `by_sight`) remembered.

    Looks around from here, then from each of the places (none given: every surface of the map,
    the nearest first). Gives up with `object_not_seen`, naming where it looked.
    """
    name = body.object_info(object_id).name
    believed = _believed(body, object_id)
    if believed is not None and not by_sight:
        return believed
    if believed is not None:
        found = yield from _check_belief(body, object_id, believed)
        if found is not None:
            return found
    begin_s = body.now_s
    body.phase = f"looking around for the {name}"
    places = _places(body, place_ids)
    survey = Survey(places, fallen_from=None if place_ids else _last_place(body, object_id))
    found = yield from _look_around(body, object_id, survey, begin_s)
    while found is None and places:
        place = min(places, key=lambda place: _worth(body, place, survey))
        places.remove(place)
        found = yield from _look_at_place(body, object_id, place, survey, begin_s)
    if found is None:
        names = ", ".join(place.name for place in _places(body, place_ids))
        raise give_up(
            "object_not_seen",
            f"did not find the {name}; looked " + (f"at {names}" if names else "around"),
            object=object_id,
        )
    return found


def _believed(body: Body, object_id: str) -> SE3 | None:
    track = body.track(object_id)
    return track.X_WO if track is not None and not track.missing else None


def _check_belief(body: Body, object_id: str, X_WO: SE3) -> Script[SE3 | None]:
    """Look where the object was last, from nearby if need be."""
    if math.dist(X_WO.p[:2], body.X_WS.p[:2]) > SIGHT_M:
        stances = stances_around(X_WO.p, body.X_WS, distance_m=LOOK_FROM_M)
        yield from walk_to_any(body, stances, name=body.object_info(object_id).name)
    try:
        return (yield from see(body, object_id))
    except GaveUp as end:
        if end.failure.code != "object_not_seen":
            raise
        return None


def _look_around(body: Body, object_id: str, survey: Survey, begin_s: float) -> Script[SE3 | None]:
    """Look over all that is in view from here, then turn to where most is left, given room."""
    found = yield from _look_over(body, object_id, survey, begin_s)
    for _ in range(TURNS):
        yaw_rad = survey.heading(body.X_WS)
        if found is not None or yaw_rad is None or not has_room(body, stance_of(body.X_WS)):
            return found
        turn_rad = wrap_angle(yaw_rad - body.X_WS.yaw_rad)
        if abs(turn_rad) > SMALL_TURN_RAD:
            yield from turn_by(body, turn_rad)
            yield from stand_still(body)
        found = yield from _look_over(body, object_id, survey, begin_s)
    return found


def _look_over(body: Body, object_id: str, survey: Survey, begin_s: float) -> Script[SE3 | None]:
    """Turn the head to all that is left to be seen from here, until the object shows."""
    while True:
        if fresh_track(body, object_id, begin_s) is not None:
            return (yield from _make_sure(body, object_id))
        p_W = survey.next_point(body.X_WS)
        if p_W is None:
            return None
        yield from turn_head(body, p_W)
        yield from body.wait(GLANCE_S)
        survey.look(body.X_WS, p_W)


def _make_sure(body: Body, object_id: str) -> Script[SE3 | None]:
    """Look at what was glimpsed; from far or half hidden, the glimpse has to do."""
    track = body.track(object_id)
    glimpse = track.X_WO if track is not None else None
    try:
        return (yield from see(body, object_id))
    except GaveUp as end:
        if end.failure.code != "object_not_seen":
            raise
        return glimpse


def _look_at_place(
    body: Body, object_id: str, place: Place, survey: Survey, begin_s: float
) -> Script[SE3 | None]:
    """Walk to a place and look over it; None if the object is not there or no path leads there."""
    body.phase = f"going to look at the {place.name}"
    try:
        yield from walk_to_any(body, stances_at(place, body.X_WS), name=place.name)
    except GaveUp as end:
        if end.failure.code not in ("no_path", "goal_in_collision", "path_blocked"):
            raise
        return None
    body.phase = f"looking over the {place.name}"
    survey.again(place.id)
    return (yield from _look_over(body, object_id, survey, begin_s))


def _worth(body: Body, place: Place, survey: Survey) -> tuple[bool, float, str]:
    """Places that have not been seen from afar come first, then the nearest."""
    distance_m = math.dist(place.X_WP.p[:2], body.X_WS.p[:2])
    return (survey.left_at(place.id) == 0, distance_m, place.id)


def _last_place(body: Body, object_id: str) -> tuple[float, float, float] | None:
    """Where the object was last, whether it is still there or not."""
    track = body.track(object_id)
    return track.X_WO.p if track is not None and track.X_WO is not None else None


def _places(body: Body, place_ids: Sequence[str]) -> list[Place]:
    """Where to look: the places asked for, or every surface."""
    if place_ids:
        return [body.place(place_id) for place_id in place_ids]
    surfaces = {place.X_WP.p: place for place in body.map.places if not place.floor}
    return list(surfaces.values())
