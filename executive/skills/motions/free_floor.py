"""Floor that is free to stand on, near enough to step there without a planned path."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from executive.skills.motions.body_access import Body
from executive.skills.motions.obstructions import clearance_m, may_step
from executive.skills.motions.personal_space import somebody_near
from robot.messages import Obstacle, PersonInfo
from robot.se3 import SE3

BACK_RAD = math.pi
ROUND_RAD = tuple(BACK_RAD + sign * k * math.pi / 6.0 for k in range(7) for sign in (1.0, -1.0))
"""Directions from the robot's heading: straight back first, ahead last."""
STEPS_M = (0.30, 0.20, 0.10)
"""The first that is free is taken: with 30 cm a hand comes out from among things."""


def may_stand(body: Body, point: Sequence[float], *, but: PersonInfo | None = None) -> bool:
    """Whether the body can stand at a point: inside the map, nobody near, nothing in its radius.

    What is within its radius already must not come nearer. `but` may be near.
    """
    return _may_be(body, point, but=but) and may_step(
        (body.X_WS.p[0], body.X_WS.p[1]),
        (point[0], point[1]),
        things_around(body),
        radius_m=body.description.body_radius_m,
    )


def nearest_thing(body: Body, point: Sequence[float]) -> tuple[Obstacle | None, float]:
    """What stands nearest to a point of the floor, and how far from it [m]."""
    found = [(clearance_m((point[0], point[1]), thing), thing) for thing in things_around(body)]
    distance_m, thing = min(found, key=lambda pair: pair[0], default=(math.inf, None))
    return thing, distance_m


def free_stance(
    body: Body, *, towards_rad: Iterable[float] = (BACK_RAD,), wide: bool = False
) -> SE3 | None:
    """A stance a step away, with the same heading; None where there is none.

    Args:
        body: of the robot, where it stands.
        towards_rad: directions from its heading, in the order in which they are tried.
        wide: whether everything has to be out of its radius there, what is within it now too.
    """
    radius_m = body.description.body_radius_m
    for direction_rad in towards_rad:
        for step_m in STEPS_M:
            there = body.X_WS @ SE3(
                (step_m * math.cos(direction_rad), step_m * math.sin(direction_rad), 0.0)
            )
            if not may_stand(body, there.p):
                continue
            if not wide or nearest_thing(body, there.p)[1] >= radius_m:
                return there
    return None


def things_around(body: Body) -> tuple[Obstacle, ...]:
    """What stands around; people are where they are seen, not where the map has them."""
    people = {person.id for person in body.map.people}
    fixed = tuple(thing for thing in body.map.obstacles if thing.id not in people)
    return (*fixed, *body.world.unmapped)


def _may_be(body: Body, point: Sequence[float], *, but: PersonInfo | None) -> bool:
    x_min, y_min, x_max, y_max = body.map.bounds_m
    inside = x_min < point[0] < x_max and y_min < point[1] < y_max
    return inside and somebody_near(body, point) in (None, but)
