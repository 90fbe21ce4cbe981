"""What kinds of things there are: a file of `kinds/` for each family, read once.

All lengths are in metres. Profiles are outlines of what is turned on a lathe: radius and height,
from the foot up.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from importlib import resources
from pathlib import Path
from typing import Literal

import msgspec

from robot.errors import ConfigError, Problem
from robot.files import config

Point = tuple[float, float]
Style = Literal["brand", "stripes", "dots", "rings"]


class Record(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """An entry of these files."""


class Print(Record, frozen=True, kw_only=True):
    """A picture around it, made of its colour and another: from one height to another.

    Attributes:
        style: a name on a ground with an ornament, stripes up, dots, or rings around.
        text: of a brand; empty: the thing's own word.
        colors: what the ground may be; empty: the thing's own colour.
        low, high: from where to where it goes, as shares of the height.
    """

    style: Style
    text: str = ""
    colors: tuple[str, ...] = ()
    low: float = 0.15
    high: float = 0.75


class Handle(Record, frozen=True, kw_only=True):
    """A bow at one side: where it begins and ends, how far out it reaches, how thick it is."""

    high_m: float
    low_m: float
    out_m: float
    thick_m: float = 0.010


class Cap(Record, frozen=True, kw_only=True):
    """What closes a bottle from a height on: its colour, and how much wider it is."""

    from_m: float
    color: str
    wider_m: float = 0.002
    spout_m: float = 0.0
    """How far a pump's spout sticks out of it."""


class Vessel(Record, frozen=True, kw_only=True, tag="vessel", tag_field="form"):
    """Turned, and open above: what a cup, a bowl or a plate is.

    Attributes:
        profile_m: the outside.
        wall_m: thickness, `floor_m` the height of the inside's lowest point.
        smooth: how often the outline's corners are cut off.
        inside: the colour within; empty: that of the outside.
    """

    profile_m: tuple[Point, ...]
    wall_m: float
    floor_m: float
    smooth: int = 0
    handle: Handle | None = None
    inside: str = ""


class Closed(Record, frozen=True, kw_only=True, tag="closed", tag_field="form"):
    """Turned, and closed: what a bottle or a can is; within is a hollow that is filled.

    Attributes:
        profile_m: the outside, up to the top.
        wall_m: thickness.
        cap: what closes it.
        rims: colour of the ends of a can; empty: it has none.
    """

    profile_m: tuple[Point, ...]
    wall_m: float
    smooth: int = 0
    cap: Cap | None = None
    rims: str = ""


class Fruit(Record, frozen=True, kw_only=True, tag="fruit", tag_field="form"):
    """Turned and solid, round; `lies`: on its side; `stem_m`: of a stalk on top."""

    profile_m: tuple[Point, ...]
    smooth: int = 2
    stem_m: float = 0.0
    lies: bool = False


class Bent(Record, frozen=True, kw_only=True, tag="bent", tag_field="form"):
    """A rod that lies, bent in the plane: its length, greatest radius, and how far it bends."""

    length_m: float
    radius_m: float
    bend_m: float
    tips: str = ""


class Packet(Record, frozen=True, kw_only=True, tag="packet", tag_field="form"):
    """A box that is printed on: depth, width, height.

    Attributes:
        wall_m: thickness.
        edge_m: radius of its upright edges.
        gable_m: height of the folded roof of a carton; `cap`: the colour of a screw cap on it.
        pages: colour of a book's pages; empty: it is none.
    """

    size_m: tuple[float, float, float]
    wall_m: float = 0.0006
    edge_m: float = 0.002
    gable_m: float = 0.0
    cap: str = ""
    pages: str = ""


class Section(Record, frozen=True, kw_only=True):
    """A cut through a flat thing: at x, so wide, so thick, so high, hollowed by so much."""

    x_m: float
    width_m: float
    thick_m: float
    z_m: float = 0.0
    dish_m: float = 0.0


class Flat(Record, frozen=True, kw_only=True, tag="flat", tag_field="form"):
    """What lies along x: cutlery and tools.

    Attributes:
        sections: from the handle's end to the tip.
        grip: up to which section the handle goes, which may have a colour of its own.
        tines: how many of them the last section goes on in, `tines_m` long.
    """

    sections: tuple[Section, ...]
    grip: int = 2
    grip_color: str = ""
    tines: int = 0
    tines_m: float = 0.0


AnyForm = Vessel | Closed | Fruit | Bent | Packet | Flat


class Vary(Record, frozen=True, kw_only=True):
    """By how much of it a size may be less or more: across, and up."""

    across: float = 0.05
    up: float = 0.05


class Fill(Record, frozen=True, kw_only=True):
    """What a hollow is filled with: from how much of it to how much, and how dense that is."""

    share: tuple[float, float]
    density_kg_m3: float = 1000.0


class Kind(Record, frozen=True, kw_only=True):
    """A kind of thing.

    Attributes:
        category: the word for it; empty: the kind's name with spaces.
        plural: of that word; empty: it gets an s.
        source: where its size is from.
        material: see `sim.things.materials`.
        colors: what it may have, the usual one first.
        mass_kg: from and to, in place of what form and material weigh.
    """

    category: str = ""
    plural: str = ""
    synonyms: tuple[str, ...] = ()
    source: str
    of: AnyForm
    material: str
    colors: tuple[str, ...]
    print: Print | None = None
    fill: Fill | None = None
    vary: Vary = Vary()
    mass_kg: tuple[float, float] | None = None


class Family(Record, frozen=True, kw_only=True):
    """A file of `kinds/`."""

    kinds: dict[str, Kind]


@lru_cache
def families() -> Mapping[str, Mapping[str, Kind]]:
    """Every kind by name, of every family by name."""
    folder = Path(str(resources.files("sim"))) / "things" / "kinds"
    paths = sorted(folder.glob("*.yaml"))
    return {path.stem: config.load(path, Family).kinds for path in paths}


@lru_cache
def kinds() -> Mapping[str, Kind]:
    """Every kind by name."""
    return {name: kind for family in families().values() for name, kind in family.items()}


def kind(name: str) -> Kind:
    """A kind by name. Raises ConfigError with the nearest one."""
    if name not in kinds():
        hint = config.nearest(name, list(kinds()))
        raise ConfigError([Problem(f"unknown kind of thing {name!r}", suggestion=hint)])
    return kinds()[name]


def category(name: str) -> str:
    """What people call a thing of a kind."""
    return kind(name).category or name.replace("_", " ")


def plural(name: str) -> str:
    """What people call several of them."""
    return kind(name).plural or f"{category(name)}s"
