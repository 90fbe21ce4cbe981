"""Things that lie: cutlery and tools lofted through sections, and what is bent like a banana."""

from __future__ import annotations

import itertools
import math

import numpy as np

from robot.messages import Piece
from robot.se3 import Array, Vector3
from sim.forms.loft import loft, tube
from sim.forms.mesh import NOTHING, Mesh, joined
from sim.things.catalogue import Bent, Flat, Section
from sim.things.outlines import THIN_M
from sim.things.rods import along
from sim.things.thing import Contact, Look, Made, piece

CORNERS = 14
HELD_M = 0.025
"""To both sides of where a handle is highest, fingers may close on it."""
TINE = 0.5
"""Width of a fork's tine, of its pitch."""


def flat(form: Flat, color: str) -> Made:
    """A spoon, a fork, a knife; its frame is in the middle of the box around it, on its foot."""
    sections = form.sections
    grip = loft([_ring(one) for one in sections[: form.grip + 1]])
    blade = [loft([_ring(one) for one in sections[form.grip :]])]
    blade += _tines(form)
    head = joined(blade)
    low, high = joined([grip, head]).bounds
    centre = np.array([(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, low[2]])
    looks = (
        Look(grip.moved(-centre), form.grip_color or color),
        Look(head.moved(-centre), color),
    )
    contacts = tuple(
        Contact(one.kind, one.half_m, _less(one.p, centre), one.quat_wxyz) for one in _blocks(form)
    )
    matter = looks[0].mesh.matter(1.0).with_(looks[1].mesh.matter(1.0))
    x, y, z = (float(v) for v in high - low)
    pieces = _pieces(form, float(centre[0]), (x, y, z))
    return Made(looks, contacts, "box", (x, y, z), matter, NOTHING, pieces)


def _pieces(form: Flat, centre_m: float, size_m: Vector3) -> tuple[Piece, ...]:
    """The handle around its highest place, where a hand closes across it, and what is not that."""
    handle = form.sections[: form.grip + 1]
    first, last = form.sections[0].x_m, form.sections[-1].x_m + form.tines_m
    middle = 0.5 * (first + last)
    top = max(
        handle, key=lambda one: (round(one.z_m + 0.5 * one.thick_m, 4), -abs(one.x_m - middle))
    )
    low, high = max(first, top.x_m - HELD_M), min(handle[-1].x_m + HELD_M, top.x_m + HELD_M)
    foot_m = min(one.z_m - 0.5 * one.thick_m for one in form.sections)
    tall = top.z_m + 0.5 * top.thick_m - foot_m
    at = 0.5 * (tall - size_m[2])
    wide = max([top.width_m, *(one.width_m for one in handle if low <= one.x_m <= high)])
    found = [piece("box", (high - low, wide, tall), (0.5 * (low + high) - centre_m, 0.0, at))]
    for start, end in ((first, low), (high, last)):
        if end > start:
            size = (end - start, size_m[1], size_m[2])
            at_m = 0.5 * (start + end) - centre_m
            found.append(piece("box", size, (at_m, 0.0, 0.0), is_held=False))
    return tuple(found)


def bent(form: Bent, color: str) -> Made:
    """A banana."""
    t = np.linspace(-1.0, 1.0, 17)
    half, r = form.length_m / 2, form.radius_m
    way = np.column_stack([half * t, form.bend_m * (t * t - 0.5), np.full(17, r)])
    fat = r * np.clip(1.25 * (1.0 - np.abs(t) ** 6) ** 0.5, 0.3, 1.0)
    fat[0], fat[-1] = 0.28 * r, 0.34 * r
    body = tube(way, fat.tolist(), corners=12)
    low, high = body.bounds
    centre = np.array([(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, 0.0])
    looks = [Look(body.moved(-centre), color)]
    if form.tips:
        for end, inwards in ((0, 1), (-1, -2)):
            tip = np.array([way[inwards], way[end], way[end] + 0.35 * (way[end] - way[inwards])])
            mesh = tube(tip - centre, [fat[inwards] * 1.01, fat[end] * 1.02, fat[end] * 0.8])
            looks.append(Look(mesh, form.tips))
    contacts = along(way[[1, 5, 8, 11, 15]] - centre, r * 0.97)
    contacts = [one._replace(p=(one.p[0], one.p[1], r)) for one in contacts]
    x, y, z = (float(v) for v in high - low)
    size: Vector3 = (x, y, z)
    at = float(way[8, 1] - centre[1])
    held = piece("box", (0.4 * x, 2 * r, z), (0.0, at, 0.0))
    ends = tuple(
        piece("box", (0.3 * x, y, z), (sign * 0.35 * x, 0.0, 0.0), is_held=False)
        for sign in (-1.0, 1.0)
    )
    return Made(
        tuple(looks), tuple(contacts), "box", size, body.matter(1.0), NOTHING, (held, *ends)
    )


def _ring(one: Section) -> Array:
    """A flattened oval across x, its upper side hollowed."""
    turn = 2.0 * math.pi * np.arange(CORNERS) / CORNERS
    across, up = np.cos(turn), np.sin(turn)
    shape = np.sign(across) * np.abs(across) ** 0.8
    y = 0.5 * one.width_m * shape
    z = one.z_m + 0.5 * one.thick_m * np.sign(up) * np.abs(up) ** 0.6
    z = z - one.dish_m * (1.0 - shape**2)
    return np.column_stack([np.full(CORNERS, one.x_m), y, z])


def _tines(form: Flat) -> list[Mesh]:
    """What a fork has at its end."""
    if not form.tines:
        return []
    root = form.sections[-1]
    pitch = root.width_m / form.tines
    found: list[Mesh] = []
    for k in range(form.tines):
        y = (k + 0.5) * pitch - 0.5 * root.width_m
        rings: list[Array] = []
        for share, lift in ((0.0, 0.0), (0.5, -0.002), (1.0, 0.001)):
            wide = pitch * TINE * (1.0 - 0.4 * share)
            cut = Section(
                x_m=root.x_m - 0.002 + share * form.tines_m, width_m=wide,
                thick_m=root.thick_m * (1.0 - 0.3 * share), z_m=root.z_m + lift,
            )  # fmt: skip
            rings.append(_ring(cut) + np.array([0.0, y, 0.0]))
        found.append(loft(rings))
    return found


def _blocks(form: Flat) -> list[Contact]:
    """A box from each section to the next."""
    found: list[Contact] = []
    ends = list(form.sections)
    if form.tines:
        last = ends[-1]
        ends.append(Section(x_m=last.x_m + form.tines_m, width_m=last.width_m,
                            thick_m=last.thick_m, z_m=last.z_m))  # fmt: skip
    for a, b in itertools.pairwise(ends):
        wide = 0.25 * (a.width_m + b.width_m)
        thick = 0.25 * max(a.thick_m + b.thick_m, 2 * THIN_M)
        za, zb = a.z_m - a.dish_m, b.z_m - b.dish_m
        run, rise = b.x_m - a.x_m, zb - za
        pitch = -math.atan2(rise, run)
        half: Vector3 = (0.5 * math.hypot(run, rise), wide, thick)
        p: Vector3 = (0.5 * (a.x_m + b.x_m), 0.0, 0.5 * (za + zb))
        quat = (math.cos(pitch / 2), 0.0, math.sin(pitch / 2), 0.0)
        found.append(Contact("box", half, p, quat))
    return found


def _less(p: Vector3, centre: Array) -> Vector3:
    x, y, z = (float(a - b) for a, b in zip(p, centre, strict=True))
    return (x, y, z)
