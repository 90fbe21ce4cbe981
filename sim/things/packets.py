"""Things out of cardboard: boxes with print, cartons with a folded roof; books."""

from __future__ import annotations

import numpy as np

from robot.se3 import Vector3
from sim.forms.lathe import lathe
from sim.forms.loft import loft, prism, rounded, wrapped
from sim.forms.mesh import Mesh
from sim.things.catalogue import Packet
from sim.things.prints import Picture
from sim.things.thing import Contact, Look, Made, piece

COVER_M = 0.003
"""Of a book."""


def packet(form: Packet, color: str, picture: Picture | None) -> Made:
    """A box, whose print begins at its back so that its seam is not seen."""
    depth, width, height = form.size_m
    body_m = height - form.gable_m
    outline = np.roll(rounded(depth, width, form.edge_m), -6, axis=0)
    if form.pages:
        return _book(form, color, picture)
    mesh = wrapped(outline, 0.0, body_m) if picture is not None else prism(outline, 0.0, body_m)
    inner = prism(
        rounded(depth - 2 * form.wall_m, width - 2 * form.wall_m, form.edge_m),
        form.wall_m, body_m - form.wall_m,
    ).matter(1.0)  # fmt: skip
    looks = [Look(mesh, "white" if picture is not None else color, picture)]
    matter = mesh.matter(1.0).with_(inner.times(-1.0))
    if not form.gable_m:
        contacts = (_block(depth, width, 0.0, height),)
        return Made(tuple(looks), contacts, "box", form.size_m, matter, inner)
    looks.append(Look(_gable(form, body_m), color))
    ridge = _block(0.35 * depth, width, body_m, height)
    held = piece("box", (depth, width, body_m), (0.0, 0.0, 0.5 * (body_m - height)))
    over = piece("box", (0.7 * depth, width, form.gable_m), (0.0, 0.0, 0.5 * body_m), is_held=False)
    if form.cap:
        top = body_m + 0.62 * form.gable_m
        screw = lathe([(0.0, top - 0.02), (0.013, top - 0.02), (0.013, top + 0.004),
                       (0.012, top + 0.006), (0.0, top + 0.006)])  # fmt: skip
        looks.append(Look(screw.moved((0.22 * depth, 0.0, 0.0)), form.cap))
    contacts = (_block(depth, width, 0.0, body_m), ridge)
    return Made(tuple(looks), contacts, "box", form.size_m, matter, inner, (held, over))


def _block(depth: float, width: float, low: float, high: float) -> Contact:
    half: Vector3 = (depth / 2, width / 2, (high - low) / 2)
    return Contact("box", half, (0.0, 0.0, (low + high) / 2))


def _gable(form: Packet, low: float) -> Mesh:
    """The roof of a milk carton: from the body to a ridge along y, and the seam on that."""
    depth, width, height = form.size_m
    ridge, seam = 0.004, low + 0.72 * form.gable_m
    rings = [
        np.column_stack([rounded(d, width, 0.001), np.full(16, z)])
        for d, z in ((depth, low), (ridge, seam), (ridge, height))
    ]
    return loft(rings)


def _book(form: Packet, color: str, picture: Picture | None) -> Made:
    """A book that stands: two covers and a spine around its pages; the spine looks along +y."""
    depth, width, height = form.size_m
    bay = width - COVER_M
    half = depth / 2
    cover = np.array([
        (-half, -width / 2), (-half + COVER_M, -width / 2), (-half + COVER_M, bay - width / 2),
        (half - COVER_M, bay - width / 2), (half - COVER_M, -width / 2), (half, -width / 2),
        (half, width / 2), (-half, width / 2),
    ])  # fmt: skip
    block = rounded(depth - 2 * COVER_M, width - COVER_M - 0.004, 0.0005) - np.array([0.0, -0.0005])
    looks = [Look(prism(cover, 0.0, height), color)]
    pages = prism(block, 0.003, height - 0.003)
    looks.append(Look(pages, form.pages))
    if picture is not None:
        front = wrapped(rounded(depth + 0.0006, 0.62 * width, 0.0008), 0.2 * height, 0.8 * height)
        looks.append(Look(front, "white", picture))
    whole = prism(rounded(depth, width, 0.0005), 0.0, height).matter(1.0)
    contacts = (_block(depth, width, 0.0, height),)
    return Made(tuple(looks), contacts, "box", form.size_m, whole, whole.times(0.0))
