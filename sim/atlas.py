"""What a world file says about places and obstacles, in world coordinates: the prior map."""

from __future__ import annotations

import math
from collections.abc import Sequence

from robot.messages import ObjectInfo, Obstacle, PersonInfo, Place, Shape, WorldMap
from robot.person_distances import PERSON_RADIUS_M
from robot.se3 import SE3
from sim import furniture
from sim.footprint import Footprint
from sim.things import catalogue
from sim.things.making import made
from sim.world_schema import Furniture, Object, Person, Room, World

WALL_M = 0.08
SPOT_M = 0.6


def world_map(world: World) -> WorldMap:
    """The prior map: where furniture, walls and people are, and what objects there are.

    It knows what objects look like, not where they are: that has to be seen.
    """
    return WorldMap(
        stamp_s=0.0,
        name=world.name,
        obstacles=tuple(obstacles(world)),
        places=tuple(places(world).values()),
        objects=tuple(_object_info(item) for item in world.objects),
        people=tuple(
            PersonInfo(
                id=p.id,
                name=p.title,
                X_WO=pose_of(p),
                radius_m=PERSON_RADIUS_M,
                synonyms=p.synonyms,
            )
            for p in world.people
        ),
        categories=categories(world),
        bounds_m=world.bounds_m,
        start_X_WS=start_pose(world),
    )


def start_pose(world: World) -> SE3:
    """X_WS where the robot's stance begins."""
    return SE3.from_xy_yaw(*world.start.at_m, math.radians(world.start.yaw_deg))


def pose_of(item: Furniture | Person) -> SE3:
    """X_WO of something that stands on the floor."""
    return SE3.from_xy_yaw(*item.at_m, math.radians(item.yaw_deg))


def footprint(item: Furniture) -> Footprint:
    """The rectangle that a piece of furniture covers."""
    depth, width, _ = furniture.size_m(item)
    return Footprint(item.at_m, (depth / 2, width / 2), math.radians(item.yaw_deg))


def room_footprint(room: Room) -> Footprint:
    """The rectangle of a room's floor."""
    return Footprint(room.at_m, (room.size_m[0] / 2, room.size_m[1] / 2))


def categories(world: World) -> dict[str, str]:
    """Every category, singular to plural; what the file leaves out gets an s."""
    named = {
        item.category: catalogue.plural(item.kind)
        if item.kind and catalogue.category(item.kind) == item.category
        else f"{item.category}s"
        for item in world.objects
    }
    return {**named, **world.categories}


def places(world: World) -> dict[str, Place]:
    """Every place by id: surfaces of furniture, then rooms and spots of the floor."""
    found = [place for item in world.furniture for place in _surfaces(world, item)]
    for room in world.rooms:
        found.append(
            Place(
                id=room.id,
                name=room.title,
                X_WP=SE3.from_xy_yaw(*room.at_m, 0.0),
                size_m=room.size_m,
                room=room.id,
                floor=True,
                synonyms=room.synonyms,
            )
        )
    for spot in world.spots:
        found.append(
            Place(
                id=spot.id,
                name=spot.title,
                X_WP=SE3.from_xy_yaw(*spot.at_m, math.radians(spot.yaw_deg)),
                size_m=(SPOT_M, SPOT_M),
                room=room_at(world, spot.at_m),
                floor=True,
                synonyms=spot.synonyms,
            )
        )
    return {place.id: place for place in found}


def room_at(world: World, point: tuple[float, float]) -> str:
    """Id of the room that a point of the floor lies in, or empty."""
    for room in world.rooms:
        if room_footprint(room).distance_m(point) <= 0.0:
            return room.id
    return ""


def obstacles(world: World) -> list[Obstacle]:
    """Furniture, walls and people as rigid bodies of primitives."""
    found = [
        Obstacle(
            id=item.id, name=item.title, X_WO=pose_of(item), movable=furniture.movable(item),
            shapes=tuple(
                Shape(kind=part.kind, size_m=part.size_m, X_BodyShape=SE3(part.p))
                for part in furniture.form(item).parts
            ),
        )
        for item in world.furniture
    ]  # fmt: skip
    found += [wall for room in world.rooms for wall in walls(room)]
    for person in world.people:
        size = (2 * PERSON_RADIUS_M, 2 * PERSON_RADIUS_M, person.height_m)
        middle = SE3((0.0, 0.0, person.height_m / 2))
        outline = Shape(kind="cylinder", size_m=size, X_BodyShape=middle)
        found.append(
            Obstacle(id=person.id, name=person.title, X_WO=pose_of(person), shapes=(outline,),
                     movable=True)
        )  # fmt: skip
    return found


def near_walls(room: Room, point: tuple[float, float], distance_m: float) -> bool:
    """Whether a point may be that near a room's walls: not far outside, nor deep inside."""
    u, v = (abs(a - b) for a, b in zip(point, room.at_m, strict=True))
    beyond = max(u - room.size_m[0] / 2, v - room.size_m[1] / 2)
    return -distance_m <= beyond <= distance_m + WALL_M


def walls(room: Room) -> list[Obstacle]:
    """One obstacle a wall, outside the room's rectangle, open where the doors are."""
    found: list[Obstacle] = []
    for side in room.walls:
        along = 0 if side in ("north", "south") else 1
        sign = 1.0 if side in ("north", "east") else -1.0
        middle = list(room.at_m)
        middle[1 - along] += sign * (room.size_m[1 - along] + WALL_M) / 2
        shapes: list[Shape] = []
        for low, high in _wall_pieces(room, side, room.size_m[along] / 2 + WALL_M):
            centre, size = [0.0, 0.0, room.wall_height_m / 2], [WALL_M] * 2 + [room.wall_height_m]
            centre[along], size[along] = (low + high) / 2, high - low
            X = SE3((centre[0], centre[1], centre[2]))
            shapes.append(Shape(kind="box", size_m=(size[0], size[1], size[2]), X_BodyShape=X))
        pose = SE3.from_xy_yaw(middle[0], middle[1], 0.0)
        name = f"{side} wall of the {room.title}"
        found.append(
            Obstacle(id=f"{room.id}_{side}_wall", name=name, X_WO=pose, shapes=tuple(shapes))
        )
    return found


def doorways(world: World) -> list[tuple[float, float]]:
    """The middles of all doorways [m]."""
    found: list[tuple[float, float]] = []
    for room in world.rooms:
        for door in room.doors:
            along = 0 if door.wall in ("north", "south") else 1
            sign = 1.0 if door.wall in ("north", "east") else -1.0
            middle = list(room.at_m)
            middle[along] += door.at_m
            middle[1 - along] += sign * (room.size_m[1 - along] + WALL_M) / 2
            found.append((middle[0], middle[1]))
    return found


def _wall_pieces(room: Room, side: str, half_m: float) -> list[tuple[float, float]]:
    """Intervals along a wall that are left when the doors are cut out."""
    gaps = sorted(
        (d.at_m - d.width_m / 2, d.at_m + d.width_m / 2) for d in room.doors if d.wall == side
    )
    edges = [-half_m, *(edge for gap in gaps for edge in gap), half_m]
    pieces = zip(edges[::2], edges[1::2], strict=True)
    return [(low, high) for low, high in pieces if high - low > 1e-3]


def _surfaces(world: World, item: Furniture) -> list[Place]:
    X_WO, found = pose_of(item), list[Place]()
    surfaces = furniture.form(item).surfaces
    levels = [surface.level for surface in surfaces if surface.level]
    for surface in surfaces:
        level = surface.level
        names = _board_names(item, level, levels) if level else [item.title, *item.synonyms]
        found.append(
            Place(
                id=f"{item.id}_{surface.level}" if surface.level else item.id,
                name=names[0],
                synonyms=tuple(names[1:]),
                X_WP=X_WO @ SE3(surface.p),
                size_m=surface.size_m,
                clearance_m=surface.clearance_m,
                of=item.id,
                room=room_at(world, item.at_m),
                kind=item.kind,
            )
        )
    return found


def _board_names(item: Furniture, level: str, levels: Sequence[str]) -> list[str]:
    """What one board is called: "lower shelf" of a shelf first, "bottom board" besides.

    Of more than three boards, which are counted, the first is the lower and the last the upper one.
    """
    also = {"lower": ("bottom",), "upper": ("top",), "middle": ("centre", "center")}
    if "lower" not in levels:
        also = {levels[0]: ("lower", "bottom"), levels[-1]: ("upper", "top")}
    nouns = (item.title, "board") if item.title == "shelf" else (item.title, "shelf", "board")
    words = (level, *also.get(level, ()))
    names = [f"{word} {noun}" for word in words for noun in nouns]
    return names + [f"{word} {synonym}" for word in words for synonym in item.synonyms]


def _object_info(item: Object) -> ObjectInfo:
    return ObjectInfo(
        id=item.id, name=item.title, category=item.category, color=item.color,
        shape=shape_of(item), mass_kg=item.mass_kg, synonyms=item.synonyms,
    )  # fmt: skip


def shape_of(item: Object) -> Shape:
    """What a planner knows of an object's form."""
    pieces = made(item.kind, item.variant).pieces if item.kind else ()
    kind = "cylinder" if item.shape == "cylinder" else "box"
    return Shape(kind=kind, size_m=item.size_m, pieces=pieces)
