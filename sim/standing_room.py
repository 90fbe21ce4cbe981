"""Where a simulated person can step to: free floor that they reach straight, or around one corner.

Who stands in a doorway steps back through it, and then aside. Nobody makes room before a door, or
between the robot and a door ahead of it, who can do so elsewhere: who wants to pass may want to
go through. Nor does anybody cross before the robot who can keep to their side of its way.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator

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


MIDDLE_M = 0.15
"""Who stands as near as this to the line ahead has no side yet."""
DOORSTEP_M = 0.9
"""From the middle of a doorway: who goes through comes as near as this to it, and turns there."""
DOOR_AHEAD_M = 4.0
"""As near as this is a door that somebody may want to go through."""


class Around(msgspec.Struct, frozen=True):
    """What moves: the robot with its heading, and circles that others take up."""

    robot: Point
    heading_rad: float
    others: tuple[tuple[Point, float], ...] = ()


def way_out(
    world: World, at: Point, around: Around, *, apart_m: float = ROBOT_M, lane_m: float = LANE_M
) -> tuple[Point, ...]:
    """The way to the nearest spot out of the robot's way, that far from it; empty: there is none.

    Straight if possible, else around one corner; across the robot's way only if nowhere else, and
    on the way to a door if there is no spot besides.
    """
    bare = msgspec.structs.replace(world, people=())
    doorways = atlas.doorways(world)

    def is_clear(spot: Point) -> bool:
        return _is_out_of_the_way(spot, around, apart_m, lane_m)

    def is_off_doors(spot: Point) -> bool:
        return is_clear(spot) and not any(_is_on_the_way(spot, door, around) for door in doorways)

    return (
        _way_to(is_off_doors, bare, at, around, own_side=True)
        or _way_to(is_off_doors, bare, at, around)
        or _way_to(is_clear, bare, at, around)
    )


def _is_on_the_way(spot: Point, door: Point, around: Around) -> bool:
    """Whether somebody would stand before a door, or between it and the robot that faces it."""
    if math.dist(spot, door) < DOORSTEP_M:
        return True
    ahead_m, _ = _in_lane(door, around)
    if ahead_m < 0.0 or math.dist(door, around.robot) > DOOR_AHEAD_M:
        return False
    heading_rad = math.atan2(door[1] - around.robot[1], door[0] - around.robot[0])
    along_m, aside_m = _in_lane(spot, msgspec.structs.replace(around, heading_rad=heading_rad))
    return 0.0 < along_m < math.dist(door, around.robot) and aside_m < LANE_M


def _way_to(
    will_do: Callable[[Point], bool],
    world: World,
    at: Point,
    around: Around,
    *,
    own_side: bool = False,
) -> tuple[Point, ...]:
    """The way to the nearest spot that will do, straight or around one corner.

    With `own_side` only where they are on the same side of the robot's way all along.
    """

    def may_be(spot: Point) -> bool:
        return not own_side or not _is_across(at, spot, around)

    def free_spot(start: Point) -> Point | None:
        spots = (spot for spot in _candidates(start, around) if will_do(spot) and may_be(spot))
        return next((spot for spot in spots if _is_free_way(world, start, spot, around)), None)

    spot = free_spot(at)
    if spot is not None:
        return (spot,)
    for corner in _candidates(at, around, CORNERS_M):
        if may_be(corner) and _is_free_way(world, at, corner, around):
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
    ahead_m, left_m = _from_robot(spot, around)
    return ahead_m, abs(left_m)


def _from_robot(spot: Point, around: Around) -> Point:
    """A point, ahead and to the left of the robot [m]."""
    dx, dy = spot[0] - around.robot[0], spot[1] - around.robot[1]
    cos, sin = math.cos(around.heading_rad), math.sin(around.heading_rad)
    return dx * cos + dy * sin, dy * cos - dx * sin


def _is_across(at: Point, spot: Point, around: Around) -> bool:
    """Whether a spot ahead of the robot is on the other side of its line than somebody is."""
    (_, left_m), (ahead_m, there_m) = _from_robot(at, around), _from_robot(spot, around)
    return abs(left_m) > MIDDLE_M and ahead_m > 0.0 and left_m * there_m < 0.0


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
