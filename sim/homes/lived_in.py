"""What homes have where people live: odd boards, deep tables with chairs, things on their side.

Also flat things, somebody in a doorway, and a robot that begins close to a wall.
"""

from __future__ import annotations

import math

import msgspec
import numpy as np

from robot.se3 import Vector3
from sim import atlas
from sim.footprint import Point
from sim.homes.catalogue import HomeKind, PieceKind
from sim.homes.draws import one_of, shuffled
from sim.homes.ground import Ground, outlines
from sim.world_schema import Furniture, Object, Person, Room, World

FLAT = ("remote control", "stopwatch", "wallet", "pencil case", "tape measure")
"""Goods that lie flat: people leave them in any room."""
DEEPER, DEEPEST_M = (0.9, 1.4), 0.90
BAR, BAR_M = 0.15, (1.02, 1.10)
"""How likely a counter is as high as a bar, and how high that is."""
FIRST_BOARD_M, BOARD_STEP_M, BOARDS, TOP_M = (0.20, 0.60), (0.26, 0.38), 5, 1.70
"""Of a shelf: the lowest, from one to the next, how many at most, and the highest of all."""
DRAWN_UP, CHAIR_M, GAP_M = 0.6, (0.42, 0.42, 0.85), (0.03, 0.20)
"""How likely a chair stands at a table, its size, and how far from the table's edge."""
IN_A_DOORWAY, INSIDE_M = 0.5, 0.30
"""How likely somebody stands in a doorway, and how far into the room."""
LIES = 0.25
"""How likely something long and round lies on its side."""
LONG = 1.5
CLOSE_M = (0.35, 0.42)
"""Of free floor around the start, from and to."""


def of_kind(kind: HomeKind, rng: np.random.Generator) -> HomeKind:
    """The same kind of home with furniture as odd as people's own, and flat things about."""
    rooms = tuple(
        msgspec.structs.replace(room, pieces=tuple(_own(piece, rng) for piece in room.pieces))
        for room in kind.rooms
    )
    everywhere = tuple(room.id for room in kind.rooms)
    goods = kind.goods | dict.fromkeys(FLAT, everywhere)
    return msgspec.structs.replace(kind, rooms=rooms, goods=goods)


def _own(piece: PieceKind, rng: np.random.Generator) -> PieceKind:
    depth, width, height = piece.size_m
    if piece.kind == "shelf":
        boards = [float(rng.uniform(*FIRST_BOARD_M))]
        step_m = float(rng.uniform(*BOARD_STEP_M))
        while len(boards) < BOARDS and boards[-1] + step_m < TOP_M:
            boards.append(boards[-1] + step_m)
        return msgspec.structs.replace(
            piece, boards_m=tuple(round(board_m, 2) for board_m in boards)
        )
    if piece.kind in ("table", "counter"):
        depth = min(round(depth * float(rng.uniform(*DEEPER)), 2), DEEPEST_M)
        if piece.kind == "counter" and rng.random() < BAR:
            height = float(rng.uniform(*BAR_M))
    size: Vector3 = (depth, width, height)
    return msgspec.structs.replace(piece, size_m=size)


def with_chairs(world: World, rng: np.random.Generator) -> World:
    """Chairs drawn up to tables where all rooms can still be walked to."""
    for table in world.furniture:
        if table.kind == "table" and rng.random() < DRAWN_UP:
            chair = _chair(table, rng)
            more = msgspec.structs.replace(world, furniture=(*world.furniture, chair))
            if _stands_free(world, chair) and _all_rooms(more):
                world = more
    return world


def _chair(table: Furniture, rng: np.random.Generator) -> Furniture:
    """Before one of the table's sides, facing it."""
    own = atlas.footprint(table)
    turn = float(one_of((0.0, 90.0, 180.0, 270.0), rng))
    along = 0 if turn in (0.0, 180.0) else 1
    far = own.half_m[along] + CHAIR_M[0] / 2 + float(rng.uniform(*GAP_M))
    free = max(0.0, own.half_m[1 - along] - CHAIR_M[1] / 2)
    aside = float(rng.uniform(-free, free))
    towards = own.yaw_rad + math.radians(turn)
    c, s = math.cos(towards), math.sin(towards)
    at = (
        round(table.at_m[0] + c * far - s * aside, 2),
        round(table.at_m[1] + s * far + c * aside, 2),
    )
    yaw_deg = round(math.degrees(math.remainder(towards + math.pi, 2 * math.pi)))
    return Furniture(
        id=f"{table.id}_chair", kind="chair", at_m=at, size_m=CHAIR_M, yaw_deg=float(yaw_deg),
        color=table.color,
    )  # fmt: skip


def _stands_free(world: World, chair: Furniture) -> bool:
    own, room = atlas.footprint(chair), atlas.room_at(world, chair.at_m)
    floors = [atlas.room_footprint(entry) for entry in world.rooms if entry.id == room]
    return any(floor.contains(own) for floor in floors) and not any(
        own.overlaps(other) for other in outlines(world)
    )


def _all_rooms(world: World) -> bool:
    ground = Ground(world)
    return all(
        (ground.home & (ground.room == index)).sum() >= 80 for index in range(len(world.rooms))
    )


def in_a_doorway(
    world: World, people: tuple[Person, ...], rng: np.random.Generator
) -> tuple[Person, ...]:
    """The same people, one of them perhaps in a doorway."""
    if rng.random() >= IN_A_DOORWAY:
        return people
    spots = [spot for room in world.rooms for spot in _doorways(room)]
    rest = people[1:]
    for spot in shuffled(spots, rng):
        apart = all(math.dist(spot, other.at_m) > 1.0 for other in rest)
        if apart and atlas.room_at(world, spot):
            return (msgspec.structs.replace(people[0], at_m=spot), *rest)
    return people


def _doorways(room: Room) -> list[Point]:
    """Points just inside of a room's doors."""
    found: list[Point] = []
    for door in room.doors:
        along = 0 if door.wall in ("north", "south") else 1
        sign = 1.0 if door.wall in ("north", "east") else -1.0
        at = [0.0, 0.0]
        at[along] = room.at_m[along] + door.at_m
        at[1 - along] = room.at_m[1 - along] + sign * (room.size_m[1 - along] / 2 - INSIDE_M)
        found.append((round(at[0], 2), round(at[1], 2)))
    return found


def on_its_side(item: Object, rng: np.random.Generator) -> Object:
    """Something long and round, perhaps lying."""
    if item.shape != "cylinder" or item.size_m[2] < LONG * item.size_m[0] or rng.random() >= LIES:
        return item
    if not atlas.shape_of(item).is_round:
        return item
    return msgspec.structs.replace(item, lies=True, yaw_deg=float(5 * rng.integers(-35, 37)))
