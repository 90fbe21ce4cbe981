"""Where a simulated person can step to: free floor that they reach straight, or around one corner.

Who stands in a doorway steps back through it, and then aside.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

import msgspec

from sim import atlas
from sim.footprint import Point
from sim.placing import clear_of
from sim.world_schema import World

STEPS_M = (0.7, 0.9, 1.1, 1.4, 1.7)
CORNERS_M = (0.5, 0.8, 1.1)
"""How far off the corner of a way is."""
DIRECTIONS = 16
ROOM_M = 0.27
"""Of free floor around a person who stands or walks: shoulders are 0.46 m wide."""
SAMPLE_M = 0.10
ROBOT_M = 0.9
"""Between a person and the robot where they end up: the robot walks by at 0.5 m and more."""
BACK_M = 1.4
"""The same for who was told to step back: an arm reaches 0.5 m, and hands keep half a metre."""
WALKING_M = 0.65
"""Between them on the way: nobody walks into a robot to let it pass."""
LANE_M = 0.7
"""Between them and the line that the robot faces along, in front of it."""
WIDE_LANE_M = 1.3
"""The same for who is asked again soon: what the robot wants is not straight before it."""


class Around(msgspec.Struct, frozen=True):
    """What moves: the robot with its heading, and circles that others take up."""

    robot: Point
    heading_rad: float
    others: tuple[tuple[Point, float], ...] = ()


def way_out(
    world: World, at: Point, around: Around, *, apart_m: float = ROBOT_M, lane_m: float = LANE_M
) -> tuple[Point, ...]:
    """The way to the nearest spot out of the robot's way, that far from it; empty: there is none.

    Straight if possible, else around one corner.
    """
    bare = msgspec.structs.replace(world, people=())

    def free_spot(start: Point) -> Point | None:
        for spot in _candidates(start, around):
            clear = _is_out_of_the_way(spot, around, apart_m, lane_m)
            if clear and _is_free_way(bare, start, spot, around):
                return spot
        return None

    spot = free_spot(at)
    if spot is not None:
        return (spot,)
    for corner in _candidates(at, around, CORNERS_M):
        if _is_free_way(bare, at, corner, around):
            spot = free_spot(corner)
            if spot is not None:
                return (corner, spot)
    return ()


def in_the_way(at: Point, around: Around, *, within_m: float, lane_m: float = LANE_M) -> bool:
    """Whether somebody stands before the robot, or so near that it cannot turn."""
    far_m = math.dist(at, around.robot)
    ahead_m, aside_m = _in_lane(at, around)
    return far_m < ROBOT_M or (far_m < within_m and ahead_m > 0.0 and aside_m < lane_m)


def _candidates(at: Point, around: Around, steps_m: tuple[float, ...] = STEPS_M) -> Iterator[Point]:
    """Spots around, near ones first, and of those the farthest from the robot first."""
    for step_m in steps_m:
        angles = (2.0 * math.pi * k / DIRECTIONS for k in range(DIRECTIONS))
        spots = [(at[0] + step_m * math.cos(a), at[1] + step_m * math.sin(a)) for a in angles]
        yield from sorted(spots, key=lambda spot: -math.dist(spot, around.robot))


def _is_out_of_the_way(spot: Point, around: Around, apart_m: float, lane_m: float) -> bool:
    ahead_m, aside_m = _in_lane(spot, around)
    return math.dist(spot, around.robot) >= apart_m and (ahead_m < 0.0 or aside_m >= lane_m)


def _in_lane(spot: Point, around: Around) -> tuple[float, float]:
    """How far ahead of the robot and how far aside of its line a point is [m]."""
    dx, dy = spot[0] - around.robot[0], spot[1] - around.robot[1]
    cos, sin = math.cos(around.heading_rad), math.sin(around.heading_rad)
    return dx * cos + dy * sin, abs(dy * cos - dx * sin)


def _is_free_way(world: World, at: Point, spot: Point, around: Around) -> bool:
    """Whether nothing is on the straight line there, and it never comes nearer to the robot."""
    if not atlas.room_at(world, spot):  # on the way there are doorways, which are in no room
        return False
    least_m = min(WALKING_M, math.dist(at, around.robot) - 0.01)
    count = max(1, math.ceil(math.dist(at, spot) / SAMPLE_M))
    for k in range(1, count + 1):
        part = k / count
        point = (at[0] + part * (spot[0] - at[0]), at[1] + part * (spot[1] - at[1]))
        if math.dist(point, around.robot) < least_m:
            return False
        if clear_of(world, point, ROOM_M) or _touches(point, around.others):
            return False
    return True


def _touches(point: Point, others: Iterable[tuple[Point, float]]) -> bool:
    return any(math.dist(point, other) < ROOM_M + radius_m for other, radius_m in others)
