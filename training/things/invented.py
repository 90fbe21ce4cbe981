"""Kinds of things that there are not: what looks like something of a household, and is none of it.

Made of the catalogue's own forms, with outlines, proportions, handles, caps and prints drawn at
random; every other one is a kind of the catalogue out of all proportion. What comes out too like a
kind of the catalogue, one that is never learnt included, is drawn again: a thing of it may rightly
be called one of no kind, and teaches nothing of those that are judged by.
"""

from __future__ import annotations

import math
from functools import lru_cache

import msgspec
import numpy as np

from sim.palette import COLORS
from sim.things import catalogue
from sim.things.catalogue import (
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
    Style,
    Vary,
    Vessel,
)
from sim.things.making import sized
from training.things.likes import are_alike
from training.things.splits import STRANGERS, Split

INVENTED = "invented "
"""How the names of these kinds begin; what form they are of follows."""
NUMBERS: dict[Split, tuple[int, int]] = {
    "train": (0, 100_000), "choose": (100_000, 200_000), "judge": (200_000, 300_000),
}  # fmt: skip
"""Which of them a split has: none is in two."""
WARPED_SHARE = 0.5
LEAST_WARP, MOST_WARP = 0.12, 0.7
"""Logarithm of a factor by which a kind is out of proportion: from a little more than its own
things differ by, so that sizes are learnt to count."""
TRIES = 200
MATERIALS = ("stoneware", "porcelain", "plastic", "steel", "paper", "wood", "glass")
STYLES: tuple[Style, ...] = ("brand", "stripes", "dots", "rings")
TEXTS = ("aqua", "nova", "kiko", "fresh", "extra", "no 7", "lumo", "bio", "classic", "zest")

Rng = np.random.Generator


@lru_cache(maxsize=4096)
def invented(number: int) -> Kind:
    """A kind that a number makes, the same one always the same kind."""
    rng = np.random.default_rng([7919, number])
    for _ in range(TRIES):
        kind = _warped(rng) if rng.random() < WARPED_SHARE else _drawn(rng)
        if not any(are_alike(kind, other) for other in catalogue.kinds().values()):
            return kind
    raise AssertionError(f"kind {number}: everything is like something of the catalogue")


def name(kind: Kind) -> str:
    """What a picture's truth calls things of such a kind."""
    return INVENTED + type(kind.of).__name__.lower()


def _warped(rng: Rng) -> Kind:
    """A kind of the catalogue, wider or narrower, higher or lower than any of that kind."""
    every = [one for key, one in sorted(catalogue.kinds().items()) if key not in STRANGERS]
    kind = every[int(rng.integers(len(every)))]
    across, up = (float(rng.normal(0.0, 0.06)) for _ in range(2))
    change = float(rng.choice((-1.0, 1.0)) * rng.uniform(LEAST_WARP, MOST_WARP))
    which = int(rng.integers(3))
    across, up = across + change * (which != 1), up + change * (which != 0) * (1 - 2 * (which == 2))
    form = sized(kind.of, math.exp(across), math.exp(up))
    if isinstance(form, Vessel) and rng.random() < 0.4:
        form = msgspec.structs.replace(
            form, handle=None if form.handle else _handle(form.profile_m, rng)
        )
    return msgspec.structs.replace(
        kind, of=form, colors=_colors(rng) if rng.random() < 0.5 else kind.colors,
        print=kind.print if rng.random() < 0.6 else _print(rng), vary=Vary(across=0.02, up=0.02),
        mass_kg=None,
    )  # fmt: skip


def _drawn(rng: Rng) -> Kind:
    """A kind whose form is drawn from nothing."""
    draw = (_vessel, _closed, _packet, _fruit, _flat, _bent)
    form = draw[int(rng.choice(len(draw), p=(0.3, 0.3, 0.15, 0.1, 0.1, 0.05)))](rng)
    has_print = isinstance(form, Vessel | Closed | Packet) and rng.random() < 0.6
    return Kind(
        source="drawn at random", of=form, colors=_colors(rng),
        material=MATERIALS[int(rng.integers(len(MATERIALS)))],
        print=_print(rng) if has_print else None, vary=Vary(across=0.04, up=0.04),
    )  # fmt: skip


def _between(rng: Rng, low: float, high: float) -> float:
    """A length, as likely twice as long as half."""
    return math.exp(float(rng.uniform(math.log(low), math.log(high))))


def _profile(rng: Rng, least_m: float, most_m: float) -> tuple[tuple[float, float], ...]:
    """An outline of three to seven points from a foot upwards."""
    height, radius = _between(rng, least_m, most_m), _between(rng, 0.014, 0.065)
    count = int(rng.integers(2, 7))
    steps = rng.normal(0.0, 0.28, count)
    radii = np.clip(radius * np.exp(np.cumsum(steps) - steps[0]), 0.008, 0.11)
    heights = np.sort(rng.uniform(0.06, 0.94, count - 1)) if count > 1 else np.zeros(0)
    levels = np.concatenate([[0.0], heights, [1.0]]) * height
    radii = np.concatenate([[0.93 * radii[0]], radii])
    keep = np.concatenate([[True], np.diff(levels) > 0.002])
    return tuple((float(r), float(z)) for r, z in zip(radii[keep], levels[keep], strict=True))


def _handle(profile_m: tuple[tuple[float, float], ...], rng: Rng) -> Handle:
    height = profile_m[-1][1]
    high, low = float(rng.uniform(0.6, 0.95)) * height, float(rng.uniform(0.1, 0.45)) * height
    return Handle(high_m=high, low_m=low, out_m=_between(rng, 0.012, 0.06),
                  thick_m=_between(rng, 0.005, 0.016))  # fmt: skip


def _vessel(rng: Rng) -> Vessel:
    profile = _profile(rng, 0.025, 0.28)
    thin = min(r for r, _ in profile)
    wall = min(float(rng.uniform(0.001, 0.006)), 0.3 * thin)
    return Vessel(
        profile_m=profile, wall_m=wall, floor_m=min(0.3 * profile[-1][1], wall + 0.004),
        smooth=int(rng.integers(3)), inside=_color(rng) if rng.random() < 0.3 else "",
        handle=_handle(profile, rng) if rng.random() < 0.4 else None,
    )  # fmt: skip


def _closed(rng: Rng) -> Closed:
    profile = _profile(rng, 0.03, 0.33)
    height, has_cap = profile[-1][1], rng.random() < 0.55
    cap = Cap(from_m=float(rng.uniform(0.65, 0.94)) * height, color=_color(rng),
              wider_m=float(rng.uniform(0.0005, 0.004)),
              spout_m=_between(rng, 0.02, 0.07) if rng.random() < 0.15 else 0.0)  # fmt: skip
    rims = "steel" if not has_cap and rng.random() < 0.3 else ""
    return Closed(profile_m=profile, wall_m=0.0005, smooth=int(rng.integers(3)),
                  cap=cap if has_cap else None, rims=rims)  # fmt: skip


def _packet(rng: Rng) -> Packet:
    x, y, z = (_between(rng, *limits) for limits in ((0.02, 0.13), (0.04, 0.2), (0.02, 0.28)))
    return Packet(size_m=(x, y, z), edge_m=float(rng.uniform(0.0005, 0.2 * min(x, y))),
                  gable_m=float(rng.uniform(0.15, 0.4)) * z if rng.random() < 0.15 else 0.0,
                  pages="cream" if rng.random() < 0.1 else "")  # fmt: skip


def _fruit(rng: Rng) -> Fruit:
    radius, count = _between(rng, 0.018, 0.06), int(rng.integers(4, 8))
    high = radius * _between(rng, 0.9, 4.5)
    levels = np.linspace(0.0, 1.0, count)
    round_ = np.sqrt(np.clip(1.0 - (2.0 * levels - 1.0) ** 2, 0.0, 1.0))
    radii = radius * np.clip(round_ * np.exp(rng.normal(0.0, 0.18, count)), 0.0, 1.3)
    radii[0], radii[-1] = 0.35 * radius, 0.0
    profile = ((0.0, 0.0), *zip(radii.tolist(), (high * levels).tolist(), strict=True))
    return Fruit(profile_m=profile, lies=bool(rng.random() < 0.4),
                 stem_m=_between(rng, 0.005, 0.03) if rng.random() < 0.3 else 0.0)  # fmt: skip


def _flat(rng: Rng) -> Flat:
    length, count = _between(rng, 0.07, 0.30), int(rng.integers(3, 7))
    at = np.linspace(0.0, 1.0, count) * length
    sections = tuple(
        Section(x_m=float(x), width_m=_between(rng, 0.006, 0.07), thick_m=thick, z_m=0.5 * thick)
        for x in at
        if (thick := _between(rng, 0.0015, 0.022))
    )
    return Flat(sections=sections, grip=int(rng.integers(1, count - 1)),
                grip_color=_color(rng) if rng.random() < 0.4 else "")  # fmt: skip


def _bent(rng: Rng) -> Bent:
    length = _between(rng, 0.08, 0.3)
    return Bent(length_m=length, radius_m=_between(rng, 0.006, 0.03),
                bend_m=float(rng.uniform(0.0, 0.35)) * length,
                tips=_color(rng) if rng.random() < 0.4 else "")  # fmt: skip


def _print(rng: Rng) -> Print:
    low = float(rng.uniform(0.05, 0.4))
    return Print(
        style=STYLES[int(rng.integers(len(STYLES)))], text=TEXTS[int(rng.integers(len(TEXTS)))],
        low=low, high=low + float(rng.uniform(0.15, 0.55)),
        colors=_colors(rng) if rng.random() < 0.5 else (),
    )  # fmt: skip


def _color(rng: Rng) -> str:
    names = sorted(COLORS)
    return names[int(rng.integers(len(names)))]


def _colors(rng: Rng) -> tuple[str, ...]:
    return tuple(_color(rng) for _ in range(3))
