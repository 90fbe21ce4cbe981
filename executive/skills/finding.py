"""Finding an object: look where it was, look around, then go and look place by place."""

from __future__ import annotations

import math
from collections.abc import Sequence

from executive.skills.asking import stance_of
from executive.skills.body import Body
from executive.skills.looking import fresh_track, see, turn_head
from executive.skills.script import GaveUp, Script, give_up
from executive.skills.visiting import has_room, stances_around, stances_at, walk_to_any
from executive.skills.walking import stand_still, turn_by
from robot.messages import Place
from robot.se3 import SE3, Vector3

GLANCES_RAD = (0.0, 0.8, -0.8)
GLANCE_DISTANCE_M = 1.5
GLANCE_HEIGHT_M = 0.6
GLANCE_S = 0.35
SIGHT_M = 3.0
LOOK_FROM_M = 1.0
SURFACE_GLANCES = ((0.0, 0.0), (0.3, 0.3), (0.3, -0.3), (-0.3, -0.3), (-0.3, 0.3))


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
    found = yield from _look_around(body, object_id, begin_s)
    if found is not None:
        return found
    looked: list[str] = []
    for place in _places(body, place_ids):
        found = yield from _look_at_place(body, object_id, place, begin_s)
        if found is not None:
            return found
        looked.append(place.name)
    raise give_up(
        "object_not_seen",
        f"did not find the {name}; looked " + (f"at {', '.join(looked)}" if looked else "around"),
        object=object_id,
    )


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


def _look_around(body: Body, object_id: str, begin_s: float) -> Script[SE3 | None]:
    """Look ahead, left and right, then where there is room turn around and do it again."""
    for half_turn in (False, True):
        if half_turn and not has_room(body, stance_of(body.X_WS)):
            return None
        if half_turn:
            yield from turn_by(body, math.pi)
            yield from stand_still(body)
        for p_W in _glances(body.X_WS):
            yield from turn_head(body, p_W)
            yield from body.wait(GLANCE_S)
            if fresh_track(body, object_id, begin_s) is not None:
                return (yield from _make_sure(body, object_id))
    return None


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


def _look_at_place(body: Body, object_id: str, place: Place, begin_s: float) -> Script[SE3 | None]:
    """Walk to a place and look over it; None if the object is not there or no path leads there."""
    body.phase = f"going to look at the {place.name}"
    try:
        yield from walk_to_any(body, stances_at(place, body.X_WS), name=place.name)
    except GaveUp as end:
        if end.failure.code not in ("no_path", "goal_in_collision", "path_blocked"):
            raise
        return None
    body.phase = f"looking over the {place.name}"
    for part_x, part_y in SURFACE_GLANCES:
        offset = (part_x * place.size_m[0], part_y * place.size_m[1], 0.0)
        x_m, y_m, z_m = (float(value) for value in place.X_WP.apply(offset))
        if fresh_track(body, object_id, begin_s) is None:
            yield from turn_head(body, (x_m, y_m, z_m))
            yield from body.wait(GLANCE_S)
        if fresh_track(body, object_id, begin_s) is not None:
            return (yield from _make_sure(body, object_id))
    return None


def _places(body: Body, place_ids: Sequence[str]) -> list[Place]:
    """Where to look: the places asked for, or every surface, the nearest first."""
    if place_ids:
        return [body.place(place_id) for place_id in place_ids]
    here = body.X_WS.p
    surfaces = {place.X_WP.p: place for place in body.map.places if not place.floor}
    return sorted(
        surfaces.values(), key=lambda place: (math.dist(place.X_WP.p[:2], here[:2]), place.id)
    )


def _glances(X_WS: SE3) -> list[Vector3]:
    """Points to look at around a stance: ahead, left, right."""
    points: list[Vector3] = []
    for turn_rad in GLANCES_RAD:
        yaw_rad = X_WS.yaw_rad + turn_rad
        points.append(
            (
                X_WS.p[0] + GLANCE_DISTANCE_M * math.cos(yaw_rad),
                X_WS.p[1] + GLANCE_DISTANCE_M * math.sin(yaw_rad),
                GLANCE_HEIGHT_M,
            )
        )
    return points
