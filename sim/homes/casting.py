"""Who plays what in a home when things go wrong on purpose: the roles of a campaign's cases.

At home (`executive/evaluation/campaign.yaml`) each role is written by hand; elsewhere it is drawn
from the seed of the home, among what the robot can reach there.
"""

from __future__ import annotations

import math
import zlib
from collections.abc import Iterator
from typing import Any

import msgspec
import numpy as np

from robot.reality.contract import Cast
from sim import atlas
from sim.footprint import Point
from sim.homes.home import Home
from sim.homes.lanes import Lanes, facing, nobody
from sim.homes.surfaces import Surface
from sim.homes.visitor import Visitor
from sim.world_schema import Object

OFF_M, ASIDE_M, AWAY_M = 0.09, 0.16, 0.28
"""How far a thing is moved so that the hand misses it, to another spot, and away from the hand that
draws it in: as in the bench, so that the same fault is the same everywhere."""
LIFT_M = 0.002
"""That it is lifted by where it is moved: it must not begin within the surface."""
GAP_M, DROPPED_M = 0.05, 0.10
"""Of free surface around where a thing is moved to: what hands need between two; and around what is
dropped where it stood, as it comes down from some centimetres and not quite there."""
FROM_THING_M = (0.9, 2.5)
"""From the start to where one stands to take the thing: in sight, and a few steps away."""
FROM_FRONT_M, APART_M = 0.125, 0.12
"""From the front of a surface to the middles of two things that have taken the place, and between
them: as in the bench."""
THINGS = ("thing", "at_thing", "off_m", "aside_m", "away_m")
TAKEN = ("other", "another", "spot", "spot_too")


def cast(home: Home, seed: int) -> Cast:
    """Fill the roles; the same home and seed give the same.

    Those that nothing in the home can play are vacant, with the reason.
    """
    rng = np.random.default_rng([seed, zlib.crc32(home.world.name.encode()), 0xFA17])
    visitor = Visitor(home, rng)
    lanes = Lanes(visitor)
    somebody = Cast({"person": visitor.pick(home.world.people).id}, {})
    families = (
        _things(visitor, lanes), lanes.straight(), lanes.around(), lanes.through_a_door(), somebody,
    )  # fmt: skip
    return Cast(
        {role: value for family in families for role, value in family.roles.items()},
        {role: why for family in families for role, why in family.vacant.items()},
    )


def _things(visitor: Visitor, lanes: Lanes) -> Cast:
    """A thing with room around it, where to begin, and what it is put on."""
    best: tuple[Object, dict[str, Any]] | None = None
    for item, roles in _candidates(visitor, lanes):
        if best is None or len(roles) > len(best[1]):
            best = item, roles
        if len(roles) == len(THINGS):
            break
    if best is None:
        return nobody((*THINGS, "to", *TAKEN), "there is no room to begin before any surface")
    item, roles = best
    target = _target(visitor, item)
    why = f"nothing has room around it for that; the {item.title} has most"
    vacant = {role: why for role in THINGS if role not in roles}
    return Cast({**roles, **target.roles}, {**vacant, **target.vacant})


def _candidates(visitor: Visitor, lanes: Lanes) -> Iterator[tuple[Object, dict[str, Any]]]:
    """Things in sight of where one can begin, each with the roles that it fills."""
    for item in visitor.shuffled(visitor.objects):
        surface, at = visitor.surface_of(item), item.at_m or (0.0, 0.0)
        stand = surface.standing(at)
        starts = lanes.points_around(stand, FROM_THING_M) if stand else ()
        inside = (start for start in starts if atlas.room_at(visitor.world, start) == surface.room)
        begin = next(inside, None)
        if stand is not None and begin is not None:
            at_thing = facing(begin, surface.point(at))
            yield item, {"thing": item.id, "at_thing": at_thing, **_moves(visitor, item, stand)}


def _moves(visitor: Visitor, item: Object, stand: Point) -> dict[str, Any]:
    """Where a thing may be moved to, in the world's axes; what there is no room for is left out.

    In is away from who stands there. What falls from the hand is to land on the surface: boards of
    shelves are too shallow for that (0.3 m).
    """
    surface, at = visitor.surface_of(item), item.at_m or (0.0, 0.0)
    yaw = surface.place.X_WP.yaw_rad
    others = [one for one in visitor.on(surface) if one is not item]
    X, Y = surface.point(at)
    ahead, left = _turned((X - stand[0], Y - stand[1]), -yaw)
    into = (math.copysign(1.0, ahead), 0.0)
    if abs(left) > abs(ahead):
        into = (0.0, math.copysign(1.0, left))
    directions = (into, (into[1], into[0]), (-into[1], -into[0]), (-into[0], -into[1]))

    def to(far_m: float) -> list[float] | None:
        """By how much in the world, in the first direction in which there is room."""
        for u, v in directions:
            there = (at[0] + far_m * u, at[1] + far_m * v)
            if surface.takes(item, there, others, gap_m=GAP_M):
                return [*_turned((far_m * u, far_m * v), yaw), LIFT_M]
        return None

    found: dict[str, Any] = {"off_m": to(OFF_M), "aside_m": to(ASIDE_M)}
    if surface.item.kind != "shelf" and surface.takes(item, at, others, gap_m=DROPPED_M):
        found["away_m"] = [*_turned((AWAY_M * into[0], AWAY_M * into[1]), yaw), 0.0]
    return {role: by_m for role, by_m in found.items() if by_m is not None}


def _target(visitor: Visitor, item: Object) -> Cast:
    """What a thing is put on, and what takes the place there: the nearest surface that will do."""
    stand = visitor.by(item)
    tops = [s for s in visitor.targets([item]) if s.item.kind not in ("shelf", "box")]
    near = sorted(tops, key=lambda one: visitor.home.ground.walk_m(stand, visitor.at(one)))
    if not near:
        return nobody(("to", *TAKEN), "no other surface has room for the thing")
    for surface in near:
        taken = _taken(visitor, item, surface)
        if taken:
            return Cast({"to": surface.place.id, **taken}, {})
    why = "no surface has room for two things in front and one more"
    return Cast({"to": near[0].place.id}, dict.fromkeys(TAKEN, why))


def _taken(visitor: Visitor, item: Object, surface: Surface) -> dict[str, Any]:
    """Two things that take the front, and leave room for a third; nothing where none do."""
    there = visitor.on(surface)
    ahead_m = round(surface.place.size_m[0] / 2 - FROM_FRONT_M, 3)
    spots = ((ahead_m, 0.0), (ahead_m, -APART_M))
    placed: list[Object] = []
    for other in visitor.shuffled(visitor.objects):
        at = spots[len(placed)]
        is_spare = other is not item and other not in there
        if is_spare and surface.takes(other, at, [*there, *placed], gap_m=LIFT_M):
            placed.append(msgspec.structs.replace(other, on=surface.place.id, at_m=at))
        if len(placed) == len(spots):
            break
    if len(placed) < len(spots) or not surface.free_spots([item], [*there, *placed]):
        return {}
    values = (placed[0].id, placed[1].id, list(spots[0]), list(spots[1]))
    return dict(zip(TAKEN, values, strict=True))


def _turned(by_m: Point, yaw_rad: float) -> Point:
    c, s = math.cos(yaw_rad), math.sin(yaw_rad)
    x, y = by_m
    return round(c * x - s * y, 3) + 0.0, round(s * x + c * y, 3) + 0.0
