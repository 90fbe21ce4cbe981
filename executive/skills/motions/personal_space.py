"""People who are too near: nothing moves towards them, neither the feet nor a hand."""

from __future__ import annotations

import math
from collections.abc import Sequence

from executive.skills.motions.body_access import Body
from executive.skills.motions.obstructions import clearance_m
from executive.skills.motions.script import Script, give_up
from robot.messages import Obstacle, PersonInfo
from robot.person_distances import CLEAR_M, ZONE_M
from robot.se3 import SE3

BELIEVED_S = 10.0
"""Who was seen so lately is taken to be there still, unless the place was seen empty since."""
STAYS_S = 4.0
"""Who has been beyond the zone for so long stays there, even if nearer than `CLEAR_M`: a hand that
was swayed up to them by a step waited for its patience at 0.58 m, and gave up, three times."""
PATIENCE_S = 15.0
STEP_BACK = "Please step back a little."
"""What somebody who is near a hand is told."""
TOLD_AT_S = (1.5, 8.0)
"""When they are told so: some leave by themselves, some do not hear it at once."""


def somebody_near(
    body: Body, p_W: Sequence[float], *, towards_rad: float | None = None, within_m: float = ZONE_M
) -> PersonInfo | None:
    """Who was seen lately and is within a distance of a point of the floor, their outline counts.

    With `towards_rad` only those on that side of the point. The body's companion may be near.
    """
    for track in body.world.people:
        if track.X_WO is None or track.missing or track.id == body.companion:
            continue
        if body.now_s - track.seen_s > BELIEVED_S:
            continue
        person = body.map.person(track.id) or PersonInfo(id=track.id, name="a person", X_WO=SE3())
        dx, dy = track.X_WO.p[0] - p_W[0], track.X_WO.p[1] - p_W[1]
        ahead = towards_rad is None or dx * math.cos(towards_rad) + dy * math.sin(towards_rad) > 0.0
        if ahead and math.hypot(dx, dy) - person.radius_m < within_m:
            return person
    return None


def in_the_path(body: Body, towards_rad: float) -> Obstacle | None:
    """Who the body would walk into, as an obstacle."""
    person = somebody_near(body, body.X_WS.p, towards_rad=towards_rad)
    return None if person is None else as_obstacle(body, person)


def as_obstacle(body: Body, person: PersonInfo) -> Obstacle:
    """Somebody where they are believed to be, as what stands in the way."""
    at = next((t.X_WO for t in body.world.people if t.id == person.id and t.X_WO), person.X_WO)
    return Obstacle(id=person.id, name=person.name, X_WO=at, shapes=())


def get_familiar(body: Body) -> frozenset[str]:
    """Take what stands around now for furniture; what comes later may be somebody."""
    body.familiar = frozenset(thing.id for thing in body.world.unmapped)
    return body.familiar


def near_hand(body: Body, p_W: Sequence[float], *, within_m: float = ZONE_M) -> str | None:
    """Who is near a hand, by name; what has come since the feet rested counts as somebody."""
    person = somebody_near(body, p_W, within_m=within_m)
    if person is not None:
        return person.name
    familiar = get_familiar(body) if body.familiar is None else body.familiar
    for thing in body.world.unmapped:
        if thing.id not in familiar and clearance_m((p_W[0], p_W[1]), thing) < within_m:
            return "somebody"
    return None


def wait_for_room(body: Body, p_W: Sequence[float]) -> Script[None]:
    """Wait until nobody is near a hand any more, or comes nearer, and ask for room.

    Gives up with `person_near` after `PATIENCE_S`.
    """
    words, end_s = body.phase, body.now_s + PATIENCE_S
    near_s = body.now_s
    to_say = [body.now_s + after_s for after_s in TOLD_AT_S]
    while (name := near_hand(body, p_W, within_m=CLEAR_M)) is not None:
        body.phase = f"waiting for {name} to step back"
        if to_say and body.now_s >= to_say[0]:
            body.context.say(STEP_BACK)
            del to_say[0]
        if near_hand(body, p_W) is not None:
            near_s = body.now_s
        elif body.now_s - near_s > STAYS_S:
            break
        if body.now_s > end_s:
            raise give_up(
                "person_near",
                f"{name} stands within {ZONE_M:.1f} m while {words}",
                person=name,
                waited_s=PATIENCE_S,
            )
        yield
    body.phase = words
