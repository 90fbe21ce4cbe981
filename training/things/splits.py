"""What is learnt from, what thresholds are chosen on, and what figures are told of."""

from __future__ import annotations

from typing import Literal, NamedTuple

from robot.perception.things import usual_sizes
from robot.se3 import Vector3
from sim.things import catalogue
from sim.things.making import made

Split = Literal["train", "choose", "judge"]

STRANGERS = (
    "travel_mug", "vase", "butter_packet", "coffee_tin", "saucer", "toothbrush", "potato",
    "paint_can",
)  # fmt: skip
"""Kinds that are never learnt, at least one of most families: unknown to the network, as a home's
own things are. They are in no picture but those it is judged on."""


class Rooms(NamedTuple):
    """What rooms of a split are like.

    Attributes:
        hues: of walls and furniture, from and to, of a circle of 1.
        floors: coverings.
        furniture: kinds of it.
        variants: of things, from and to: sizes, colours, prints.
    """

    hues: tuple[float, float]
    floors: tuple[str, ...]
    furniture: tuple[str, ...]
    variants: tuple[int, int]


_WARM, _COLD = (-0.30, 0.45), (0.47, 0.68)
_USUAL = ("table", "counter", "shelf", "box")
ROOMS: dict[Split, Rooms] = {
    "train": Rooms(_WARM, ("tiles", "wood"), _USUAL, (0, 400)),
    "choose": Rooms(_WARM, ("tiles", "wood"), _USUAL, (400, 500)),
    "judge": Rooms(
        _COLD, ("carpet", "concrete"), (*_USUAL, "cabinet", "sofa", "chair"), (500, 999)
    ),
}
"""Rooms that figures are told of are blue, on carpet or concrete, with furniture that was never
seen in training; and the forms, colours and prints of the things in them are others."""


def kinds(split: Split) -> tuple[str, ...]:
    """Kinds of things that are in the pictures of a split."""
    every = tuple(sorted(catalogue.kinds()))
    return every if split == "judge" else tuple(k for k in every if k not in STRANGERS)


def sizes_of_kinds() -> str:
    """How large things of the kinds are that are learnt, as a network's notes tell it."""
    sizes: dict[str, tuple[Vector3, Vector3]] = {}
    for kind in kinds("train"):
        (x, y, z), vary = made(kind).size_m, catalogue.kind(kind).vary
        sizes[kind] = ((max(x, y), min(x, y), z), (vary.across, vary.across, vary.up))
    return usual_sizes.written(sizes)


def family(kind: str) -> str:
    """Which family a kind is of; empty: of none, as it is not in the catalogue."""
    return next((name for name, members in catalogue.families().items() if kind in members), "")
