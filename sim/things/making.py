"""A kind and a number make a thing: the same ones always the same thing.

Number 0 is the kind as the catalogue has it; with every other one size, proportions, colour, print
and contents are drawn.
"""

from __future__ import annotations

import zlib
from functools import lru_cache

import msgspec
import numpy as np

from sim.forms.mesh import Matter
from sim.things import catalogue
from sim.things.catalogue import (
    AnyForm,
    Bent,
    Cap,
    Closed,
    Flat,
    Fruit,
    Handle,
    Kind,
    Packet,
    Print,
    Section,
    Vessel,
)
from sim.things.lying import bent, flat
from sim.things.materials import MATERIALS
from sim.things.packets import packet
from sim.things.prints import Picture, picture
from sim.things.thing import Made, Thing
from sim.things.turned import closed, fruit, vessel

MOST_VARIANT = 999_999


@lru_cache(maxsize=512)
def made(name: str, variant: int = 0, color: str = "") -> Thing:
    """A thing of a kind.

    Args:
        name: of the kind.
        variant: which of them.
        color: in place of the one that is drawn.

    Raises:
        ConfigError: there is no such kind, with the nearest name.
    """
    return make(catalogue.kind(name), name, variant, color=color)


def make(kind: Kind, name: str, variant: int, *, color: str = "") -> Thing:
    """A thing of a kind that need not be in the catalogue; `made` says what the rest is."""
    rng = np.random.default_rng(np.random.SeedSequence([zlib.crc32(name.encode()), variant]))
    across, up, share = (float(v) for v in rng.uniform(-1.0, 1.0, 3)) if variant else (0.0,) * 3
    color = color or kind.colors[variant % len(kind.colors)]
    form = sized(kind.of, 1.0 + kind.vary.across * across, 1.0 + kind.vary.up * up)
    word = kind.category or name.replace("_", " ")
    drawn = None if kind.print is None else picture(kind.print, color, word, rng)
    plain = _made(form, color, drawn, kind.print)
    matter = _weighed(plain, kind, 0.5 + 0.5 * share)
    x, y, z = plain.size_m
    low = np.array([0.0, 0.0, -z / 2])
    reach = max(
        float(np.linalg.norm(look.mesh.points[:, :2], axis=1).max()) for look in plain.looks
    )
    return Thing(
        name=f"{name}/{variant}/{color}",
        category=word,
        color=color,
        material=kind.material,
        shape=plain.shape,
        size_m=(round(x, 4), round(y, 4), round(z, 4)),
        looks=tuple(look._replace(mesh=look.mesh.moved(low)) for look in plain.looks),
        contacts=tuple(
            one._replace(p=(one.p[0], one.p[1], one.p[2] - z / 2)) for one in plain.contacts
        ),
        pieces=plain.pieces,
        matter=_lowered(matter, z / 2),
        radius_m=reach,
    )


def _made(form: AnyForm, color: str, drawn: Picture | None, where: Print | None) -> Made:
    at = (where.low, where.high) if where is not None else (0.0, 0.0)
    match form:
        case Vessel():
            return vessel(form, color, drawn, at)
        case Closed():
            return closed(form, color, drawn, at)
        case Fruit():
            return fruit(form, color)
        case Bent():
            return bent(form, color)
        case Packet():
            return packet(form, color, drawn)
        case Flat():
            return flat(form, color)


def _weighed(plain: Made, kind: Kind, share: float) -> Matter:
    """Walls and contents; `share` is where in the range of the contents it is, 0 to 1."""
    matter = plain.matter.times(MATERIALS[kind.material].density_kg_m3)
    if kind.fill is not None:
        low, high = kind.fill.share
        part = low + share * (high - low)
        matter = matter.with_(plain.hollow.times(part * kind.fill.density_kg_m3))
    if kind.mass_kg is not None:
        low, high = kind.mass_kg
        matter = matter.times((low + share * (high - low)) / matter.mass_kg)
    return matter


def _lowered(matter: Matter, by_m: float) -> Matter:
    """The same about an origin that is so much further up."""
    d = np.array([0.0, 0.0, by_m])
    cross = np.outer(matter.first, d)
    first = matter.first - matter.mass_kg * d
    second = matter.second - cross - cross.T + matter.mass_kg * np.outer(d, d)
    return Matter(matter.mass_kg, first, second)


def sized(form: AnyForm, across: float, up: float) -> AnyForm:
    """A form, wider and higher by such factors; walls stay as thick."""
    replace = msgspec.structs.replace
    if isinstance(form, Vessel | Closed | Fruit):
        profile = tuple((r * across, z * up) for r, z in form.profile_m)
        form = replace(form, profile_m=profile)
    match form:
        case Vessel():
            return replace(form, floor_m=form.floor_m * up, handle=_handle(form.handle, across, up))
        case Closed():
            return replace(form, cap=_cap(form.cap, up))
        case Fruit():
            return form
        case Bent():
            return replace(form, length_m=form.length_m * up, radius_m=form.radius_m * across,
                           bend_m=form.bend_m * up)  # fmt: skip
        case Packet():
            x, y, z = form.size_m
            return replace(form, size_m=(x * across, y * across, z * up), gable_m=form.gable_m * up)
        case Flat():
            return replace(form, sections=tuple(_section(s, across, up) for s in form.sections),
                           tines_m=form.tines_m * up)  # fmt: skip


def _section(one: Section, across: float, up: float) -> Section:
    return msgspec.structs.replace(one, x_m=one.x_m * up, width_m=one.width_m * across)


def _handle(one: Handle | None, across: float, up: float) -> Handle | None:
    if one is None:
        return None
    return msgspec.structs.replace(
        one, high_m=one.high_m * up, low_m=one.low_m * up, out_m=one.out_m * across
    )


def _cap(one: Cap | None, up: float) -> Cap | None:
    return None if one is None else msgspec.structs.replace(one, from_m=one.from_m * up)
