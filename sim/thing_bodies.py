"""A thing of the catalogue as a MuJoCo body: meshes to look at, convex parts that touch, its mass.

Everything that looks sees the meshes; what touches is in a group that nothing sees.
"""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np

from sim.forms.mesh import Mesh
from sim.paint import Paint
from sim.things.materials import MATERIALS
from sim.things.thing import Contact, Look, Thing

TOUCHING = 3
"""The group of what only touches; `sim.rays` and `sim.render` leave it out."""
KINDS = {
    "box": mujoco.mjtGeom.mjGEOM_BOX,
    "cylinder": mujoco.mjtGeom.mjGEOM_CYLINDER,
    "capsule": mujoco.mjtGeom.mjGEOM_CAPSULE,
    "ellipsoid": mujoco.mjtGeom.mjGEOM_ELLIPSOID,
}
TORSION_M, ROLLING_M = 0.005, 0.0005
ROLLS = 6
"""Dimensions of a contact: also against rolling, as for all that is round (`sim.bodies`)."""


def shape(body: Any, spec: mujoco.MjSpec, thing: Thing, paint: Paint) -> None:
    """Give a body the form of a thing; its frame is the thing's."""
    material = MATERIALS[thing.material]
    for number, look in enumerate(thing.looks):
        body.add_geom(
            type=mujoco.mjtGeom.mjGEOM_MESH,
            meshname=_mesh(spec, paint, f"thing/{thing.name}/{number}", look.mesh),
            material=_paint(paint, f"{thing.name}/{number}", look, material.gloss),
            contype=0, conaffinity=0, mass=0.0,
        )  # fmt: skip
    friction = [material.friction, TORSION_M, ROLLING_M]
    for part in thing.contacts:
        body.add_geom(
            type=KINDS[part.kind], size=_half(part), pos=part.p, quat=part.quat_wxyz,
            friction=friction, condim=ROLLS, group=TOUCHING, mass=0.0,
        )  # fmt: skip
    inertia = thing.matter.inertia
    body.explicitinertial = True
    body.mass = thing.mass_kg
    body.ipos = thing.matter.middle
    body.fullinertia = [inertia[0, 0], inertia[1, 1], inertia[2, 2],
                        inertia[0, 1], inertia[0, 2], inertia[1, 2]]  # fmt: skip


def _half(part: Contact) -> list[float]:
    x, y, z = part.half_m
    return [x, z, 0.0] if part.kind in ("cylinder", "capsule") else [x, y, z]


def _mesh(spec: mujoco.MjSpec, paint: Paint, name: str, form: Mesh) -> str:
    """A mesh of the scene, made once."""
    if paint.is_first(name):
        mesh, form = spec.add_mesh(name=name), form.creased()
        mesh.uservert = form.points.astype(np.float32).ravel()
        mesh.userface = form.faces.ravel()
        mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL  # not asked for, and never fails
        if form.wrap is not None:
            mesh.usertexcoord = form.wrap.uv.astype(np.float32).ravel()
            mesh.userfacetexcoord = form.wrap.faces.ravel()
    return name


def _paint(paint: Paint, name: str, look: Look, gloss: float) -> str:
    if look.picture is not None:
        return paint.picture(name, look.picture, gloss=0.4 * gloss)
    return paint.glossy(look.color, gloss)
