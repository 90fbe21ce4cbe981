"""Where to stand to be at something: a room, a spot, a table, a person."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import TypeAlias

from executive.skills.motions.body_access import Body
from executive.skills.motions.obstructions import between, clearance_m
from executive.skills.motions.past_people import ask_past_people
from executive.skills.motions.planning import ask
from executive.skills.motions.script import GaveUp, Script, give_up
from executive.skills.motions.walk import path_request, walk_to
from robot.messages import PersonInfo, Place
from robot.planning.requests import BasePath, BasePathRequest, Stance
from robot.se3 import SE3

AT_PERSON_M = 1.0
HAND_M = 0.95
"""Of hands that meet, and of the line of sight of one who sits: over tables, not through walls."""
SPOT_GRID_M = 0.6
DIRECTIONS = 16
"""Around a person. With half as many the only one before somebody between a doorway and a sofa was
0.18 m from the jamb, and the torso touched it."""
TRIES, ELSEWHERE_M = 9, 1.2
"""So many places are tried at most; beside one that only a narrow way leads to, the next is not."""
BAD_GOAL = ("goal_in_collision", "no_path")

Asking: TypeAlias = Callable[[Body, BasePathRequest, type[BasePath]], Script[BasePath]]


def stances_at(place: Place, X_WS: SE3, *, before_edge_m: float) -> list[Stance]:
    """Stances from which one is at a place, best first, from where the robot stands.

    On a floor place: its middle, then spots around it, keeping the heading of arrival. At a
    surface: so far before the middle of each side, facing it, the nearest side first.
    """
    if place.floor:
        return _on_floor(place, X_WS)
    stances: list[Stance] = []
    half_x, half_y = 0.5 * place.size_m[0], 0.5 * place.size_m[1]
    for ux, uy, half_m in ((1, 0, half_x), (-1, 0, half_x), (0, 1, half_y), (0, -1, half_y)):
        out_m = half_m + before_edge_m
        x_m, y_m, _ = place.X_WP.apply((ux * out_m, uy * out_m, 0.0))
        yaw_rad = math.atan2(place.X_WP.p[1] - y_m, place.X_WP.p[0] - x_m)
        stances.append((float(x_m), float(y_m), yaw_rad))
    return _nearest_first(stances, X_WS)


def stances_around(p_W: Sequence[float], X_WS: SE3, *, distance_m: float) -> list[Stance]:
    """Stances on a circle around a point, facing it, the nearest first."""
    here_rad = math.atan2(X_WS.p[1] - p_W[1], X_WS.p[0] - p_W[0])
    stances: list[Stance] = []
    for i in range(DIRECTIONS):
        out_rad = here_rad + 2.0 * math.pi * i / DIRECTIONS
        x_m = p_W[0] + distance_m * math.cos(out_rad)
        y_m = p_W[1] + distance_m * math.sin(out_rad)
        stances.append((x_m, y_m, math.atan2(p_W[1] - y_m, p_W[0] - x_m)))
    return _nearest_first(stances, X_WS)


def stances_before(body: Body, person: PersonInfo, *, distance_m: float) -> list[Stance]:
    """Stances on a circle around a person, with nothing between them and the hands."""
    p_W = body.X_WPerson(person.id).p
    people = {other.id for other in body.map.people}
    things = [thing for thing in body.map.obstacles if thing.id not in people]
    return [
        stance
        for stance in stances_around(p_W, body.X_WS, distance_m=distance_m)
        if between(stance[:2], (p_W[0], p_W[1]), things, height_m=HAND_M) is None
    ]


def walk_to_any(body: Body, stances: Sequence[Stance], *, name: str) -> Script[Stance]:
    """Walk to the first stance that a wide way leads to, else any, else up to who closes the way.

    Gives up if there is none.
    """
    order = list(_roomy_first(body, stances))
    chosen, reasons = yield from _first_with_a_way(body, order, ask)
    if chosen is None and body.map.people:
        chosen, _ = yield from _first_with_a_way(body, order, ask_past_people)
    if chosen is not None:
        yield from walk_to(body, chosen)
        return chosen
    if len(reasons) == 1:
        raise reasons[0]
    raise give_up(
        "no_path",
        f"no free path leads to the {name}: tried {len(reasons)} places to stand",
        last=reasons[-1].failure.cause if reasons else "there is none",
    )


def _first_with_a_way(
    body: Body, stances: Sequence[Stance], asking: Asking
) -> Script[tuple[Stance | None, list[GaveUp]]]:
    """The first stance that a wide way leads to, else any; and why none leads to others."""
    reasons: list[GaveUp] = []
    squeezed: list[Stance] = []
    tried = 0
    for stance in stances:
        if tried == TRIES:
            break
        if any(math.dist(stance[:2], other[:2]) < ELSEWHERE_M for other in squeezed):
            continue
        tried += 1
        try:
            path = yield from asking(body, path_request(body, stance), BasePath)
        except GaveUp as end:
            if end.failure.code not in BAD_GOAL:
                raise
            reasons.append(end)
            continue
        if _between_ends_m(path) >= body.description.walking.room.passing_m:
            return stance, reasons
        squeezed.append(stance)
    return next(iter(squeezed), None), reasons


def _between_ends_m(path: BasePath) -> float:
    """The least clearance of a way, its first and last legs left out: they are as the ends are."""
    return min(path.clearances_m[1:-1], default=math.inf)


def has_room(body: Body, stance: Stance) -> bool:
    """Whether the body can turn there without its arms touching anything."""
    return _room_m(body, stance) >= body.description.walking.room.turning_m


def _room_m(body: Body, stance: Stance) -> float:
    """How far it is from the body's middle to what stands about, there."""
    things = (*body.map.obstacles, *body.world.unmapped)
    return min((clearance_m(stance[:2], thing) for thing in things), default=math.inf)


def heading_to(X_WS: SE3, x_m: float, y_m: float) -> float:
    """Heading on arrival at a point, where none is wanted: the way one comes, or as one stands."""
    dx, dy = x_m - X_WS.p[0], y_m - X_WS.p[1]
    return math.atan2(dy, dx) if math.hypot(dx, dy) > 0.3 else X_WS.yaw_rad


def _on_floor(place: Place, X_WS: SE3) -> list[Stance]:
    """The middle of a room or spot, then a grid over it, nearest to the middle first."""
    half_x, half_y = 0.5 * place.size_m[0], 0.5 * place.size_m[1]
    count_x, count_y = int(half_x / SPOT_GRID_M), int(half_y / SPOT_GRID_M)
    offsets = [
        (i * SPOT_GRID_M, j * SPOT_GRID_M)
        for i in range(-count_x, count_x + 1)
        for j in range(-count_y, count_y + 1)
    ]
    offsets.sort(key=lambda offset: (math.hypot(*offset), offset))
    stances: list[Stance] = []
    for x_m, y_m in offsets:
        x, y, _ = place.X_WP.apply((x_m, y_m, 0.0))
        stances.append((float(x), float(y), heading_to(X_WS, float(x), float(y))))
    return stances


def _nearest_first(stances: list[Stance], X_WS: SE3) -> list[Stance]:
    return sorted(stances, key=lambda stance: math.dist(stance[:2], X_WS.p[:2]))


def _roomy_first(body: Body, stances: Sequence[Stance]) -> Iterator[Stance]:
    """The same order, but places too narrow for the arms come last, the widest of them first."""
    narrow: list[tuple[float, Stance]] = []
    for stance in stances:
        room_m = _room_m(body, stance)
        if room_m >= body.description.walking.room.turning_m:
            yield stance
        else:
            narrow.append((room_m, stance))
    for _, stance in sorted(narrow, key=lambda pair: -pair[0]):
        yield stance
