"""Things from the lathe: open vessels with handles, closed bottles and cans, fruit."""

from __future__ import annotations

import math

import numpy as np

from robot.messages import Piece
from robot.se3 import Array, Vector3
from sim.forms.lathe import band, lathe
from sim.forms.loft import tube
from sim.forms.mesh import NOTHING, Mesh
from sim.things import outlines
from sim.things.catalogue import Cap, Closed, Fruit, Handle, Vessel
from sim.things.prints import Picture
from sim.things.rods import along, rod
from sim.things.thing import Contact, Look, Made, piece

STAVES = 12
LABEL_M = 0.0004
"""By how much a print stands out."""
SOLE = 0.4
"""Radius of the flat that a fruit stands on, of its greatest."""


def vessel(
    form: Vessel, color: str, picture: Picture | None, print_at: tuple[float, float]
) -> Made:
    """A cup, a glass, a bowl, a plate."""
    rough = _from_axis(form.profile_m)
    outside = outlines.rounded(rough, form.smooth)
    inside = outlines.above(outlines.inset(outside, form.wall_m), form.floor_m)
    shell = lathe([*_points(outside), *_points(inside)[::-1]])
    cavity = lathe([*_points(inside), (0.0, float(inside[-1, 1]))])
    height = float(outside[:, 1].max())
    looks = [Look(shell, color)]
    if form.inside:
        looks.append(Look(_lining(inside), form.inside))
    if picture is not None:
        looks.append(_label(outside, picture, height, print_at))
    walls = rough[rough[:, 1] >= form.floor_m]
    foot = _cut(rough, form.floor_m)
    walls = np.concatenate([foot[-1:], walls]) if walls[0, 1] > form.floor_m else walls
    contacts = outlines.discs(foot)
    contacts += outlines.staves(walls, wall_m=form.wall_m, count=STAVES)
    matter = shell.matter(1.0)
    size = 2.0 * float(outside[:, 0].max())
    pieces = list(outlines.pieces(rough))
    if form.handle is not None:
        bow, parts, size_m, p = _handle(form.handle, outside)
        looks[0] = Look(shell, color)
        looks.append(Look(bow, color))
        contacts += parts
        matter = matter.with_(bow.matter(1.0))
        pieces.append(piece("box", size_m, (p[0], p[1], p[2] - height / 2), is_held=False))
    return Made(
        tuple(looks), tuple(contacts), "cylinder", (size, size, height), matter,
        cavity.matter(1.0), tuple(pieces),
    )  # fmt: skip


def closed(
    form: Closed, color: str, picture: Picture | None, print_at: tuple[float, float]
) -> Made:
    """A bottle, a can, a jar."""
    rough = _from_axis(form.profile_m)
    outside = outlines.rounded(rough, form.smooth)
    height = float(outside[:, 1].max())
    inside = outlines.inset(outside, form.wall_m)
    inside[:, 1] = np.clip(inside[:, 1], form.wall_m, height - form.wall_m)
    body = lathe([*_points(outside), (0.0, height)])
    hollow = lathe([*_points(inside), (0.0, height - form.wall_m)]).matter(1.0)
    looks = [Look(body, color)]
    contacts = outlines.discs(rough)
    size = 2.0 * float(outside[:, 0].max())
    pieces = list(outlines.pieces(rough))
    if form.cap is not None:
        looks.append(Look(_cap(form.cap, outside), form.cap.color))
        if form.cap.spout_m:
            mesh, contact, box = _spout(form.cap, height)
            looks.append(Look(mesh, form.cap.color))
            contacts.append(contact)
            pieces.append(box)
    if form.rims:
        looks += [Look(rim, form.rims) for rim in _rims(outside, height)]
    if picture is not None:
        looks.append(_label(outside, picture, height, print_at))
    return Made(
        tuple(looks), tuple(contacts), "cylinder", (size, size, height),
        body.matter(1.0).with_(hollow.times(-1.0)), hollow, tuple(pieces),
    )  # fmt: skip


def fruit(form: Fruit, color: str) -> Made:
    """An apple, a pear; a lemon on its side."""
    rough = _from_axis(form.profile_m)
    outside = outlines.rounded(rough, form.smooth)
    outside[-1, 0] = 0.0
    body = lathe(_points(outside))
    low, high = body.bounds
    body = body.moved((0.0, 0.0, -float(low[2])))
    outside = outside - np.array([0.0, float(low[2])])
    height = float(high[2] - low[2])
    radius = float(outside[:, 0].max())
    belly = float(outside[int(np.argmax(outside[:, 0])), 1])
    if form.lies:
        return _lying(body, color, radius, height)
    contacts = [
        Contact("ellipsoid", (radius, radius, belly), (0.0, 0.0, belly)),
        Contact("cylinder", (SOLE * radius, SOLE * radius, 0.002), (0.0, 0.0, 0.002)),
    ]
    if height - belly > 1.15 * belly:  # a pear's neck
        top = outside[outside[:, 1] > 0.5 * (height + belly)]
        neck = float(top[:, 0].max())
        contacts.append(Contact("ellipsoid", (neck, neck, neck), (0.0, 0.0, height - neck)))
    looks = [Look(body, color)]
    if form.stem_m:
        dip = float(outside[-1, 1])
        way = [(0.0, 0.0, dip - 0.004), (0.0, 0.0, dip + 0.4 * form.stem_m),
               (0.003, 0.0, dip + form.stem_m)]  # fmt: skip
        looks.append(Look(tube(way, (0.0015, 0.0013, 0.002), corners=6), "brown"))
    size = 2.0 * radius
    held = piece(
        "cylinder", (size, size, min(0.5 * height, radius)), (0.0, 0.0, belly - height / 2)
    )
    return Made(
        tuple(looks), tuple(contacts), "cylinder", (size, size, height), body.matter(1.0), NOTHING,
        (held,),
    )  # fmt: skip


def _lying(body: Mesh, color: str, radius: float, length: float) -> Made:
    """What has its axis along x."""
    turn = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])
    mesh = body.moved((0.0, 0.0, -length / 2)).turned(turn).moved((0.0, 0.0, radius))
    contacts = (
        Contact("ellipsoid", (length / 2, radius, radius), (0.0, 0.0, radius)),
        Contact("box", (0.2 * length, SOLE * radius, 0.001), (0.0, 0.0, 0.001)),
    )
    size: Vector3 = (length, 2 * radius, 2 * radius)
    held = piece("box", (0.6 * length, 2 * radius, 1.2 * radius), (0.0, 0.0, 0.0))
    ends = tuple(
        piece("box", (0.2 * length, radius, radius), (at * length, 0.0, 0.0), is_held=False)
        for at in (-0.4, 0.4)
    )
    return Made(
        (Look(mesh, color),), contacts, "box", size, mesh.matter(1.0), NOTHING, (held, *ends)
    )


def _from_axis(profile: tuple[tuple[float, float], ...]) -> Array:
    """An outline that begins on the axis."""
    points = np.asarray(profile, dtype=np.float64)
    if points[0, 0] > 1e-9:
        points = np.concatenate([[[0.0, points[0, 1]]], points])
    return points


def _points(outline: Array) -> list[tuple[float, float]]:
    return [(float(r), float(z)) for r, z in outline]


def _cut(outline: Array, top_m: float) -> Array:
    """What of an outline is below a height."""
    low = outline[outline[:, 1] < top_m]
    if not len(low):
        return outline[:1]
    edge = float(np.interp(top_m, outline[:, 1], outline[:, 0]))
    return np.concatenate([low, [[edge, top_m]]])


def _lining(inside: Array) -> Mesh:
    """A skin over the inside of a vessel, to give it a colour of its own."""
    skin = 0.0003
    top = inside[:-1] if len(inside) > 3 else inside
    inner = np.column_stack([np.maximum(top[:, 0] - skin, 0.0), top[:, 1] + skin])
    return lathe([*_points(top), *_points(inner)[::-1]])


def _label(outside: Array, picture: Picture, height: float, at: tuple[float, float]) -> Look:
    rising = np.append(np.diff(outside[:, 1]) > 1e-9, True)
    mesh = band(
        _points(outside[rising]), low_m=at[0] * height, high_m=at[1] * height, thick_m=LABEL_M
    )
    return Look(mesh, "white", picture)


def _cap(cap: Cap, outside: Array) -> Mesh:
    """A lid over the top of an outline."""
    above = outside[outside[:, 1] > cap.from_m]
    edge = float(np.interp(cap.from_m, outside[:, 1], outside[:, 0]))
    radii = np.concatenate([[edge], above[:, 0]]) + cap.wider_m
    heights = np.concatenate([[cap.from_m], above[:, 1]])
    top = float(heights[-1]) + 0.0005
    return lathe([
        (0.0, cap.from_m), *zip(radii.tolist(), heights.tolist(), strict=True),
        (float(radii[-1]), top), (0.0, top),
    ])  # fmt: skip


def _spout(cap: Cap, height: float) -> tuple[Mesh, Contact, Piece]:
    """A pump's spout towards +x: how it looks, what of it touches, what planners keep off."""
    radius, z, reach = 0.005, height - 0.006, cap.spout_m
    way = np.array([(0.0, 0.0, z), (0.6 * reach, 0.0, z + 0.003), (reach, 0.0, z - 0.006)])
    mesh = tube(way, (1.4 * radius, radius, 0.8 * radius))
    box = piece(
        "box", (reach, 2 * radius, 2.4 * radius), (0.5 * reach, 0.0, z - height / 2), is_held=False
    )
    return mesh, rod(way[0], way[2], radius), box


def _rims(outside: Array, height: float) -> list[Mesh]:
    """The two ends of a can: a bead, and a lid that is sunk a little."""
    radius = float(outside[:, 0].max())
    end = float(outside[-1, 0])
    lid = [(0.0, height - 0.003), (end + 0.0006, height - 0.003), (end + 0.0006, height + 0.0012),
           (end - 0.002, height + 0.0012), (end - 0.003, height + 0.0003),
           (0.0, height + 0.0003)]  # fmt: skip
    first = float(outside[1, 0])
    foot = [(0.0, 0.0002), (first + 0.0004, 0.0002), (min(first + 0.002, radius + 0.0004), 0.003),
            (0.0, 0.003)]  # fmt: skip
    return [lathe(lid), lathe(foot)]


def _handle(handle: Handle, outside: Array) -> tuple[Mesh, list[Contact], Vector3, Vector3]:
    """A bow on the side of +x: how it looks, what of it touches, and a box around it."""
    heights, radii = outside[:, 1], outside[:, 0]
    high, low = handle.high_m, handle.low_m
    start, end = (float(np.interp(z, heights, radii)) - 0.003 for z in (high, low))
    turn = np.linspace(math.pi / 2, -math.pi / 2, 13)
    out, up = np.abs(np.cos(turn)) ** 0.7, np.sign(np.sin(turn)) * np.abs(np.sin(turn)) ** 0.7
    reach = max(start, end) + handle.out_m + 0.003 - 0.5 * handle.thick_m
    root = np.where(up > 0, start, end)
    way = np.column_stack(
        [root + out * (reach - root), np.zeros(13), 0.5 * (high + low) + 0.5 * up * (high - low)]
    )
    radius = 0.5 * handle.thick_m
    mesh = tube(way, [radius] * 13)
    contacts = along(way[[0, 3, 6, 9, 12]], radius)
    least = min(start, end)
    size = (reach + radius - least, handle.thick_m, high - low + handle.thick_m)
    return mesh, contacts, size, (0.5 * (reach + radius + least), 0.0, 0.5 * (high + low))
