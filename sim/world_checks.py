"""What is wrong with a world file beyond its types: every problem found, each with its cure."""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Collection, Iterable, Iterator
from itertools import islice
from typing import Any

import msgspec

from robot.files.config import MOST_PROBLEMS, nearest
from robot.messages import Place
from sim import atlas, furniture
from sim.footprint import Footprint, overlapping
from sim.palette import COLORS, FLOORS
from sim.placing import clear_of, radius_m
from sim.world_schema import Furniture, Object, Room, World

ROBOT_M = 0.20  # the feet; a start needs at least this much free floor


class Finding(msgspec.Struct, frozen=True):
    """A problem and its place in the file, `$.objects[2].on` for example."""

    where: str
    message: str
    suggestion: str = ""


def check(world: World) -> list[Finding]:
    """What is wrong, shallow first: geometry is only looked at when names are right."""
    return names(world) or geometry(world)


def names(world: World, *, unsure: Collection[str] | None = frozenset()) -> list[Finding]:
    """What is wrong with the words: ids, kinds, colours, and places that things are on.

    Args:
        world: types and ranges of all that is in it are right.
        unsure: ids of what has mistakes of its own: what is on it is not judged; None: nothing is.
    """
    return list(islice(itertools.chain(_words(world), _on(world, unsure)), MOST_PROBLEMS))


def geometry(world: World, *, whole: bool = True) -> list[Finding]:
    """What does not fit where it is.

    Args:
        world: its words are right.
        whole: whether all its rooms are in it; else nobody knows what is outside of them.
    """
    rooms = _rooms(world)
    standing = _standing(world, whole=whole) if world.rooms else iter(())
    return list(islice(itertools.chain(rooms, standing, _objects(world)), MOST_PROBLEMS))


def _entries(world: World) -> Iterator[tuple[str, Any]]:
    for group in ("rooms", "spots", "furniture", "objects", "people"):
        for index, item in enumerate(getattr(world, group)):
            yield f"$.{group}[{index}]", item


def _words(world: World) -> Iterator[Finding]:
    """Ids, kinds, colours, shapes, floors and categories that are known."""
    if not world.rooms:
        yield Finding("$.rooms", "a world needs at least one room")
    seen: dict[str, str] = {}
    for where, item in _entries(world):
        if not re.fullmatch(r"[a-z][a-z0-9_]*", item.id):
            hint = "lower case letters, digits and _, beginning with a letter"
            yield Finding(f"{where}.id", f"{item.id!r} cannot be an id", hint)
        if item.id in seen:
            yield Finding(f"{where}.id", f"id {item.id!r} is taken", f"see {seen[item.id]}")
        seen[item.id] = where.removeprefix("$.")
    for index, item in enumerate(world.furniture):
        where = f"$.furniture[{index}]"
        yield from _known(f"{where}.kind", "kind", item.kind, furniture.KINDS)
        yield from _known(f"{where}.color", "color", item.color or "gray", COLORS)
        if item.boards_m and item.kind in furniture.KINDS and item.kind != "shelf":
            yield Finding(f"{where}.boards_m", "only a shelf has boards")
    for index, item in enumerate(world.objects):
        where = f"$.objects[{index}]"
        yield from _known(f"{where}.color", "color", item.color, COLORS)
        yield from _known(f"{where}.shape", "shape", item.shape, ("box", "cylinder"))
        if world.categories and not item.kind:
            yield from _known(f"{where}.category", "category", item.category, world.categories)
    for index, item in enumerate(world.people):
        yield from _known(f"$.people[{index}].color", "color", item.color, COLORS)
    for index, item in enumerate(world.rooms):
        yield from _known(f"$.rooms[{index}].floor", "floor", item.floor, FLOORS)


def _known(where: str, what: str, name: str, valid: Iterable[str]) -> Iterator[Finding]:
    names = list(valid)
    if name not in names:
        yield Finding(where, f"unknown {what} {name!r}", nearest(name, names))


def _on(world: World, unsure: Collection[str] | None) -> Iterator[Finding]:
    """Places that things are on."""
    sound = tuple(item for item in world.furniture if item.kind in furniture.KINDS)
    doubted = {item.id for item in world.furniture} - {item.id for item in sound}
    places = atlas.places(msgspec.structs.replace(world, furniture=sound))
    doubted.update(unsure or ())
    for index, item in enumerate(world.objects):
        known = item.on in places or unsure is None
        if known or any(item.on == id_ or item.on.startswith(f"{id_}_") for id_ in doubted):
            continue
        text = f"{item.title} is on unknown place {item.on!r}"
        yield Finding(f"$.objects[{index}].on", text, nearest(item.on, list(places)))


def _rooms(world: World) -> Iterator[Finding]:
    rooms = world.rooms
    for index, other in overlapping([atlas.room_footprint(room) for room in rooms]):
        text = f"{rooms[index].title} overlaps {rooms[other].title}"
        yield Finding(f"$.rooms[{index}].at_m", text)
    for index, room in enumerate(rooms):
        yield from _doors(room, f"$.rooms[{index}]")


def _doors(room: Room, where: str) -> Iterator[Finding]:
    for index, door in enumerate(room.doors):
        here = f"{where}.doors[{index}]"
        if door.wall not in room.walls:
            hint = f"add {door.wall} to walls"
            yield Finding(f"{here}.wall", f"{room.title} has no {door.wall} wall", hint)
        along = room.size_m[0 if door.wall in ("north", "south") else 1]
        if abs(door.at_m) + door.width_m / 2 > along / 2:
            yield Finding(f"{here}.at_m", f"the door does not fit into a wall of {along:g} m")
        for other in room.doors[:index]:
            apart = abs(door.at_m - other.at_m) - (door.width_m + other.width_m) / 2
            if door.wall == other.wall and apart < 0.0:
                yield Finding(f"{here}.at_m", "the door overlaps another door of the same wall")


def _standing(world: World, *, whole: bool) -> Iterator[Finding]:
    """Furniture, people, spots and the start are on the floor of a room, and apart."""
    x_min, y_min, x_max, y_max = world.bounds_m
    half = ((x_max - x_min) / 2, (y_max - y_min) / 2)
    bounds = Footprint(((x_min + x_max) / 2, (y_min + y_max) / 2), half)
    limits = f"x {x_min:g} to {x_max:g}, y {y_min:g} to {y_max:g} m"
    for index, item in enumerate(world.furniture):
        where, own = f"$.furniture[{index}]", atlas.footprint(item)
        if whole and not bounds.contains(own):
            yield Finding(f"{where}.at_m", f"the {item.title} reaches outside the rooms", limits)
        yield from _boards(item, where)
    for index, other in overlapping([atlas.footprint(item) for item in world.furniture]):
        text = f"the {world.furniture[index].title} overlaps the {world.furniture[other].title}"
        yield Finding(f"$.furniture[{index}].at_m", text)
    points = [(f"$.people[{k}]", p.title, p.at_m, 0.2) for k, p in enumerate(world.people)]
    points += [(f"$.spots[{k}]", s.title, s.at_m, 0.0) for k, s in enumerate(world.spots)]
    bare = msgspec.structs.replace(world, people=())
    for where, name, at, radius in points:
        if whole and not atlas.room_at(world, at):
            yield Finding(f"{where}.at_m", f"{name} is outside every room", limits)
        elif blocker := clear_of(bare, at, radius):
            yield Finding(f"{where}.at_m", f"{name} overlaps {blocker}")
    if whole and not atlas.room_at(world, world.start.at_m):
        yield Finding("$.start.at_m", "the robot would start outside every room", limits)
    elif blocker := clear_of(world, world.start.at_m, ROBOT_M):
        yield Finding("$.start.at_m", f"the robot would start in {blocker}")


def _boards(item: Furniture, where: str) -> Iterator[Finding]:
    boards = item.boards_m
    if len(boards) > len(furniture.ORDINALS):
        yield Finding(f"{where}.boards_m", f"at most {len(furniture.ORDINALS)} boards")
    if any(high - low < 0.10 for low, high in itertools.pairwise(boards)):
        yield Finding(
            f"{where}.boards_m", "boards are listed from the lowest up, 0.1 m apart or more"
        )
    if item.size_m and boards and max(boards) > item.size_m[2]:
        yield Finding(f"{where}.boards_m", f"a board is above the shelf's {item.size_m[2]:g} m")


def _objects(world: World) -> Iterator[Finding]:
    places = atlas.places(world)
    there: dict[str, list[Object]] = {}
    for index, item in enumerate(world.objects):
        where = f"$.objects[{index}]"
        if item.on not in places:
            continue
        yield from _fits(item, places[item.on], where)
        beside = there.setdefault(item.on, [])
        for other in beside:
            if item.at_m and other.at_m:
                gap = math.dist(item.at_m, other.at_m) - radius_m(item) - radius_m(other)
                if gap < 0.0:
                    hint = f"they are {-gap * 100:.1f} cm too close"
                    yield Finding(f"{where}.at_m", f"{item.title} overlaps {other.title}", hint)
        beside.append(item)


def _fits(item: Object, place: Place, where: str) -> Iterator[Finding]:
    if item.shape == "cylinder" and item.size_m[0] != item.size_m[1]:
        hint = "size_m of a cylinder is [diameter, diameter, height]"
        yield Finding(f"{where}.size_m", f"{item.title} is not round", hint)
    if item.lies and item.shape != "cylinder":
        hint = "give a box the size it has as it lies"
        yield Finding(f"{where}.lies", f"{item.title} is a box, and only cylinders lie", hint)
    elif item.lies and not atlas.shape_of(item).is_round:
        yield Finding(f"{where}.lies", f"{item.title} is not round all about, and does not lie")
    if item.height_m > place.clearance_m:
        free = f"there are {place.clearance_m:.2f} m"
        yield Finding(f"{where}.size_m", f"{item.title} is too high for the {place.name}", free)
    x, y = item.at_m or (0.0, 0.0)
    room = [size / 2 - radius_m(item) for size in place.size_m]
    if abs(x) > room[0] or abs(y) > room[1]:
        hint = f"within {max(room[0], 0.0):.2f} and {max(room[1], 0.0):.2f} m of its middle"
        yield Finding(f"{where}.at_m", f"{item.title} does not fit there on the {place.name}", hint)
