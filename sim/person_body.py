"""People as MuJoCo bodies: a figure of capsules that stands, sits or lies."""

from __future__ import annotations

from collections.abc import Callable

import mujoco

from robot.se3 import Vector3
from sim import atlas
from sim.paint import Paint
from sim.person_arm import ArmSide, links
from sim.rays import UNSENSED
from sim.world_schema import Person, Posture

CAPSULE = mujoco.mjtGeom.mjGEOM_CAPSULE
SPHERE = mujoco.mjtGeom.mjGEOM_SPHERE
SITS_LOWER_M = 0.37
"""How much lower the trunk of a figure of 1.70 m is on a seat of 0.45 m."""
ON_BACK_M, MIDDLE_M = 0.14, 0.85
"""Of who lies: from the floor to the middle of the trunk, and from the soles to the origin."""
Point = tuple[float, float, float]


def add_person(spec: mujoco.MjSpec, person: Person, paint: Paint) -> None:
    """A figure of capsules; a mocap body, so that a fault can move it."""
    X_WO = atlas.pose_of(person)
    body = spec.worldbody.add_body(name=f"person/{person.id}", pos=X_WO.p, quat=X_WO.quat_wxyz)
    body.mocap = True
    scale = person.height_m / 1.70
    skin, shirt, trousers = paint.color("skin"), paint.color(person.color), paint.color("charcoal")
    hair, shoes = paint.color("brown"), paint.color("black")
    put = PUT[person.posture]
    legs = (
        ((0, 0.085, 0.10), (0, 0.085, 0.80), 0.070, trousers),
        ((0, -0.085, 0.10), (0, -0.085, 0.80), 0.070, trousers),
        ((0.02, 0.085, 0.04), (0.14, 0.085, 0.04), 0.040, shoes),
        ((0.02, -0.085, 0.04), (0.14, -0.085, 0.04), 0.040, shoes),
    )
    bent = (
        ((0, 0.085, 0.53), (0.42, 0.085, 0.53), 0.070, trousers),
        ((0, -0.085, 0.53), (0.42, -0.085, 0.53), 0.070, trousers),
        ((0.42, 0.085, 0.46), (0.42, 0.085, 0.10), 0.055, trousers),
        ((0.42, -0.085, 0.46), (0.42, -0.085, 0.10), 0.055, trousers),
        ((0.44, 0.085, 0.04), (0.56, 0.085, 0.04), 0.040, shoes),
        ((0.44, -0.085, 0.04), (0.56, -0.085, 0.04), 0.040, shoes),
    )
    trunk = (
        ((0, 0, 0.95), (0, 0, 1.25), 0.140, shirt),
        ((0, 0.12, 1.34), (0, -0.12, 1.34), 0.070, shirt),
        ((0, 0.19, 1.34), (0.02, 0.23, 1.08), 0.045, shirt, "left_upper_arm"),
        ((0, -0.19, 1.34), (0.02, -0.23, 1.08), 0.045, shirt, "right_upper_arm"),
        ((0.02, 0.23, 1.06), (0.10, 0.22, 0.84), 0.036, skin, "left_forearm"),
        ((0.02, -0.23, 1.06), (0.10, -0.22, 0.84), 0.036, skin, "right_forearm"),
        ((0, 0, 1.38), (0, 0, 1.46), 0.050, skin),
    )
    sits = person.posture == "sits"
    whole = [(bent if sits else legs, _as_is), (trunk, put)] if sits else [((*legs, *trunk), put)]
    for limbs, placed in whole:  # from, to, radius of a figure of 1.70 m; material
        for start, end, radius, material, *part in limbs:
            ends = [value * scale for value in (*placed(start), *placed(end))]
            name = f"person/{person.id}/{part[0]}" if part else ""
            body.add_geom(
                name=name, type=CAPSULE, fromto=ends, size=[radius * scale, 0, 0],
                material=material,
            )  # fmt: skip
    heads: tuple[tuple[Point, float, str], ...] = (
        ((0.0, 0.0, 1.585), 0.105, skin),
        ((-0.02, 0.0, 1.605), 0.108, hair),
    )
    for p, radius, material in heads:
        place = [value * scale for value in put(p)]
        body.add_geom(type=SPHERE, pos=place, size=[radius * scale, 0, 0], material=material)
    sides: tuple[tuple[ArmSide, float], ...] = (("left", 1.0), ("right", -1.0))
    for side, out in sides:
        _add_hand(body, person, side, out * scale, skin)


def _as_is(p: Vector3) -> Vector3:
    return p


def _lower(p: Vector3) -> Vector3:
    return (p[0], p[1], p[2] - SITS_LOWER_M)


def _on_the_back(p: Vector3) -> Vector3:
    return (p[2] - MIDDLE_M, p[1], ON_BACK_M + p[0])


PUT: dict[Posture, Callable[[Vector3], Vector3]] = {
    "stands": _as_is,
    "sits": _lower,
    "lies": _on_the_back,
}
"""Where a point of a figure that stands is in another posture."""


def _add_hand(
    body: mujoco.MjsBody, person: Person, side: ArmSide, out: float, material: str
) -> None:
    """A palm with fingers and a thumb, below the forearm; drawn only (`sim.person_arm`)."""
    scale, put = abs(out), PUT[person.posture]
    *_, palm, fingers, thumb = links(person.id, side)
    parts = (  # a point, radius and length along the forearm of a figure of 1.70 m
        (palm, (0.131, 0.217, 0.756), 0.028, 0.035),
        (fingers, (0.150, 0.222, 0.704), 0.011, 0.050),
        (thumb, (0.158, 0.195, 0.715), 0.011, 0.050),
    )
    for name, (x, y, z), radius, length in parts:
        low = put((x + 0.17 * length, y, z - 0.49 * length))
        high = put((x - 0.17 * length, y, z + 0.49 * length))
        ends = [scale * low[0], out * low[1], scale * low[2]]
        ends += [scale * high[0], out * high[1], scale * high[2]]
        body.add_geom(
            name=name, type=CAPSULE, fromto=ends, size=[radius * scale, 0, 0], material=material,
            contype=0, conaffinity=0, group=UNSENSED,
        )  # fmt: skip
