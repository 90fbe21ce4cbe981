"""What things stand or lie on: a sighting is off, from afar by centimetres, a surface is not.

A thing at rest seen just above or somewhat inside a surface is on it. Planners then do not find it
sunk into the table, and the hand grasps it at the height that was meant.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

import msgspec
import numpy as np

from executive.skills.motions.body_access import Body
from robot.messages import ObjectInfo, Place, Shape, Unnamed
from robot.planning.requests import ObjectPose, Surroundings
from robot.se3 import SE3, Array

NEAR_M = 0.02
"""A sighting is 5 mm off: what is seen so near to a surface is taken to stand on it."""
UPRIGHT_RAD = 0.2
OVERHANG_M = 0.02
LEAST_ON_M, ON_TOP_M = -0.05, 0.3
FROM_AFAR_M = 0.12
"""A camera that is taken to be level when it nods by 1.5 degrees (an IMU that sits askew, in the
reality `harsh`) sees what is 3 m away 0.08 m too low, and this much from 4.5 m. Nothing else is
there within that height, so it is taken to be on what is over it."""
TOUCHING_M = 0.01
"""Two things as near as this are taken to touch: where they stand is known that well."""


def supported(X_WO: SE3, info: ObjectInfo, places: tuple[Place, ...]) -> SE3:
    """The pose, moved up or down onto the surface that the object must be on, if any.

    What lies is turned level, too: the end of a newspaper that is seen askew is inside the table.
    What is neither upright nor lies, such as what is about to fall, is left as it is.
    """
    resting = _resting(X_WO, info.shape)
    if resting is None:
        return X_WO
    X_WO_level, bottom_m = resting
    x_m, y_m, z_m = X_WO_level.p
    above_m = [
        z_m + bottom_m - place.X_WP.p[2]
        for place in places
        if -FROM_AFAR_M < z_m + bottom_m - place.X_WP.p[2] < NEAR_M and _is_over(place, X_WO_level)
    ]
    if not above_m:
        return X_WO
    return SE3((x_m, y_m, z_m - min(above_m, key=abs)), X_WO_level.quat_wxyz)


def _resting(X_WO: SE3, shape: Shape) -> tuple[SE3, float] | None:
    """The pose of what is at rest, and its underside from there [m]; None: it is about to fall."""
    if tilt(X_WO) <= UPRIGHT_RAD:
        return X_WO, shape.X_BodyShape.p[2] - 0.5 * shape.size_m[2]
    return _lying(X_WO, shape)


def _lying(X_WO: SE3, shape: Shape) -> tuple[SE3, float] | None:
    """The pose of what lies on a side, or on its head, made level, and its underside from there.

    Of what is round the axis is level or upright, of a box one of its sides is below. None: none.
    """
    X_WShape = X_WO @ shape.X_BodyShape
    up = X_WShape.rotation()[2]
    level_up = np.zeros(3)  # what is up of the shape as it lies, in its own frame
    if shape.kind == "cylinder" and abs(up[2]) < math.sin(UPRIGHT_RAD):
        level_up[:2] = up[:2]
        half_m = 0.5 * shape.size_m[0]
    else:
        axis = int(np.argmax(np.abs(up)))
        level_up[axis] = up[axis]
        half_m = 0.5 * shape.size_m[axis]
    length = float(np.linalg.norm(level_up))
    if length < math.cos(UPRIGHT_RAD):
        return None
    R_level = _turned_up(X_WShape.rotation() @ (level_up / length)) @ X_WShape.rotation()
    level = SE3.from_rotation(R_level, X_WShape.p) @ shape.X_BodyShape.inverse()
    return level, X_WShape.p[2] - half_m - level.p[2]


def _turned_up(direction: Array) -> Array:
    """The least turn that brings a direction, not straight down, upright, shape (3, 3)."""
    x, y, z = (float(value) for value in direction)
    k = 1.0 / (1.0 + z)
    return np.array(
        [[1.0 - k * x * x, -k * x * y, -x], [-k * x * y, 1.0 - k * y * y, -y], [x, y, z]]
    )


def stands_on(X_WO: SE3, place: Place) -> bool:
    """Whether an object's middle is over a surface, at most `ON_TOP_M` above it.

    A flat thing that is seen from afar may be seen below it (`FROM_AFAR_M`).
    """
    above_m = _above_m(X_WO, place)
    return LEAST_ON_M <= above_m <= min(ON_TOP_M, place.clearance_m)


def surface_under(X_WO: SE3, places: Iterable[Place]) -> Place | None:
    """The surface that something stands on: the highest one right under it.

    If there is none, it is the one right above its middle, by no more than `FROM_AFAR_M`.
    """
    surfaces = [place for place in places if not place.floor]
    under = [place for place in surfaces if stands_on(X_WO, place)]
    if under:
        return max(under, key=lambda place: place.X_WP.p[2])
    above = [place for place in surfaces if -FROM_AFAR_M <= _above_m(X_WO, place) < 0.0]
    return min(above, key=lambda place: place.X_WP.p[2], default=None)


def rests_on(X_WO: SE3, info: ObjectInfo, place: Place) -> bool:
    """Whether an object's underside is at a surface, or at a floor: no hand holds it up."""
    bottom_m = X_WO.p[2] + info.shape.X_BodyShape.p[2] - 0.5 * info.shape.size_m[2]
    return stands_on(X_WO, place) and bottom_m - place.X_WP.p[2] < NEAR_M


def _above_m(X_WO: SE3, place: Place) -> float:
    """How far an object's middle is above a surface [m]; not a number if it is not over it."""
    x, y, z = (place.X_WP.inverse() @ X_WO).p
    inside = abs(x) <= 0.5 * place.size_m[0] and abs(y) <= 0.5 * place.size_m[1]
    return z if inside else math.nan


def pose_on_support(body: Body, object_id: str, X_WO: SE3) -> SE3:
    """`supported` with what the map knows."""
    return supported(X_WO, body.object_info(object_id), body.map.places)


def surroundings(body: Body, *ignored: str, unnamed: bool = False) -> Surroundings:
    """What a plan keeps clear of now; what the hands hold is not in the way.

    What has no name counts where something is to be put: what is to be taken may have parts that
    were seen apart from it.
    """
    held = tuple(held.object_id for held in body.context.holdings.all())
    around = Surroundings.of(body.map, body.world, ignored=(*held, *ignored))
    objects = tuple(
        msgspec.structs.replace(thing, X_WO=pose_on_support(body, thing.id, thing.X_WO))
        for thing in around.objects
    )
    if unnamed:
        others = (ObjectPose(id=one.id, X_WO=one.X_WO, shape=one.shape) for one in _unnamed(body))
        objects = (*objects, *others)
    return msgspec.structs.replace(around, objects=objects)


def _unnamed(body: Body) -> tuple[Unnamed, ...]:
    """What has no name, as far as it was seen from near by."""
    return tuple(one for one in body.world.unnamed if one.near)


def occupant(body: Body, info: ObjectInfo, X_WO: SE3) -> ObjectInfo | None:
    """What is believed to stand where an object is to stand, each taken as upright."""
    unnamed = {one.id: one for one in body.world.unnamed}
    for thing in surroundings(body, info.id, unnamed=True).objects:
        x_m, y_m, z_m = (thing.X_WO.p[i] - X_WO.p[i] for i in range(3))
        apart_m = _radius_m(thing.shape) + _radius_m(info.shape) + TOUCHING_M
        apart_z_m = 0.5 * (thing.shape.size_m[2] + info.shape.size_m[2])
        if thing.id != info.id and math.hypot(x_m, y_m) < apart_m and abs(z_m) < apart_z_m:
            other = unnamed.get(thing.id)
            return body.object_info(thing.id) if other is None else _info(other)
    return None


def _info(thing: Unnamed) -> ObjectInfo:
    return ObjectInfo(
        id=thing.id, name=thing.words, category="", color="", shape=thing.shape, mass_kg=0.0
    )


def _radius_m(shape: Shape) -> float:
    """Of the largest circle inside a shape, seen from above."""
    return 0.5 * min(shape.size_m[:2])


def tilt(X_WO: SE3) -> float:
    """Angle between an object's z axis and the vertical [rad]."""
    _, x, y, _ = X_WO.quat_wxyz
    return math.acos(max(-1.0, min(1.0, 1.0 - 2.0 * (x * x + y * y))))


def _is_over(place: Place, X_WO: SE3) -> bool:
    """Whether a pose is inside a surface's rectangle, seen from above."""
    x_m, y_m, _ = place.X_WP.inverse().apply(X_WO.p)
    half_x, half_y = 0.5 * place.size_m[0], 0.5 * place.size_m[1]
    inside = abs(x_m) <= half_x + OVERHANG_M and abs(y_m) <= half_y + OVERHANG_M
    return bool(inside and not place.floor)
