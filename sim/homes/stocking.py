"""Things on the surfaces of a home: which, how many of a kind, what lies beside what."""

from __future__ import annotations

import math
from collections.abc import Sequence

import msgspec
import numpy as np

from sim import atlas
from sim.homes import formed, lived_in
from sim.homes.catalogue import Good, HomeKind, stock
from sim.homes.draws import one_of, shuffled
from sim.homes.surfaces import DEEP_M, RIM_M, Surface
from sim.placing import radius_m
from sim.world_schema import Object

TRIES = 60
CATEGORIES = (5, 8)
"""Of things in a home, from and to."""
COUNTS = (4, 3, 2, 3, 2, 2, 1, 1)
"""Of things of the first category, the second, ...: several to count and to gather, some alone."""
USUAL = 0.75
"""How likely a thing is where such things are kept."""
TO_THE_BACK = 0.4
"""How likely a thing lies at the far side of what can be walked around."""
BESIDE = 0.4
"""How likely a thing is put near another that is there."""
MOST_PER_M, LEAST_FULL = 5, 2
"""Of things on a metre of a surface; so many it holds, however short it is."""
CROWDED = 1.6
"""How full a surface may be where more things are wanted than usual, to what is needed on average:
not all of a surface is within reach."""
PAINTS = (
    "red", "orange", "yellow", "green", "teal", "blue", "purple", "pink", "brown", "white", "gray",
    "black", "cream", "charcoal", "steel",
)  # fmt: skip
"""What anything may be painted."""
TIGHT_M, CLOSE_M, APART_M = 0.05, 0.16, 0.12
"""Gaps: the least, the most of what lies beside something, the least of all else."""


def stocked(
    kind: HomeKind,
    surfaces: Sequence[Surface],
    rng: np.random.Generator,
    *,
    count: int | None = None,
    is_lived_in: bool = False,
    has_forms: bool = False,
) -> tuple[Object, ...]:
    """Things, each with a spot, reachable; no two share colour and category, or a name.

    Args:
        kind: of the home.
        surfaces: to put them on.
        rng: of what is drawn.
        count: how many are wanted (fewer where they find no room); None: as usual.
        is_lived_in: some of them lie on their side.
        has_forms: they have the forms of the catalogue of things.
    """
    there: dict[str, list[Object]] = {surface.place.id: [] for surface in surfaces}
    found: list[Object] = []
    length_m = sum(surface.place.size_m[1] for surface in surfaces)
    full_per_m = max(MOST_PER_M, CROWDED * (count or 0) / length_m)
    stored = formed.goods() if has_forms else stock().goods
    for good, most in _wanted(kind, rng, stored) if count is None else _plenty(kind, rng, stored):
        size, mass_kg = _sized(good, rng)
        variant = int(rng.integers(formed.VARIANTS)) if has_forms else 0
        variants = good.variants if count is None else _all_variants(good)
        for word, color in shuffled(variants, rng)[:most]:
            if len(found) == count:
                return tuple(found)
            name = f"{word}_{good.category}".replace(" ", "_")
            bare = Object(
                id=name, category=good.category, color=color, shape=good.shape, size_m=size,
                mass_kg=mass_kg, on="", synonyms=good.synonyms if most == 1 else (),
            )  # fmt: skip
            bare = formed.shaped(bare, variant) if has_forms else bare
            bare = lived_in.on_its_side(bare, rng) if is_lived_in else bare
            usual = kind.goods.get(good.category, ())
            item = _put(bare, usual, surfaces, there, rng, full_per_m=full_per_m)
            if item is not None:
                there[item.on].append(item)
                found.append(item)
    return tuple(found)


def _wanted(
    kind: HomeKind, rng: np.random.Generator, stored: Sequence[Good]
) -> list[tuple[Good, int]]:
    """Goods of a home with how many of each.

    None is called by the last word of another: whoever counts "cans" counts no paint cans.
    """
    goods = {good.category: good for good in stored}
    found: list[Good] = []
    for name in shuffled(kind.goods, rng):
        good = goods[name]
        if all(good.category.split()[-1] != other.category.split()[-1] for other in found):
            found.append(good)
    most = int(rng.integers(CATEGORIES[0], CATEGORIES[1] + 1))
    found = sorted(found[:most], key=lambda good: -len(good.variants))
    extra = rng.integers(0, 2, len(found)).tolist()
    return [
        (good, min(len(good.variants), COUNTS[index] + more))
        for index, (good, more) in enumerate(zip(found, extra, strict=True))
    ]


def _plenty(
    kind: HomeKind, rng: np.random.Generator, stored: Sequence[Good]
) -> list[tuple[Good, int]]:
    """Goods of all kinds of homes, those of this one first, in as many colours as there are."""
    found: list[Good] = []
    for good in sorted(shuffled(stored, rng), key=lambda good: good.category not in kind.goods):
        if all(good.category.split()[-1] != other.category.split()[-1] for other in found):
            found.append(good)
    return [(good, len(_all_variants(good))) for good in found]


def _all_variants(good: Good) -> list[tuple[str, str]]:
    """The variants of a good, and the plain colours that none of them has."""
    taken = {color for _, color in good.variants}
    more = [color for color in PAINTS if color not in taken and color not in good.named]
    return [*good.variants, *((color, color) for color in more)]


def _put(
    item: Object,
    usual: Sequence[str],
    surfaces: Sequence[Surface],
    there: dict[str, list[Object]],
    rng: np.random.Generator,
    *,
    full_per_m: float,
) -> Object | None:
    """The thing with a place and a spot; None where there is none."""
    likely = [surface for surface in surfaces if surface.room in usual]
    for _ in range(TRIES):
        among = likely if likely and rng.random() < USUAL else surfaces
        surface = one_of(among, rng)
        others = there[surface.place.id]
        if len(others) >= max(LEAST_FULL, full_per_m * surface.place.size_m[1]):
            continue
        if others and rng.random() < BESIDE:
            at, gap_m = _beside(item, one_of(others, rng), rng), TIGHT_M
        else:
            at, gap_m = _anywhere(item, surface, rng), APART_M
        if surface.takes(item, at, others, gap_m=gap_m):
            yaw = float(5 * rng.integers(-4, 5)) if item.shape == "box" else item.yaw_deg
            if item.kind and not item.lies and not atlas.shape_of(item).is_round:
                yaw = float(5 * rng.integers(-35, 37))
            return msgspec.structs.replace(item, on=surface.place.id, at_m=at, yaw_deg=yaw)
    return None


def _beside(item: Object, other: Object, rng: np.random.Generator) -> tuple[float, float]:
    """Next to another thing, or behind it and before it as seen from the surface's front."""
    gap = float(rng.uniform(TIGHT_M + 0.005, CLOSE_M)) + radius_m(item) + radius_m(other)
    turn = (90, -90, 0, 180)[int(rng.integers(4))] + float(rng.uniform(-10.0, 10.0))
    x, y = other.at_m or (0.0, 0.0)
    return (
        round(x + gap * math.cos(math.radians(turn)), 2),
        round(y + gap * math.sin(math.radians(turn)), 2),
    )


def _anywhere(item: Object, surface: Surface, rng: np.random.Generator) -> tuple[float, float]:
    """Near the front mostly, as people put things down; where there are two sides, near either."""
    depth, width = surface.place.size_m
    rim = radius_m(item) + RIM_M
    deep = max(0.0, min(DEEP_M, depth - rim) - rim)
    ahead = depth / 2 - rim - deep * float(rng.random()) ** 2
    if not surface.has_one_side and rng.random() < TO_THE_BACK:
        ahead = -ahead
    side = max(0.0, width / 2 - radius_m(item))
    return round(ahead, 2), round(float(rng.uniform(-side, side)), 2)


def _sized(good: Good, rng: np.random.Generator) -> tuple[tuple[float, float, float], float]:
    """The size and mass of all things of a category in one home: they are of one set."""
    width, depth, height = good.size_m
    share = float(rng.uniform(0.92, 1.0))
    size = (
        round(width * share, 3),
        round((width if good.shape == "cylinder" else depth) * share, 3),
        round(height * float(rng.uniform(0.92, 1.08)), 3),
    )
    return size, round(good.mass_kg * float(rng.uniform(0.8, 1.15)), 2)
