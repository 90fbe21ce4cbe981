"""What a thing is like, as far as its name tells: what people know of cups who see none.

Where the eyes find the things (`--eyes camera`), a robot is told names, categories and colours, and
nothing else: until it has seen a thing, this is what it takes it for. Sizes are those that such
things are commonly sold in; `sim/things/kinds` names sources of many.
"""

from __future__ import annotations

from typing import Literal, NamedTuple

from robot.se3 import Vector3


class Usual(NamedTuple):
    """What things of a category are usually like.

    Attributes:
        kind: the primitive that is most like them.
        size_m: of a usual one: depth, width, height as it stands.
        least_m, most_m: the shortest and the longest side that such a thing may have.
        mass_kg: of a usual one.
    """

    kind: Literal["box", "cylinder"]
    size_m: Vector3
    least_m: float
    most_m: float
    mass_kg: float = 0.2


UNKNOWN = Usual("cylinder", (0.07, 0.07, 0.10), 0.01, 0.45)
"""What nobody knows anything of."""

_CUP = Usual("cylinder", (0.075, 0.075, 0.10), 0.045, 0.16)
_BOTTLE = Usual("cylinder", (0.065, 0.065, 0.20), 0.04, 0.34, 0.3)
_CAN = Usual("cylinder", (0.07, 0.07, 0.11), 0.03, 0.22, 0.3)
_BOX = Usual("box", (0.06, 0.06, 0.10), 0.02, 0.35)
_BOWL = Usual("cylinder", (0.14, 0.14, 0.07), 0.03, 0.30)
_FRUIT = Usual("cylinder", (0.07, 0.07, 0.07), 0.03, 0.22)
_CUTLERY = Usual("box", (0.02, 0.18, 0.015), 0.003, 0.36, 0.05)
USUAL: dict[str, Usual] = {
    "cup": _CUP, "mug": _CUP, "glass": _CUP, "tumbler": _CUP, "beaker": _CUP,
    "bottle": _BOTTLE, "thermos": _BOTTLE, "dispenser": _BOTTLE, "carton": _BOTTLE,
    "can": _CAN, "tin": _CAN, "jar": _CAN,
    "box": _BOX, "packet": _BOX, "book": _BOX,
    "bowl": _BOWL, "plate": Usual("cylinder", (0.22, 0.22, 0.025), 0.01, 0.32), "saucer": _BOWL,
    "fruit": _FRUIT, "apple": _FRUIT, "orange": _FRUIT, "lemon": _FRUIT, "pear": _FRUIT,
    "tomato": _FRUIT, "peach": _FRUIT, "potato": _FRUIT,
    "fork": _CUTLERY, "knife": _CUTLERY, "spoon": _CUTLERY, "marker": _CUTLERY,
}  # fmt: skip
"""By category; of several words ("wine bottle") the last one says what it is."""


def usual(category: str) -> Usual:
    """What things of a category are usually like; `UNKNOWN` where the word says nothing."""
    words = category.replace("_", " ").split()
    return USUAL.get(category) or (USUAL.get(words[-1], UNKNOWN) if words else UNKNOWN)
