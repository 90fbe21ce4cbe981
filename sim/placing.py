"""Where things go that a world file leaves open, and random variations of a world."""

from __future__ import annotations

import math

import msgspec
import numpy as np

from robot.errors import ConfigError
from robot.messages import Place
from robot.person_distances import PERSON_RADIUS_M
from robot.se3 import SE3
from sim import atlas
from sim.footprint import Footprint, Point
from sim.things.making import made
from sim.world_schema import Object, Start, World

GAP_M = 0.10  # between objects that are drawn at random: room for a hand around each
FINGER_M = 0.05  # between objects that are moved a little: a finger, and air on both its sides
EDGE_M = 0.02  # from an object's side to the edge of its place
ROBOT_M = 0.40  # of floor that the robot wants around its stance to begin
TRIES = 2000
LYING = SE3.from_rpy(0.0, math.pi / 2, 0.0, (0.0, 0.0, 0.0))
"""Of a cylinder on its side: z along the heading."""


def radius_m(item: Object) -> float:
    """Radius of the circle around an object seen from above."""
    if item.kind:
        reach = made(item.kind, item.variant).radius_m
        return math.hypot(reach, item.size_m[2] / 2) if item.lies else reach
    if item.lies:
        return math.hypot(item.size_m[0], item.size_m[2]) / 2
    return item.size_m[0] / 2 if item.shape == "cylinder" else math.hypot(*item.size_m[:2]) / 2


def placed(world: World, rng: np.random.Generator) -> World:
    """The same world with a spot drawn for every object that has none.

    Raises:
        ConfigError: if a place is too full.
    """
    places = atlas.places(world)
    done = [item for item in world.objects if item.at_m is not None]
    for item in world.objects:
        if item.at_m is None:
            spot = _draw(item, places[item.on], [o for o in done if o.on == item.on], rng)
            done.append(msgspec.structs.replace(item, at_m=spot))
    order = {item.id: item for item in done}
    return msgspec.structs.replace(world, objects=tuple(order[o.id] for o in world.objects))


def object_poses(world: World) -> dict[str, SE3]:
    """X_WO of every object, O in its middle; every object must have a spot (`placed`)."""
    places = atlas.places(world)
    poses: dict[str, SE3] = {}
    for item in world.objects:
        x, y = item.at_m or (0.0, 0.0)
        X_PO = SE3.from_xy_yaw(x, y, math.radians(item.yaw_deg), z_m=item.height_m / 2)
        poses[item.id] = places[item.on].X_WP @ (X_PO @ LYING if item.lies else X_PO)
    return poses


def variation(world: World, seed: int, *, on: str = "table") -> World:
    """The same world, begun otherwise: the robot anywhere free, objects anywhere on a place.

    Args:
        world: what to vary.
        seed: of the draw; the same seed gives the same world.
        on: the objects of this place get other spots on it, and other headings.
    """
    rng = np.random.default_rng(np.random.SeedSequence([seed, 0x5EED]))
    objects = tuple(
        msgspec.structs.replace(o, at_m=None, yaw_deg=float(rng.uniform(-180.0, 180.0)))
        if o.on == on
        else o
        for o in world.objects
    )
    start = Start(at_m=_free_floor(world, rng), yaw_deg=float(rng.uniform(-180.0, 180.0)))
    return placed(msgspec.structs.replace(world, objects=objects, start=start), rng)


def nudged(
    world: World,
    seed: int,
    *,
    start: tuple[float, float, float] | None = None,
    by_m: float = 0.03,
    by_deg: float = 6.0,
) -> World:
    """The same world, begun a little otherwise: for many runs of one short mission.

    Args:
        world: what to vary.
        seed: of the draw; the same seed gives the same world.
        start: where the robot starts (x [m], y [m], heading [deg]) in place of the world's start.
        by_m: how far the robot, and every object with a spot, may be moved; what would come too
            near to another, or over an edge, stays where it is.
        by_deg: how far the robot may be turned; objects get any heading.
    """
    rng = np.random.default_rng(np.random.SeedSequence([seed, 0xD6E]))
    x_m, y_m, yaw_deg = start or (*world.start.at_m, world.start.yaw_deg)
    places = atlas.places(world)
    objects = list(world.objects)
    for index, item in enumerate(world.objects):
        dx, dy, yaw = (float(value) for value in rng.uniform(-1.0, 1.0, 3))
        if item.at_m is not None:
            moved = (item.at_m[0] + by_m * dx, item.at_m[1] + by_m * dy)
            others = [o for o in objects if o.on == item.on and o is not item]
            at_m = moved if _may_be_at(moved, item, places[item.on], others) else item.at_m
            objects[index] = msgspec.structs.replace(item, at_m=at_m, yaw_deg=180.0 * yaw)
    dx, dy, turn = (float(value) for value in rng.uniform(-1.0, 1.0, 3))
    begin = Start(at_m=(x_m + by_m * dx, y_m + by_m * dy), yaw_deg=yaw_deg + by_deg * turn)
    return msgspec.structs.replace(world, objects=tuple(objects), start=begin)


def clear_of(world: World, point: Point, radius_m: float) -> str | None:
    """What stands within `radius_m` of a point of the floor, None if nothing does."""
    for item in world.furniture:
        if atlas.footprint(item).distance_m(point) < radius_m:
            return f"the {item.title}"
    for person in world.people:
        if math.dist(person.at_m, point) < radius_m + PERSON_RADIUS_M:
            return person.title
    for room in world.rooms:
        if not atlas.near_walls(room, point, radius_m):
            continue
        for wall in atlas.walls(room):
            for shape in wall.shapes:
                middle = wall.X_WO.apply(shape.X_BodyShape.p)
                half = (shape.size_m[0] / 2, shape.size_m[1] / 2)
                box = Footprint((float(middle[0]), float(middle[1])), half)
                if box.distance_m(point) < radius_m:
                    return f"the {wall.name}"
    return None


def _free_floor(world: World, rng: np.random.Generator) -> Point:
    x_min, y_min, x_max, y_max = world.bounds_m
    for _ in range(TRIES):
        point = (float(rng.uniform(x_min, x_max)), float(rng.uniform(y_min, y_max)))
        inside = [
            min(half - abs(c) for half, c in zip(box.half_m, box.local(point), strict=True))
            for box in map(atlas.room_footprint, world.rooms)
        ]
        if max(inside) >= ROBOT_M and clear_of(world, point, ROBOT_M) is None:
            return point
    raise ConfigError(f"world {world.name!r} has no free floor for the robot to start on")


def _may_be_at(spot: Point, item: Object, place: Place, others: list[Object]) -> bool:
    """Whether an object stands whole on its place there, and a finger goes between any two."""
    own = radius_m(item)
    inside = (abs(v) <= side / 2 - own for v, side in zip(spot, place.size_m, strict=True))
    gaps = (math.dist(spot, o.at_m) - own - radius_m(o) for o in others if o.at_m is not None)
    return all(inside) and all(gap >= FINGER_M for gap in gaps)


def _draw(
    item: Object, place: Place, others: list[Object], rng: np.random.Generator
) -> tuple[float, float]:
    own = radius_m(item)
    room = [size / 2 - own - EDGE_M for size in place.size_m]
    if min(room) > 0.0:
        for _ in range(TRIES):
            spot = (float(rng.uniform(-room[0], room[0])), float(rng.uniform(-room[1], room[1])))
            gaps = (math.dist(spot, o.at_m or spot) - own - radius_m(o) for o in others)
            if all(gap >= GAP_M for gap in gaps):
                return spot
    raise ConfigError(f"there is no free spot on {place.name!r} for {item.title!r}")
