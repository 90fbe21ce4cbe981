"""A wish for a home, with what is true once it is fulfilled."""

from __future__ import annotations

from typing import Any

import msgspec

from sim.homes.surfaces import Surface
from sim.homes.visitor import HANDLE_S, Visitor
from sim.world_schema import Object

Truth = dict[str, Any]

CARRY_S = 2 * HANDLE_S
SPOT_M = 0.9
"""Within which the robot is at a spot at the end."""
AWAY_M = 3.0
"""From somebody to what they are brought, at least; half of it from the start to where one goes."""


class Task(msgspec.Struct, frozen=True, kw_only=True):
    """A wish: `truth` are the checks that all hold once it is fulfilled."""

    kind: str
    say: str
    truth: list[Truth]
    person_s: int
    or_code: str = ""


def stands_on(item: Object, surface: Surface) -> Truth:
    """That a thing stands on a surface."""
    return {"object": item.id, "on": surface.place.id}


def carrying_s(visitor: Visitor, errands: list[tuple[Object, Surface]]) -> int:
    """Of a person who brings one thing after the other."""
    stops = [stop for item, target in errands for stop in (visitor.by(item), visitor.at(target))]
    return visitor.person_s(stops, doing_s=CARRY_S * len(errands))
