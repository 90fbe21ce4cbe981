"""Furniture for the rooms of a home: along walls or free, doors and fronts kept clear."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import msgspec
import numpy as np

from robot.se3 import Vector3
from sim import atlas, furniture
from sim.footprint import Footprint, Point
from sim.homes.catalogue import PieceKind, RoomKind
from sim.homes.draws import one_of, shuffled
from sim.homes.ground import outlines
from sim.world_schema import Furniture, Room, Side, World

TRIES = 120
DOORSTEP_M = 0.95
"""Of floor before a door, on both sides of it, that nothing stands on."""
FRONT_M = 0.85
"""Of floor before what things are put on: the robot stands off 0.25 m and more to raise its arm."""
BESIDE_M = 0.04
AISLE_M = 1.25
"""Around what stands free: a way, and somebody at work beside it."""
LOWEST_M, HIGHEST_M, DEEPEST_M = 0.55, 1.15, 0.90
"""Of what this robot reaches (docs/worlds.md); what is deep it reaches from more than one side."""
HOLDING = ("table", "counter", "shelf", "cabinet", "box")
FACING: dict[Side, int] = {"north": -90, "east": 180, "south": 90, "west": 0}
BOARDS_APART_CM = (28, 34)
"""Of a shelf's boards: 0.25 m free above each, and their thickness."""
IN_A_CORNER, ASKEW = 0.4, 0.15
"""How likely what stands at a wall stands in its corner, and what stands free is turned oddly."""
WOODS = ("oak", "walnut", "white", "gray", "cream", "brown")


@dataclass
class _Room:
    """A room that is being furnished, and what must not be stood on in it."""

    entry: Room
    floor: Footprint
    walls: list[Footprint]
    doorsteps: list[Footprint]
    pieces: list[Furniture]
    solid: list[Footprint]
    fronts: list[Footprint]


def furnished(
    rooms: Sequence[Room], kinds: Sequence[RoomKind], rng: np.random.Generator
) -> tuple[Furniture, ...]:
    """Furniture for each room; what finds no place in it is left out."""
    walls = outlines(World(name="", rooms=tuple(rooms)))
    doorsteps = [step for room in rooms for step in _doorsteps(room)]
    found: list[Furniture] = []
    for entry, kind in zip(rooms, kinds, strict=True):
        room = _Room(entry, atlas.room_footprint(entry), walls, doorsteps, [], [], [])
        wanted = [piece for piece in kind.pieces if rng.random() < piece.chance]
        wanted.sort(key=lambda piece: ("block", "wall", "free").index(piece.stands))
        for piece in wanted:
            _stand(room, piece, rng)
        found += room.pieces
    return tuple(found)


def is_for_things(item: Furniture) -> bool:
    """Whether things can be put on it that this robot can reach."""
    depth, _, height = furniture.size_m(item)
    if item.kind not in HOLDING or depth > DEEPEST_M:
        return False
    return item.kind == "shelf" or LOWEST_M <= height <= HIGHEST_M


def _stand(room: _Room, kind: PieceKind, rng: np.random.Generator) -> None:
    """Find a place for a piece or a block of them, and put it there."""
    if kind.stands == "block":
        names = shuffled(kind.names, rng)
        while len(names) >= 2:
            count = min(len(names), int(2 * rng.integers(1, 4)))
            block, names = names[:count], names[count:]
            if not _try(room, _blocks(room, kind, block, rng)):
                break
        return
    item = _sized(kind, rng)
    if kind.stands == "wall":
        _try(room, _along_walls(room, item, rng))
    else:
        _try(room, _anywhere(room, item, rng))


def _try(room: _Room, proposals: Iterator[tuple[list[Furniture], float]]) -> bool:
    """Take the first proposal that fits: pieces, and how far apart they want the others to be."""
    for pieces, apart_m in proposals:
        solid = [atlas.footprint(item) for item in pieces]
        fronts = [_front(item, atlas.footprint(item)) for item in pieces if is_for_things(item)]
        if _fits(room, solid, fronts, apart_m):
            room.pieces += pieces
            room.solid += solid
            room.fronts += fronts
            return True
    return False


def _fits(
    room: _Room, solid: Sequence[Footprint], fronts: Sequence[Footprint], apart_m: float
) -> bool:
    grown = [
        msgspec.structs.replace(own, half_m=(own.half_m[0] + apart_m, own.half_m[1] + apart_m))
        for own in solid
    ]
    return (
        all(room.floor.contains(own) for own in (*solid, *fronts))
        and not _meet(solid, (*room.doorsteps, *room.fronts))
        and not _meet(grown, room.solid)
        and not _meet(fronts, room.solid)
    )


def _meet(some: Sequence[Footprint], others: Sequence[Footprint]) -> bool:
    return any(one.overlaps(other) for one in some for other in others)


def _front(item: Furniture, own: Footprint) -> Footprint:
    """The floor before a piece."""
    yaw = math.radians(item.yaw_deg)
    far = own.half_m[0] + FRONT_M / 2
    middle = (item.at_m[0] + far * math.cos(yaw), item.at_m[1] + far * math.sin(yaw))
    return Footprint(middle, (FRONT_M / 2 - 0.01, max(own.half_m[1], 0.30)), yaw)


def _along_walls(
    room: _Room, item: Furniture, rng: np.random.Generator
) -> Iterator[tuple[list[Furniture], float]]:
    """Places with the back to a wall that is there over the whole width."""
    depth, width, _ = furniture.size_m(item)
    for _ in range(TRIES):
        side: Side = ("north", "east", "south", "west")[int(rng.integers(4))]
        along = 0 if side in ("north", "south") else 1
        sign = 1.0 if side in ("north", "east") else -1.0
        free = (room.entry.size_m[along] - width) / 2 - 0.05
        deep = room.entry.size_m[1 - along] / 2
        if free <= 0.0:
            continue
        off = float(rng.uniform(-free, free))
        if rng.random() < IN_A_CORNER:
            off = math.copysign(free, off)
        at = [0.0, 0.0]
        at[along] = room.entry.at_m[along] + off
        at[1 - along] = room.entry.at_m[1 - along] + sign * (
            deep - depth / 2 - float(rng.uniform(0.02, 0.05))
        )
        behind = [0.0, 0.0]
        behind[1 - along] = room.entry.at_m[1 - along] + sign * (deep + atlas.WALL_M / 2)
        ends: list[Point] = []
        for end in (-width / 2, 0.0, width / 2):
            behind[along] = at[along] + end
            ends.append((behind[0], behind[1]))
        if all(any(wall.distance_m(end) <= 0.0 for wall in room.walls) for end in ends):
            yield [_at(item, at[0], at[1], FACING[side])], BESIDE_M


def _anywhere(
    room: _Room, item: Furniture, rng: np.random.Generator
) -> Iterator[tuple[list[Furniture], float]]:
    """Places on the open floor; mostly square to the walls."""
    is_chair = item.kind == "chair"
    for _ in range(TRIES):
        x, y = _point(room, rng)
        askew = is_chair or rng.random() < ASKEW
        yaw = int(15 * rng.integers(-11, 13)) if askew else int(90 * rng.integers(-1, 3))
        yield [_at(item, x, y, yaw)], 0.06 if is_chair else 0.90


def _blocks(
    room: _Room, kind: PieceKind, names: list[str], rng: np.random.Generator
) -> Iterator[tuple[list[Furniture], float]]:
    """Places for pieces two and two, back to back, in a row of as many pairs as there are."""
    size = _sized(kind, rng)
    depth, width, _ = furniture.size_m(size)
    pairs = len(names) // 2
    for _ in range(TRIES):
        x, y = _point(room, rng)
        yaw = int(90 * rng.integers(0, 2))
        c, s = round(math.cos(math.radians(yaw))), round(math.sin(math.radians(yaw)))
        pieces: list[Furniture] = []
        for index, name in enumerate(names):
            along = (index // 2 - (pairs - 1) / 2) * (width + BESIDE_M)
            off = (depth / 2 + 0.02) * (1 if index % 2 == 0 else -1)
            at = (x + c * off - s * along, y + s * off + c * along)
            turned = yaw if index % 2 == 0 else 180 if yaw == 0 else yaw - 180
            piece = _at(size, at[0], at[1], turned)
            own = f"{name}_{kind.id}"
            pieces.append(msgspec.structs.replace(piece, id=own))
        yield pieces, AISLE_M


def _point(room: _Room, rng: np.random.Generator) -> Point:
    (x, y), (length, width) = room.entry.at_m, room.entry.size_m
    return (
        x + float(rng.uniform(-length / 2, length / 2)),
        y + float(rng.uniform(-width / 2, width / 2)),
    )


def _at(item: Furniture, x: float, y: float, yaw_deg: int) -> Furniture:
    at = (round(x, 2) + 0.0, round(y, 2) + 0.0)
    return msgspec.structs.replace(item, at_m=at, yaw_deg=yaw_deg)


def _sized(kind: PieceKind, rng: np.random.Generator) -> Furniture:
    """A piece in a size of its own: up to a tenth more or less, a shelf's boards drawn anew."""
    depth, width, height = kind.size_m
    width = _round(width * rng.uniform(0.88, 1.12), 0.05)
    height = _round(height * rng.uniform(0.96, 1.04), 0.01)
    boards = kind.boards_m
    if kind.boards and not boards:
        boards = tuple(height_cm / 100 for height_cm in _boards_cm(kind.boards, rng))
    if boards:
        has_roof = bool(rng.random() < 0.6)
        height = round(boards[-1] + (0.32 if has_roof else 0.0), 2)
    elif kind.kind in HOLDING and kind.size_m[2] <= HIGHEST_M:
        height = min(height, HIGHEST_M)
    size: Vector3 = (depth, width, height)
    color = kind.color
    if not color and kind.kind in ("table", "cabinet", "shelf", "chair"):
        color = one_of(WOODS, rng)
    return Furniture(
        id=kind.id, name=kind.name, synonyms=kind.synonyms, kind=kind.kind, at_m=(0.0, 0.0),
        size_m=size, boards_m=boards, color=color, movable=kind.movable,
    )  # fmt: skip


def _boards_cm(count: int, rng: np.random.Generator) -> list[int]:
    """Heights of boards, all within reach."""
    low, high = round(100 * LOWEST_M) + 1, round(100 * HIGHEST_M)
    least, most = BOARDS_APART_CM
    first = int(rng.integers(low, min(68, high - least * (count - 1)) + 1))
    step = int(rng.integers(least, min(most, (high - first) // max(1, count - 1)) + 1))
    return [first + index * step for index in range(count)]


def _round(value: float, step: float) -> float:
    return round(round(float(value) / step) * step, 2)


def _doorsteps(room: Room) -> list[Footprint]:
    """The floor on both sides of each of a room's doors."""
    found: list[Footprint] = []
    for door in room.doors:
        along = 0 if door.wall in ("north", "south") else 1
        sign = 1.0 if door.wall in ("north", "east") else -1.0
        middle, half = [0.0, 0.0], [0.0, 0.0]
        middle[along] = room.at_m[along] + door.at_m
        middle[1 - along] = room.at_m[1 - along] + sign * (
            room.size_m[1 - along] / 2 + atlas.WALL_M / 2
        )
        half[along] = door.width_m / 2 + 0.10
        half[1 - along] = DOORSTEP_M + atlas.WALL_M / 2
        found.append(Footprint((middle[0], middle[1]), (half[0], half[1])))
    return found
