"""Looking closer at what has no name and may be what is looked for: from nearer, then elsewhere.

That a thing was not seen says nothing while something stands there that nobody has made out.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Sequence

from executive.skills.motions.body_access import Body
from executive.skills.motions.gaze import check_camera, turn_head
from executive.skills.motions.look_over import STARE_S, Until, walk_to_see
from executive.skills.motions.script import Script
from executive.skills.motions.support import stands_on, surface_under
from robot.messages import Place, Unnamed, WorldMap, WorldState
from robot.se3 import Vector3

SIDES = 2
"""A thing is looked at from so many places: from nearer, and from elsewhere."""
SAME_M = 0.1
"""What is seen so near to where something was looked at is that: a better look moves it."""
MOST = 6
"""So many things at most are looked at closer in one search."""
MOST_NAMES = 3


def unclear(
    world: WorldState, object_ids: Collection[str], places: Sequence[Place] = ()
) -> tuple[Unnamed, ...]:
    """What has no name and may be one of some objects.

    Args:
        world: what is believed.
        object_ids: what is asked about.
        places: surfaces that it stands on; none: anywhere.
    """
    return tuple(
        one
        for one in world.unnamed
        if not set(object_ids).isdisjoint(one.may_be)
        and (not places or any(stands_on(one.X_WO, place) for place in places))
    )


def unclear_words(things: Sequence[Unnamed], world_map: WorldMap) -> str:
    """As in "a white thing of 9 cm on the desk and a red thing of 12 cm"; "" for none."""
    words: list[str] = []
    for one in things[:MOST_NAMES]:
        place = surface_under(one.X_WO, world_map.places)
        article = "an" if one.words[:1] in "aeiou" else "a"
        words.append(f"{article} {one.words}" + (f" on the {place.name}" if place else ""))
    return " and ".join(words)


def look_closer(
    body: Body, object_ids: Collection[str], places: Sequence[Place], until: Until
) -> Script[bool]:
    """Look at each thing that may be one of the objects, until something is so.

    Returns whether it came to be so.

    Args:
        body: the robot.
        object_ids: what is asked about.
        places: surfaces that they are to stand on; none: anywhere.
        until: whether it is known by now.
    """
    looked_from: list[tuple[Vector3, tuple[float, float]]] = []
    while not until():
        thing = _next(body, unclear(body.world, object_ids, places), looked_from)
        if thing is None:
            return False
        at_W = thing.X_WO.p
        vain_m = next(_from(at_W, looked_from), body.X_WS.p[:2])
        body.phase = f"looking closer at the {thing.words}"
        if (yield from walk_to_see(body, at_W, until, vain_m=vain_m)) and not until():
            yield from _stare(body, at_W, until)
        looked_from.append((at_W, body.X_WS.p[:2]))
    return True


def _next(
    body: Body,
    things: Sequence[Unnamed],
    looked_from: Sequence[tuple[Vector3, tuple[float, float]]],
) -> Unnamed | None:
    """The nearest of those that were not looked at from all sides yet."""
    if len(looked_from) >= MOST * SIDES:
        return None
    left = [one for one in things if len(list(_from(one.X_WO.p, looked_from))) < SIDES]
    here = body.X_WS.p[:2]
    return min(left, key=lambda one: math.dist(one.X_WO.p[:2], here), default=None)


def _from(
    at_W: Vector3, looked_from: Sequence[tuple[Vector3, tuple[float, float]]]
) -> Iterator[tuple[float, float]]:
    """From where a thing was looked at, the last first."""
    return (stood for p_W, stood in reversed(looked_from) if math.dist(p_W, at_W) < SAME_M)


def _stare(body: Body, at_W: Vector3, until: Until) -> Script[None]:
    """Rest the eyes on a thing for some pictures."""
    yield from turn_head(body, at_W)
    check_camera(body)
    begin_s = body.now_s
    while body.now_s - begin_s < STARE_S and not until():
        yield
