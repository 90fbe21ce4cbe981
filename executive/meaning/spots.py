"""Where on a surface "next to the bottle", "between them" or "the other end" is: points of it.

The planner of placing takes from them what is free and within reach.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from intents.goals import How, Part
from intents.relations import Body, Point, Viewpoint
from robot.messages import Place

Spot = tuple[float, float]
"""A point x, y in the world [m]."""

GAP_M = 0.05
"""Least free distance to the landmark: the planner keeps 4 cm to what stands there."""
RINGS_M = (0.0, 0.04, 0.08, 0.12)
"""Beyond that: 0.3 m from middle to middle is still next to it for a thing of 10 cm."""
DIRECTIONS = 24
ASIDE_RAD = math.radians(40.0)
"""How far off straight left is still to the left."""
MIDDLE = 0.25
"""Between two things: so much of the way to either side of the middle."""
ASIDE_M = (-0.08, -0.04, 0.0, 0.04, 0.08)
"""Off the line from one to the other: a hand that does not fit in there may fit beside it."""
END = 0.28
"""The end of a surface: so much of its length."""
EDGE_M = 0.12
"""The edge: the middle of a thing is so near to it, or nearer."""
GRID_M = 0.05


def beside(how: How, one: Body, radius_m: float, *, view: Viewpoint) -> tuple[Spot, ...]:
    """Points next to, left of, right of, behind or in front of a thing, the nearest first.

    Args:
        how: which of these.
        one: the thing.
        radius_m: of what is put there.
        view: left and behind are as seen from there.
    """
    x_m, y_m, _ = one.p_WO
    away_rad = math.atan2(y_m - view.y_m, x_m - view.x_m)
    turn = {"behind": 0.0, "left": 0.5 * math.pi, "in_front": math.pi, "right": -0.5 * math.pi}
    spots: list[Spot] = []
    for ring_m in RINGS_M:
        out_m = one.radius_m + radius_m + GAP_M + ring_m
        for n in range(DIRECTIONS):
            off_rad = 2.0 * math.pi * n / DIRECTIONS
            aside_rad = abs((off_rad + math.pi) % (2.0 * math.pi) - math.pi)
            if how != "near" and aside_rad > ASIDE_RAD:
                continue
            at_rad = away_rad + turn.get(how, 0.0) + off_rad
            spots.append((x_m + out_m * math.cos(at_rad), y_m + out_m * math.sin(at_rad)))
    return tuple(spots)


def nearest_to(landmark: Place, surface: Place) -> tuple[Spot, ...]:
    """Points of a surface, those that are nearest to a piece of furniture first."""
    found = _world(surface, _grid(surface))
    return tuple(sorted(found, key=lambda spot: away_m(spot, landmark)))


def gap_m(one: Place, surface: Place) -> float:
    """Free distance on the floor from a piece of furniture to a surface [m], to a grid's step."""
    return min(away_m(spot, one) for spot in _world(surface, _grid(surface)))


def away_m(spot: Spot, place: Place) -> float:
    """Distance on the floor from a point to the rectangle of a place [m]; 0 within it."""
    x, y, _ = place.X_WP.inverse().apply((*spot, place.X_WP.p[2]))
    outside = (max(0.0, abs(v) - 0.5 * size) for v, size in zip((x, y), place.size_m, strict=True))
    return math.hypot(*outside)


def between(one: Point, other: Point) -> tuple[Spot, ...]:
    """Points between two things, the middle first."""
    along = (other[0] - one[0], other[1] - one[1])
    length_m = max(math.hypot(*along), 1e-6)
    shares = [s * MIDDLE / 3 for s in range(-3, 4)]
    found = sorted(
        ((share * length_m, aside_m) for share in shares for aside_m in ASIDE_M),
        key=lambda off: math.hypot(*off),
    )
    x_m, y_m = (0.5 * (one[i] + other[i]) for i in (0, 1))
    ux, uy = along[0] / length_m, along[1] / length_m
    return tuple((x_m + a * ux - b * uy, y_m + a * uy + b * ux) for a, b in found)


def part_of(place: Place, part: Part, *, away_from: Spot, view: Viewpoint) -> tuple[Spot, ...]:
    """Points of the middle, the edge or an end of a surface.

    Args:
        place: the surface.
        part: which part of it.
        away_from: the other end is the one that is farther from there.
        view: the left end is as seen from there.
    """
    half = (0.5 * place.size_m[0], 0.5 * place.size_m[1])
    along = 0 if half[0] >= half[1] else 1
    grid = _grid(place)
    if part == "middle":
        return _world(place, [p for p in grid if math.hypot(*p) <= max(0.12, 0.2 * min(half))])
    if part == "edge":
        return _world(place, [p for p in grid if min(half[i] - abs(p[i]) for i in (0, 1)) < EDGE_M])
    sign = _end(place, part, along, away_from, view)
    least_m = (1.0 - 2.0 * END) * half[along]
    return _world(place, [p for p in grid if sign * p[along] >= least_m])


def _end(place: Place, part: Part, along: int, away_from: Spot, view: Viewpoint) -> float:
    """On which side of the middle the end is, along the longer axis: 1 or -1."""
    ends = [_world(place, [(s, 0.0) if along == 0 else (0.0, s)])[0] for s in (1.0, -1.0)]
    if part in ("left_end", "right_end"):
        left_m = [view.left_m((*end, 0.0)) for end in ends]
        sign = 1.0 if left_m[0] > left_m[1] else -1.0
        return sign if part == "left_end" else -sign
    far_m = [math.dist(end, away_from) for end in ends]
    sign = 1.0 if far_m[0] > far_m[1] else -1.0
    return -sign if part == "near_end" else sign


def _grid(place: Place) -> list[Spot]:
    counts = [max(1, round(size / GRID_M)) for size in place.size_m]
    axes = [
        [(n + 0.5) / count * size - 0.5 * size for n in range(count)]
        for count, size in zip(counts, place.size_m, strict=True)
    ]
    return [(x, y) for x in axes[0] for y in axes[1]]


def _world(place: Place, points: Iterable[Sequence[float]]) -> tuple[Spot, ...]:
    found = [place.X_WP.apply((x, y, 0.0)) for x, y in points]
    return tuple((float(x), float(y)) for x, y, _ in found)


def floor_end(room: Place, part: Part, view: Viewpoint) -> Spot:
    """The middle or an end of a room's floor, to stand there; seen from where the robot stands."""
    if part == "middle":
        return _world(room, [(0.0, 0.0)])[0]
    along = 0 if room.size_m[0] >= room.size_m[1] else 1
    sign = _end(room, part, along, (view.x_m, view.y_m), view)
    at_m = sign * max(0.0, 0.5 * room.size_m[along] - STAND_OFF_M)
    return _world(room, [(at_m, 0.0) if along == 0 else (0.0, at_m)])[0]


STAND_OFF_M = 0.7
"""From the wall at the end of a room: where a robot still turns."""
