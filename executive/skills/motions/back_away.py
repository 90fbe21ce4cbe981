"""Backing away from somebody: the feet make room for an arm, or for them to come out."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from executive.skills.motions.body_access import Body
from executive.skills.motions.final_steps import step_to
from executive.skills.motions.free_floor import may_stand, nearest_thing, things_around
from executive.skills.motions.obstructions import may_step
from executive.skills.motions.personal_space import somebody_near
from executive.skills.motions.planning import stance_of
from executive.skills.motions.script import Script
from robot.messages import PersonInfo, Side
from robot.person_distances import CLEAR_M, ZONE_M
from robot.se3 import SE3

STEP_M, MOST_M = 0.1, 0.8
"""How finely distances are tried, and how far it backs at most: an arm's length and the zone."""
SPARE_M = 0.05
"""More than is needed: steps end a few centimetres off, and people sway."""
TURNS_RAD = (0.0, 0.5, -0.5, 1.0, -1.0, 1.4, -1.4)
"""Directions that are tried, beside straight away from them: never towards them."""
WAY_OUT_M = (1.0, 0.8, 0.65)
"""Between a person's outline and the body, tried in turn: they come out of a doorway past it."""


def back_away(body: Body, side: Side, *, swing_m: float = 0.0) -> Script[None]:
    """Step back until nobody is near a hand, if somebody is; slowly, facing as before.

    The hand is about to come out by `swing_m`, towards whoever is there. Where there is no free
    floor to step to, it stays: the arm then waits for them to step back.
    """
    person = somebody_near(body, body.p_WE(side), within_m=ZONE_M + swing_m)
    if person is None:
        return
    clear_m = CLEAR_M + SPARE_M + swing_m
    yield from _step_back(body, person, _retreat(body, body.p_WE(side), person, clear_m=clear_m))


def make_way(body: Body, person: PersonInfo) -> Script[bool]:
    """Step back from who stands in the way and does not leave: they may have no room to.

    As far as there is free floor for it, if it is not as far as they need, and room beside it for
    arms that sway. Says whether it did.
    """
    room_m = body.description.body_radius_m + body.description.walking.room.beside_m
    for clear_m in WAY_OUT_M:
        X_WS_goal = _retreat(body, body.X_WS.p, person, clear_m=clear_m, room_m=room_m)
        if X_WS_goal is not None:
            yield from _step_back(body, person, X_WS_goal)
            return True
    return False


def _step_back(body: Body, person: PersonInfo, X_WS_goal: SE3 | None) -> Script[None]:
    if X_WS_goal is None:
        return
    before, body.phase = body.phase, f"stepping back from {person.name}"
    yield from step_to(body, stance_of(X_WS_goal))
    body.phase = before


def _retreat(
    body: Body, p_W: Sequence[float], person: PersonInfo, *, clear_m: float, room_m: float = 0.0
) -> SE3 | None:
    """The nearest stance at which what is at a point now is clear of them; straight back first.

    With `room_m` free about it, and on the way there no less than that or than there is now.
    """
    X_WS, hand = body.X_WS, p_W
    x_m, y_m, _ = body.X_WPerson(person.id).p
    away_rad = math.atan2(X_WS.p[1] - y_m, X_WS.p[0] - x_m)
    for turn_rad in TURNS_RAD:
        cos, sin = math.cos(away_rad + turn_rad), math.sin(away_rad + turn_rad)
        for back_m in _distances():
            there = (hand[0] + back_m * cos, hand[1] + back_m * sin)
            free_m = math.dist(there, (x_m, y_m)) - person.radius_m
            point = (X_WS.p[0] + back_m * cos, X_WS.p[1] + back_m * sin)
            if not may_stand(body, point, but=person):
                break
            if free_m >= clear_m and _has_room(body, point, room_m=room_m):
                return SE3((*point, 0.0), X_WS.quat_wxyz)
    return None


def _has_room(body: Body, point: Sequence[float], *, room_m: float) -> bool:
    """Whether a stance and the way there have room for arms that sway.

    Steps aside are fewer and done before the others: the way leads around a corner.
    """
    if nearest_thing(body, point)[1] < room_m:
        return False
    X_WS = body.X_WS
    aside_m = (X_WS.inverse() @ SE3((point[0], point[1], 0.0))).p[1]
    x_m, y_m, _ = (X_WS @ SE3((0.0, aside_m, 0.0))).p
    return may_step(
        (X_WS.p[0], X_WS.p[1]), (x_m, y_m), things_around(body),
        radius_m=max(room_m, body.description.body_radius_m),
    )  # fmt: skip


def _distances() -> Iterator[float]:
    return (k * STEP_M for k in range(1, round(MOST_M / STEP_M) + 1))
