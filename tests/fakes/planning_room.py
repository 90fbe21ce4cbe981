"""A room for planners: a table, a shelf with three boards, a chair, walls; and a cup."""

from __future__ import annotations

import math

from robot.messages import Obstacle, Place, Shape, WorldMap
from robot.planning.requests import Held, ObjectPose, Surroundings
from robot.se3 import SE3

CUP = Shape(kind="cylinder", size_m=(0.07, 0.07, 0.10))
TABLE_AT = (1.5, 0.8)
TABLE_M = (0.60, 1.20, 0.70)
BOARDS_M = (0.60, 0.87, 1.14)
START = (0.0, 0.0, 0.0)


def block(name: str, x: float, y: float, size: tuple[float, float, float]) -> Obstacle:
    """A box that stands on the floor."""
    shape = Shape(kind="box", size_m=size, X_BodyShape=SE3((0.0, 0.0, size[2] / 2)))
    return Obstacle(id=name, name=name, X_WO=SE3((x, y, 0.0)), shapes=(shape,))


def table() -> tuple[Obstacle, Place]:
    """A top on four legs."""
    depth, width, height = TABLE_M
    top = Shape(
        kind="box", size_m=(depth, width, 0.03), X_BodyShape=SE3((0.0, 0.0, height - 0.015))
    )
    legs = tuple(
        Shape(
            kind="box",
            size_m=(0.05, 0.05, height - 0.03),
            X_BodyShape=SE3((a * (depth / 2 - 0.06), b * (width / 2 - 0.06), (height - 0.03) / 2)),
        )
        for a in (1, -1)
        for b in (1, -1)
    )
    x, y = TABLE_AT
    body = Obstacle(id="table", name="table", X_WO=SE3((x, y, 0.0)), shapes=(top, *legs))
    place = Place(
        id="table", name="table", X_WP=SE3((x, y, height)), size_m=(depth, width), of="table"
    )
    return body, place


def shelf() -> tuple[Obstacle, tuple[Place, ...]]:
    """Three boards between two sides and a back, open towards -x."""
    depth, width, panel, height = 0.30, 0.90, 0.02, BOARDS_M[-1]
    inner = width - 2 * panel

    def part(x: float, y: float, z: float, size: tuple[float, float, float]) -> Shape:
        return Shape(kind="box", size_m=size, X_BodyShape=SE3((x, y, z)))

    sides = [part(0, s * (width - panel) / 2, height / 2, (depth, panel, height)) for s in (1, -1)]
    back = part((panel - depth) / 2, 0, height / 2, (panel, inner, height))
    boards = [part(0, 0, z - panel / 2, (depth, inner, panel)) for z in BOARDS_M]
    X_WO = SE3.from_xy_yaw(3.3, -1.2, math.pi)
    places = tuple(
        Place(
            id=f"board_{i}",
            name=f"board {i}",
            X_WP=X_WO @ SE3((panel / 2, 0.0, z)),
            size_m=(depth - panel, inner),
            clearance_m=(BOARDS_M[i + 1] - panel - z) if i + 1 < len(BOARDS_M) else 2.0,
            of="shelf",
        )
        for i, z in enumerate(BOARDS_M)
    )
    body = Obstacle(id="shelf", name="shelf", X_WO=X_WO, shapes=(*sides, back, *boards))
    return body, places


def room(*more: Obstacle) -> WorldMap:
    """The map: 6 m by 6 m."""
    (table_body, table_place), (shelf_body, boards) = table(), shelf()
    walls = (
        block("north wall", 1.0, 2.95, (6.0, 0.1, 2.2)),
        block("south wall", 1.0, -2.95, (6.0, 0.1, 2.2)),
        block("east wall", 3.95, 0.0, (0.1, 6.0, 2.2)),
        block("west wall", -1.95, 0.0, (0.1, 6.0, 2.2)),
    )
    chair = block("chair", 0.8, -0.8, (0.42, 0.42, 0.45))
    return WorldMap(
        stamp_s=0.0,
        name="room",
        obstacles=(table_body, shelf_body, chair, *walls, *more),
        places=(table_place, *boards),
        objects=(),
        people=(),
        categories={},
        bounds_m=(-2.0, -3.0, 4.0, 3.0),
    )


def on_table(x: float, y: float, *, name: str = "cup", shape: Shape = CUP) -> ObjectPose:
    """A thing on the table, at x, y from its middle."""
    at = SE3((TABLE_AT[0] + x, TABLE_AT[1] + y, TABLE_M[2] + shape.size_m[2] / 2))
    return ObjectPose(id=name, X_WO=at, shape=shape)


def surroundings(*objects: ObjectPose, more: tuple[Obstacle, ...] = ()) -> Surroundings:
    """The room with these things in it."""
    return Surroundings(map=room(*more), objects=objects)


def held_cup() -> Held:
    """A cup in the middle of the hand, upright when the hand is level."""
    return Held(id="cup", shape=CUP, X_GO=SE3())
