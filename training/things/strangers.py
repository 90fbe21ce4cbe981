"""Things that have no name: boxes, cylinders and balls put together anyhow, and turned vessels."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np

from robot.se3 import Vector3
from sim.forms.lathe import lathe
from sim.paint import Paint

BOX = mujoco.mjtGeom.mjGEOM_BOX
CYLINDER = mujoco.mjtGeom.mjGEOM_CYLINDER
ELLIPSOID = mujoco.mjtGeom.mjGEOM_ELLIPSOID
TURNED_SHARE, ALONE_SHARE = 0.25, 0.35


def stranger(
    body: Any, spec: mujoco.MjSpec, name: str, paint: Paint, rng: np.random.Generator
) -> tuple[Vector3, float]:
    """Give a body a form that has no name, its frame in the middle of it.

    Returns:
        How far it reaches along x, y, z [m], and the radius of the circle around it from above.
    """
    if rng.random() < TURNED_SHARE:
        return _turned(body, spec, name, paint, rng)
    count = 1 if rng.random() < ALONE_SHARE else int(rng.integers(2, 5))
    low, high = np.zeros(3), np.zeros(3)
    parts: list[tuple[Any, np.ndarray, np.ndarray]] = []
    for number in range(count):
        half = np.exp(rng.uniform(np.log(0.012), np.log(0.075), 3))
        kind = (BOX, CYLINDER, ELLIPSOID)[int(rng.integers(3))]
        if kind == CYLINDER:
            half[1] = half[0]
        p = np.zeros(3)
        if number:
            axis, side = int(rng.integers(3)), float(rng.choice((-1.0, 1.0)))
            p = rng.uniform(-0.5, 0.5, 3) * (high - low)
            p[axis] = (high if side > 0 else low)[axis] + side * 0.8 * half[axis]
            p[2] = max(p[2], 0.0)
        low, high = np.minimum(low, p - half), np.maximum(high, p + half)
        parts.append((kind, half, p))
    middle, shared = (low + high) / 2, _colour(name, paint, rng)
    for number, (kind, half, p) in enumerate(parts):
        own = rng.random() < 0.5
        body.add_geom(
            type=kind, pos=p - middle,
            size=[half[0], half[2], 0.0] if kind == CYLINDER else half,
            material=_colour(f"{name}/{number}", paint, rng) if own else shared,
            contype=0, conaffinity=0, mass=0.01,
        )  # fmt: skip
    x, y, z = (high - low).tolist()
    return (x, y, z), float(np.hypot(x, y) / 2)


def _turned(
    body: Any, spec: mujoco.MjSpec, name: str, paint: Paint, rng: np.random.Generator
) -> tuple[Vector3, float]:
    """A solid of revolution with an outline that no kind has."""
    height = float(np.exp(rng.uniform(np.log(0.05), np.log(0.28))))
    count = int(rng.integers(3, 7))
    radii = np.exp(rng.uniform(np.log(0.012), np.log(0.06), count))
    heights = np.sort(rng.uniform(-0.5, 0.5, count)) * height
    heights[0], heights[-1] = -height / 2, height / 2
    profile = [(0.0, heights[0]), *zip(radii, heights, strict=True), (0.0, heights[-1])]
    form = lathe([(float(r), float(z)) for r, z in profile], segments=24).creased()
    mesh = spec.add_mesh(name=name)
    mesh.uservert = form.points.astype(np.float32).ravel()
    mesh.userface = form.faces.ravel()
    mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL
    body.add_geom(
        type=mujoco.mjtGeom.mjGEOM_MESH, meshname=name, material=_colour(name, paint, rng),
        contype=0, conaffinity=0, mass=0.01,
    )  # fmt: skip
    width = 2.0 * float(radii.max())
    return (width, width, height), width / 2


def _colour(name: str, paint: Paint, rng: np.random.Generator) -> str:
    r, g, b = rng.uniform(0.04, 0.98, 3).tolist()
    return paint.plain(f"stranger/{name}", (r, g, b), gloss=float(rng.uniform(0.0, 0.8)))
