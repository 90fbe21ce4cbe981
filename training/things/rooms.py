"""Rooms of a few pieces of furniture: what things stand on, and what hides them."""

from __future__ import annotations

import colorsys
import math
from typing import NamedTuple

import mujoco
import numpy as np

from robot.se3 import SE3
from sim import furniture
from sim.assembly import set_light
from sim.paint import Paint
from sim.world_schema import Furniture
from training.things.splits import Rooms

BOX = mujoco.mjtGeom.mjGEOM_BOX
CYLINDER = mujoco.mjtGeom.mjGEOM_CYLINDER
HALF_M = 4.0
WOOD_SHARE, GREY_SHARE, WALL_SHARE = 0.35, 0.35, 0.7
LEAST_CLEARANCE_M = 0.22
SIZES_M: dict[str, tuple[tuple[float, float], tuple[float, float], tuple[float, float]]] = {
    "table": ((0.5, 1.0), (0.7, 1.8), (0.45, 0.80)),
    "counter": ((0.5, 0.7), (0.9, 2.4), (0.80, 0.95)),
    "shelf": ((0.25, 0.40), (0.6, 1.2), (0.9, 1.3)),
    "box": ((0.3, 0.6), (0.3, 0.8), (0.3, 1.0)),
    "cabinet": ((0.35, 0.55), (0.5, 1.2), (0.6, 1.0)),
    "sofa": ((0.8, 0.9), (1.4, 2.0), (0.75, 0.85)),
    "chair": ((0.40, 0.45), (0.40, 0.45), (0.80, 0.90)),
}
"""Depth, width, height: from and to."""


class Place(NamedTuple):
    """A level rectangle in the world: the middle of it, its extent, and the height above it."""

    X_WP: SE3
    size_m: tuple[float, float]
    clearance_m: float


def furnish(
    spec: mujoco.MjSpec, paint: Paint, rooms: Rooms, rng: np.random.Generator
) -> list[Place]:
    """Add floor, walls and furniture; where things may stand, the floor last."""
    set_light(spec, (-HALF_M, -HALF_M, HALF_M, HALF_M))
    floor = rooms.floors[int(rng.integers(len(rooms.floors)))]
    spec.worldbody.add_geom(
        type=BOX, size=[HALF_M, HALF_M, 0.05], pos=[0.0, 0.0, -0.05],
        material=paint.floor(floor, (2 * HALF_M, 2 * HALF_M)),
    )  # fmt: skip
    places: list[Place] = []
    along = -1.0
    for number in range(int(rng.integers(1, 4))):
        kind = rooms.furniture[int(rng.integers(len(rooms.furniture)))]
        size = tuple(float(rng.uniform(*limits)) for limits in SIZES_M[kind])
        assert len(size) == 3
        yaw = float(rng.normal(0.0, 0.15)) + (math.pi if rng.random() < 0.1 else 0.0)
        along += size[1] / 2
        X_WF = SE3.from_xy_yaw(float(rng.uniform(-0.3, 0.3)), along, yaw)
        along += size[1] / 2 + float(rng.choice((0.02, rng.uniform(0.1, 0.6))))
        boards = tuple(np.cumsum(rng.uniform(0.30, 0.45, 3)) + 0.1) if kind == "shelf" else ()
        item = Furniture(id=str(number), kind=kind, at_m=(0.0, 0.0), size_m=size, boards_m=boards)
        places += _stand(spec, paint, item, X_WF, rooms=rooms, rng=rng)
    if rng.random() < WALL_SHARE:
        wall = _paint(paint, "wall", rooms, rng)
        x = -float(rng.uniform(0.55, 1.2))
        spec.worldbody.add_geom(
            type=BOX, size=[0.05, HALF_M, 1.3], pos=[x - 0.05, 0.0, 1.3], material=wall
        )
        if rng.random() < 0.5:
            y = float(rng.choice((-1.4, along + 0.4)))
            spec.worldbody.add_geom(
                type=BOX, size=[1.0, 0.05, 1.3], pos=[x + 1.0, y, 1.3], material=wall
            )
    return [*places, Place(SE3((1.0, 0.0, 0.0)), (1.6, 2.5), furniture.OPEN_M)]


def _stand(
    spec: mujoco.MjSpec, paint: Paint, item: Furniture, X_WF: SE3, *, rooms: Rooms,
    rng: np.random.Generator,
) -> list[Place]:  # fmt: skip
    """Add a piece of furniture out of its form's parts; its places."""
    form = furniture.form(item)
    own = _paint(paint, f"furniture/{item.id}", rooms, rng)
    other = {part.color: _paint(paint, f"furniture/{item.id}/{part.color}", rooms, rng)
             for part in form.parts if part.color}  # fmt: skip
    for part in form.parts:
        x, y, z = (size / 2 for size in part.size_m)
        is_round = part.kind == "cylinder"
        spec.worldbody.add_geom(
            type=CYLINDER if is_round else BOX, size=[x, z, 0.0] if is_round else [x, y, z],
            pos=X_WF.apply(part.p), quat=X_WF.quat_wxyz, material=other.get(part.color, own),
        )  # fmt: skip
    return [
        Place(X_WF @ SE3(one.p), one.size_m, one.clearance_m)
        for one in form.surfaces
        if one.clearance_m >= LEAST_CLEARANCE_M
    ]


def _paint(paint: Paint, name: str, rooms: Rooms, rng: np.random.Generator) -> str:
    """A colour for a wall or a piece of furniture: wood, grey or white, or of the room's hues."""
    gloss = float(rng.uniform(0.0, 0.4))
    chance = rng.random()
    value = float(rng.uniform(0.15, 0.97))
    if chance < WOOD_SHARE:
        hue, saturation = float(rng.uniform(0.05, 0.11)), float(rng.uniform(0.25, 0.6))
    elif chance < WOOD_SHARE + GREY_SHARE:
        hue, saturation = float(rng.random()), float(rng.uniform(0.0, 0.08))
    else:
        hue, saturation = float(rng.uniform(*rooms.hues)), float(rng.uniform(0.15, 0.9))
    if rooms.hues[0] > 0.0:  # rooms to judge by: all are of their hues, even wood and grey
        hue = float(rng.uniform(*rooms.hues))
    r, g, b = colorsys.hsv_to_rgb(hue % 1.0, saturation, value)
    return paint.plain(name, (r, g, b), gloss=gloss)
