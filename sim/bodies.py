"""Walls, furniture and objects as MuJoCo bodies.

Friction and contact of what is grasped are the finger pads' (they have priority); these are for
standing on each other. Things that stand still are bodies without a joint, each its own, so that
collision looks only at what is near.
"""

from __future__ import annotations

from typing import Any

import mujoco

from robot.messages import Obstacle
from robot.se3 import SE3
from sim import atlas, furniture, thing_bodies
from sim.paint import Paint
from sim.things.making import made
from sim.world_schema import Furniture, Object

FLOOR_FRICTION = [0.9, 0.01, 0.0005]
WOOD_FRICTION = [0.5, 0.005, 0.0001]
OBJECT_FRICTION = [0.5, 0.005, 0.0005]
"""Sliding low enough that a cup slides before it tips. Rolling, in metres, is 1.4 % of the weight
at a cup's radius: hard round things on wood have 0.5 to 2 %."""
SLIDES, ROLLS = 3, 6
"""Dimensions of a contact (`condim`): with 3 nothing resists rolling, and a cup on its side rolled
at 6 cm/s until something stood in its way."""
BOX = mujoco.mjtGeom.mjGEOM_BOX
CYLINDER = mujoco.mjtGeom.mjGEOM_CYLINDER


def add_wall(spec: mujoco.MjSpec, wall: Obstacle, paint: Paint) -> None:
    """A wall, in geom group 1 so that a view can leave walls out."""
    body = _body(spec, f"wall/{wall.id}", wall.X_WO)
    for shape in wall.shapes:
        half = [size / 2 for size in shape.size_m]
        body.add_geom(
            type=BOX, size=half, pos=shape.X_BodyShape.p, material=paint.color("wall"),
            friction=WOOD_FRICTION, condim=3, group=1,
        )  # fmt: skip


def add_furniture(spec: mujoco.MjSpec, item: Furniture, paint: Paint) -> None:
    """A piece of furniture out of its form's parts; free to be pushed if it is movable."""
    body = _body(spec, f"furniture/{item.id}", atlas.pose_of(item))
    parts = furniture.form(item).parts
    free = furniture.movable(item)
    if free:
        _free(body, f"furniture/{item.id}")
    volume = sum(part.size_m[0] * part.size_m[1] * part.size_m[2] for part in parts)
    own = item.color or furniture.KINDS[item.kind].color
    for part in parts:
        x, y, z = (size / 2 for size in part.size_m)
        share = 8 * x * y * z / volume
        body.add_geom(
            type=CYLINDER if part.kind == "cylinder" else BOX,
            size=[x, z, 0.0] if part.kind == "cylinder" else [x, y, z],
            pos=part.p,
            material=paint.color(part.color or own),
            friction=WOOD_FRICTION,
            condim=3,
            mass=item.mass_kg * share if free else 0.0,
        )


def add_object(spec: mujoco.MjSpec, item: Object, X_WO: SE3, paint: Paint) -> None:
    """A free rigid body, its origin O in its middle."""
    body = _body(spec, f"object/{item.id}", X_WO)
    _free(body, f"object/{item.id}")
    if item.kind:
        thing_bodies.shape(body, spec, made(item.kind, item.variant, item.color), paint)
        return
    x, y, z = (size / 2 for size in item.size_m)
    body.add_geom(
        name=f"object/{item.id}",
        type=CYLINDER if item.shape == "cylinder" else BOX,
        size=[x, z, 0.0] if item.shape == "cylinder" else [x, y, z],
        mass=item.mass_kg,
        material=paint.color(item.color),
        friction=OBJECT_FRICTION,
        condim=ROLLS if item.shape == "cylinder" else SLIDES,
    )
    _dress(body, item, paint)


def _dress(body: mujoco.MjsBody, item: Object, paint: Paint) -> None:
    """Thin films that say what an object is: the hollow of a cup, cap and label of a bottle."""
    x, y, z = (size / 2 for size in item.size_m)
    film = 0.0004
    white = paint.color("white")
    if item.category in ("cup", "mug", "glass", "bowl"):
        _show(body, CYLINDER, [0.85 * x, film, 0], z, paint.color("charcoal"))
    elif item.category in ("bottle", "can") and item.shape == "cylinder":
        _show(body, CYLINDER, [x + film, 0.22 * z, 0], -0.1 * z, white)
        _show(body, CYLINDER, [0.45 * x, film, 0], z, white)
    elif item.shape == "box":
        _show(body, BOX, [x + film, y + film, 0.12 * z], 0.45 * z, white)


def _show(
    body: mujoco.MjsBody, kind: mujoco.mjtGeom, half_m: list[float], z_m: float, material: str
) -> None:
    """Add a geom that is only to look at."""
    body.add_geom(
        type=kind, size=half_m, pos=[0, 0, z_m], material=material,
        contype=0, conaffinity=0, mass=0.0,
    )  # fmt: skip


def _body(spec: mujoco.MjSpec, name: str, pose: SE3) -> mujoco.MjsBody:
    return spec.worldbody.add_body(name=name, pos=pose.p, quat=pose.quat_wxyz)


def _free(body: Any, name: str) -> None:
    """Let a body move."""
    body.add_freejoint(name=name)


SILL, BUMP = "sill", "bump"
SILL_HALF_HEIGHT_M = 0.1


def add_sills(spec: mujoco.MjSpec) -> None:
    """What a fault can put into the robot's way; until then it lies under the floor."""
    for name, half_width_m, half_depth_m in ((SILL, 0.6, 0.03), (BUMP, 0.06, 0.06)):
        body = spec.worldbody.add_body(name=name, mocap=True, pos=[0.0, 0.0, -1.0])
        body.add_geom(
            type=mujoco.mjtGeom.mjGEOM_BOX,
            size=[half_depth_m, half_width_m, SILL_HALF_HEIGHT_M],
            friction=FLOOR_FRICTION,
            condim=3,
            rgba=[0.55, 0.42, 0.3, 1.0],
            mass=0.0,
        )
