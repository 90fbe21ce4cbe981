"""Ways in a home on which something may strike: straight ones, wide ones, those through a door."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from robot.planning import numerics
from robot.planning.numerics import Mask
from robot.reality.contract import Cast
from sim import atlas, furniture
from sim.footprint import Point
from sim.homes.home import STANDING_ROOM_M
from sim.homes.visitor import Visitor
from sim.world_schema import Door, Room, Spot

WALK_M, LONG_WALK_M = (1.6, 2.2), (2.5, 3.3)
"""Straight ahead: as in the bench, a stretch for what strikes on the way."""
WITHIN_M = 0.4
"""Of a spot the robot is there, as in the bench."""
IN_THE_WAY_M, AROUND_M = 1.3, 0.66
"""From the start to a chair that is pushed into the way; around its middle half a chair (0.22 m)
and what a path keeps from it where there is room (0.43 m)."""
BEFORE_DOOR_M, OFF_AXIS_M = (1.2, 2.2), 0.35
"""From a doorway to where the robot starts to go through it, and how far off its axis."""
IN_DOOR_M = 0.55
"""Around somebody in a doorway: doors are 1 m wide at most, so nobody gets by."""


class Lanes:
    """Ways of a visitor, drawn from its seed."""

    def __init__(self, visitor: Visitor) -> None:
        """Look for nothing yet."""
        self.visitor, self.ground = visitor, visitor.home.ground

    def straight(self) -> Cast:
        """A spot with a name, and a short and a long way straight to it."""
        best = nobody(("goal", "walk", "at_goal", "long_walk"), "no straight way leads to a spot")
        for spot in self.visitor.shuffled(self.visitor.world.spots):
            start = next(self._starts(spot, WALK_M), None)
            far = next(self._starts(spot, LONG_WALK_M), None)
            if start is None:
                continue
            roles = {"goal": spot.id, "walk": facing(start, spot.at_m), "at_goal": _at(spot)}
            if far is not None:
                return Cast({**roles, "long_walk": facing(far, spot.at_m)}, {})
            if not best.roles:
                best = Cast(roles, {"long_walk": "no long straight way leads to a spot"})
        return best

    def around(self) -> Cast:
        """A chair, and a straight way that leaves room to go around it."""
        names = ("chair", "wide_goal", "wide_walk", "at_wide_goal")
        chairs = [
            item
            for item in self.visitor.world.furniture
            if item.kind == "chair" and furniture.movable(item)
        ]
        if not chairs:
            return nobody(names, "there is no chair that can be pushed")
        for spot in self.visitor.shuffled(self.visitor.world.spots):
            for start in self._starts(spot, LONG_WALK_M):
                if self._leads_around(start, spot.at_m):
                    walk = facing(start, spot.at_m)
                    values = (self.visitor.pick(chairs).id, spot.id, walk, _at(spot))
                    return Cast(dict(zip(names, values, strict=True)), {})
        return nobody(names, "no straight way to a spot has room to go around a chair")

    def through_a_door(self) -> Cast:
        """A room that is reached by one doorway only from where the robot starts before it."""
        rooms = self.visitor.world.rooms
        for room, door in self.visitor.shuffled([(r, d) for r in rooms for d in r.doors]):
            middle = _middle(room, door)
            along = 0 if door.wall in ("north", "south") else 1
            without = self._without(middle, IN_DOOR_M)
            for start in self.points_around(middle, BEFORE_DOOR_M):
                if abs(start[along] - middle[along]) > OFF_AXIS_M:
                    continue
                beyond = self._beyond(start, middle, without)
                if beyond is not None and self._is_free(start, middle):
                    before = facing(start, middle)
                    in_room = {"robot_in": beyond.id}
                    return Cast(
                        {
                            "room": beyond.id,
                            "doorway": list(middle),
                            "before_door": before,
                            "in_room": in_room,
                        },
                        {},
                    )
        why = "no room is reached by one doorway only"
        return nobody(("room", "doorway", "before_door", "in_room"), why)

    def points_around(self, point: Point, far_m: tuple[float, float]) -> Iterator[Point]:
        """Points with room to stand on, so far from another (from, to), in any order."""
        cells = np.argwhere(self.ground.home & (self.ground.clearance_m >= STANDING_ROOM_M))
        points = self.ground.points(cells)
        lengths = np.hypot(*(points - np.array(point)).T)
        near = points[(lengths >= far_m[0]) & (lengths <= far_m[1])]
        for index in self.visitor.rng.permutation(len(near)).tolist():
            x, y = near[index].tolist()
            yield round(x, 2) + 0.0, round(y, 2) + 0.0

    def _starts(self, spot: Spot, far_m: tuple[float, float]) -> Iterator[Point]:
        """Where nothing is between somebody and a spot."""
        starts = self.points_around(spot.at_m, far_m)
        return (start for start in starts if self._is_free(start, spot.at_m))

    def _is_free(self, start: Point, goal: Point) -> bool:
        count = 2 + math.ceil(40 * math.dist(start, goal))
        points = np.linspace(np.array(start), np.array(goal), count).tolist()
        return all(self.ground.home[self.ground.cell((x, y))] for x, y in points)

    def _leads_around(self, start: Point, goal: Point) -> bool:
        """Whether there is a way beside a chair that stands before who has set out."""
        share = IN_THE_WAY_M / math.dist(start, goal)
        chair = (start[0] + share * (goal[0] - start[0]), start[1] + share * (goal[1] - start[1]))
        labels = numerics.regions(self._without(chair, AROUND_M))
        own = labels[self.ground.cell(start)]
        return bool(own and own == labels[self.ground.cell(goal)])

    def _beyond(self, start: Point, middle: Point, without: Mask) -> Room | None:
        """The room behind a doorway, if no other way leads there from before it."""
        world = self.visitor.world
        name = atlas.room_at(world, (2 * middle[0] - start[0], 2 * middle[1] - start[1]))
        if not name or name == atlas.room_at(world, start):
            return None
        index = next(number for number, room in enumerate(world.rooms) if room.id == name)
        labels = numerics.regions(without)
        own = labels[self.ground.cell(start)]
        inside = labels[self.ground.home & (self.ground.room == index)]
        return world.rooms[index] if own and len(inside) and own not in inside else None

    def _without(self, point: Point, radius_m: float) -> Mask:
        """The floor of the home, less what is near a point."""
        cells = np.argwhere(self.ground.home)
        near = np.hypot(*(self.ground.points(cells) - np.array(point)).T) < radius_m
        left = self.ground.home.copy()
        left[tuple(cells[near].T)] = False
        return left


def nobody(roles: tuple[str, ...], why: str) -> Cast:
    """These roles are vacant."""
    return Cast({}, dict.fromkeys(roles, why))


def facing(start: Point, to: Point) -> list[float]:
    """A start that looks at a point: x, y [m], heading [deg]."""
    yaw_rad = math.atan2(to[1] - start[1], to[0] - start[0])
    return [*start, round(math.degrees(yaw_rad), 1)]


def _at(spot: Spot) -> dict[str, object]:
    return {"at": list(spot.at_m), "within_m": WITHIN_M}


def _middle(room: Room, door: Door) -> Point:
    """Of a doorway, on the floor within its wall."""
    along = 0 if door.wall in ("north", "south") else 1
    sign = 1.0 if door.wall in ("north", "east") else -1.0
    at = list(room.at_m)
    at[along] += door.at_m
    at[1 - along] += sign * (room.size_m[1 - along] + atlas.WALL_M) / 2
    return round(at[0], 3), round(at[1], 3)
