"""Where things may lie in a home so that this robot gets at them, and what room is left there."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import msgspec
import numpy as np

from robot.messages import Place
from robot.se3 import Array
from sim import atlas
from sim.footprint import Point
from sim.homes.furnishing import HIGHEST_M, LOWEST_M, is_for_things
from sim.homes.ground import HALF_WAY_M, Ground
from sim.placing import radius_m
from sim.world_schema import Furniture, Object, World

DEEP_M = 0.35
"""How far in from an edge that can be stood at the middle of things may lie."""
HIGHEST_GRASP_M = 1.20
"""Of a hand: on the highest surface that is within reach (docs/worlds.md) stands nothing tall."""
REACH_M = DEEP_M + HALF_WAY_M + 0.05
"""From there to the nearest point of a way, its grid's cell included."""
RIM_M, BOARD_RIM_M = 0.05, 0.03
"""Between a thing and the edge of a surface, of a board: evaluations move it by up to 3 cm."""
HAND_M = 0.11
"""Of free surface around the middle of what is put down: half a hand and 4 cm (planning/place)."""
LIFT_M = 0.05
"""Of air above what is taken off a board."""


class Surface:
    """A place that things can lie on, and the floor that it is reached from."""

    def __init__(self, item: Furniture, place: Place, ground: Ground) -> None:
        """Find the floor before it."""
        self.place = place
        self.item = item
        self.room = place.room
        self._own = atlas.footprint(item)
        around = ground.within(self._own, math.hypot(*self._own.half_m) + REACH_M)
        if item.kind == "shelf" and len(around):
            yaw = self._own.yaw_rad
            ahead = (around - np.array(item.at_m)) @ np.array((math.cos(yaw), math.sin(yaw)))
            around = around[ahead > self._own.half_m[0]]
        self._around: Array = around

    @property
    def has_one_side(self) -> bool:
        """Whether everybody who is at it stands before its front."""
        yaw = self._own.yaw_rad
        ahead = (self._around - np.array(self.item.at_m)) @ np.array((math.cos(yaw), math.sin(yaw)))
        return bool(np.all(ahead > self._own.half_m[0]))

    def point(self, at_m: Point) -> Point:
        """A point of the surface as a point of the floor below it."""
        x, y, _ = self.place.X_WP.apply((*at_m, 0.0))
        return float(x), float(y)

    def standing(self, at_m: Point) -> Point | None:
        """Where somebody stands to reach a point of the surface; None where nobody does."""
        if not len(self._around):
            return None
        far_m = np.hypot(*(self._around - np.array(self.point(at_m))).T)
        best = int(np.argmin(far_m))
        if far_m[best] > REACH_M:
            return None
        x, y = self._around[best].tolist()
        return x, y

    def takes(self, item: Object, at_m: Point, others: Sequence[Object], *, gap_m: float) -> bool:
        """Whether a thing can lie there, that far from all others, and be reached."""
        own = radius_m(item)
        rim_m = BOARD_RIM_M if self.item.kind == "shelf" else RIM_M
        inside = all(
            abs(value) <= side / 2 - own - rim_m
            for value, side in zip(at_m, self.place.size_m, strict=True)
        )
        return (
            inside
            and item.height_m + LIFT_M <= self.place.clearance_m
            and self.place.X_WP.p[2] + item.height_m / 2 <= HIGHEST_GRASP_M
            and all(
                math.dist(at_m, other.at_m or at_m) - own - radius_m(other) >= gap_m
                for other in others
            )
            and self.standing(at_m) is not None
        )

    def free_spots(self, items: Sequence[Object], others: Sequence[Object]) -> int:
        """How many of these things find room beside the others, one after the other."""
        there = list(others)
        for count, item in enumerate(items):
            own = radius_m(item)
            gap_m = max(HAND_M - own, 0.05)
            spot = next(
                (at for at in self._grid() if self.takes(item, at, there, gap_m=gap_m)), None
            )
            if spot is None:
                return count
            there.append(msgspec.structs.replace(item, at_m=spot))
        return len(items)

    def _grid(self) -> Iterator[Point]:
        depth, width = self.place.size_m
        for y in np.arange(-width / 2 + 0.08, width / 2 - 0.07, 0.06).tolist():
            for x in np.arange(depth / 2 - 0.08, -depth / 2 + 0.07, -0.06).tolist():
                yield x, y


def surfaces(world: World, ground: Ground) -> list[Surface]:
    """All that can be reached, boards of shelves one by one."""
    items = {item.id: item for item in world.furniture if is_for_things(item)}
    places = atlas.places(world).values()
    found: list[Surface] = []
    for place in places:
        item = items.get(place.of)
        if item is None or (
            item.kind == "shelf" and len(item.boards_m) > 1 and place.id == item.id
        ):
            continue
        if LOWEST_M <= place.X_WP.p[2] <= HIGHEST_M:
            surface = Surface(item, place, ground)
            if surface.standing((0.0, 0.0)) or surface.standing((place.size_m[0] / 4, 0.0)):
                found.append(surface)
    return found
