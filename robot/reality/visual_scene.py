"""What a robot and its world look like: shapes on bodies, and how joints move these.

A value without an owner, as plain as can be, for whoever draws: it crosses to a browser as it is.
Frames: W world, B a body, G a shape of it. Poses are flat: x, y, z [m], and w, x, y, z of the
quaternion.
"""

from __future__ import annotations

from typing import Literal

import msgspec

Flat = tuple[float, float, float, float, float, float, float]
Rgba = tuple[float, float, float, float]
Kind = Literal["box", "sphere", "ellipsoid", "cylinder", "capsule", "mesh"]
Role = Literal["robot", "object", "person", "wall", "furniture", "floor"]


class Geom(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """A shape.

    `size_m` is as MuJoCo has it: half extents of a box; radii of an ellipsoid; radius and half
    length of a cylinder or a capsule (of what is between its caps); radius of a sphere. `mesh` is a
    place in `VisualScene.meshes`. `tile_m` and `rgba2` are of a checker on it, seen from above.
    """

    kind: Kind
    size_m: tuple[float, float, float]
    X_BG: Flat
    rgba: Rgba
    mesh: int = -1
    rgba2: Rgba | None = None
    tile_m: tuple[float, float] = (0.0, 0.0)


class Joint(msgspec.Struct, frozen=True, kw_only=True):
    """A hinge or a slide: `gain` times the position of a motor, along an axis at a point of B."""

    kind: Literal["hinge", "slide"]
    axis: tuple[float, float, float]
    at_m: tuple[float, float, float]
    motor: int
    gain: float = 1.0


class VisualBody(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """What moves as one.

    `id` is a name of the robot's, or the world's own of an object or a person. `X_PB` is its pose
    in its `parent` (a place in `VisualScene.bodies`, -1: the world) with all joints at 0; for the
    robot's base, objects and people it is where they begin.
    """

    id: str
    role: Role
    X_PB: Flat
    parent: int = -1
    name: str = ""
    joints: tuple[Joint, ...] = ()
    geoms: tuple[Geom, ...] = ()


class Mesh(msgspec.Struct, frozen=True, kw_only=True):
    """Triangles: `points_m` float32 x, y, z; `faces` uint32 triples of points; as bytes."""

    points_m: bytes
    faces: bytes


class Site(msgspec.Struct, frozen=True, kw_only=True):
    """A frame S that is fixed in a body: a place in `VisualScene.bodies`, and X_BS."""

    body: int
    X_BS: Flat


class Camera(Site, frozen=True, kw_only=True):
    """A camera, its frame as OpenCV has it (x right, y down, z forward), of square pixels."""

    fovy_rad: float
    width: int
    height: int


class VisualScene(msgspec.Struct, frozen=True, kw_only=True):
    """All of it; parents come before what hangs on them.

    `camera` and `lidar` are where the robot senses, `grasps` the grasp frames of its hands, by
    side; `sole_m` is half the length and half the width of a foot. `motor_names` and
    `torque_limits_nm` are in motor order (fingers in N). `base` is the place of the robot's base;
    `motors` is how many it has, and `posture` how they stand as it begins. `bounds_m` is (least x,
    least y, largest x, largest y) of the world.
    """

    bodies: tuple[VisualBody, ...]
    meshes: tuple[Mesh, ...]
    base: int
    motors: int
    posture: tuple[float, ...]
    bounds_m: tuple[float, float, float, float]
    camera: Camera
    lidar: Site
    grasps: dict[str, Site]
    sole_m: tuple[float, float]
    motor_names: tuple[str, ...]
    torque_limits_nm: tuple[float, ...]
