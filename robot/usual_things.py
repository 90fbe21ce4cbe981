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
        vary: by which share (1 sigma) most of them are wider and higher, or less, than that.
    """

    kind: Literal["box", "cylinder"]
    size_m: Vector3
    least_m: float
    most_m: float
    mass_kg: float = 0.2
    vary: tuple[float, float] = (0.25, 0.30)


UNKNOWN = Usual("cylinder", (0.07, 0.07, 0.10), 0.01, 0.45, vary=(0.40, 0.60))
"""What nobody knows anything of."""

_CUP = Usual("cylinder", (0.075, 0.075, 0.10), 0.045, 0.16, vary=(0.15, 0.20))
_BOTTLE = Usual("cylinder", (0.065, 0.065, 0.20), 0.04, 0.34, 0.3, (0.18, 0.22))
_MUG = Usual("cylinder", (0.08, 0.08, 0.095), 0.045, 0.16, 0.3, (0.15, 0.15))
_CAN = Usual("cylinder", (0.068, 0.068, 0.113), 0.03, 0.22, 0.3, (0.10, 0.15))
_TIN = Usual("cylinder", (0.08, 0.08, 0.11), 0.03, 0.22, 0.3, (0.18, 0.22))
_SPRAY = Usual("cylinder", (0.06, 0.06, 0.18), 0.04, 0.28, 0.3, (0.18, 0.22))
_PAINT = Usual("cylinder", (0.09, 0.09, 0.11), 0.05, 0.24, 0.8, (0.20, 0.25))
_JAR = Usual("cylinder", (0.075, 0.075, 0.105), 0.04, 0.22, 0.4, (0.18, 0.25))
_BOX = Usual("box", (0.06, 0.06, 0.10), 0.02, 0.35, vary=(0.30, 0.40))
_BOWL = Usual("cylinder", (0.14, 0.14, 0.07), 0.03, 0.30, vary=(0.30, 0.30))
_FRUIT = Usual("cylinder", (0.07, 0.07, 0.07), 0.03, 0.22, vary=(0.25, 0.25))
_CUTLERY = Usual("box", (0.02, 0.18, 0.015), 0.003, 0.36, 0.05, (0.60, 0.50))
_SMALL = Usual("cylinder", (0.05, 0.05, 0.09), 0.02, 0.16, 0.1, (0.25, 0.30))
USUAL: dict[str, Usual] = {
    "egg cup": Usual("cylinder", (0.05, 0.05, 0.065), 0.03, 0.10, 0.06, (0.15, 0.20)),
    "tea cup": Usual("cylinder", (0.09, 0.09, 0.065), 0.04, 0.14, 0.2, (0.15, 0.20)),
    "cup": _CUP, "mug": _MUG, "tumbler": _CUP, "beaker": _CUP,
    "glass": Usual("cylinder", (0.07, 0.07, 0.12), 0.045, 0.25, vary=(0.18, 0.25)),
    "bottle": _BOTTLE, "thermos": Usual("cylinder", (0.075, 0.075, 0.25), 0.05, 0.36, 0.5,
                                        (0.18, 0.20)),
    "dispenser": Usual("cylinder", (0.07, 0.07, 0.18), 0.04, 0.28, 0.4, (0.20, 0.22)),
    "pill bottle": _SMALL, "carton": Usual("box", (0.07, 0.07, 0.20), 0.05, 0.32, 0.6,
                                           (0.20, 0.20)),
    "can": _CAN, "tin": _TIN, "jar": _JAR, "paint jar": _JAR, "spray can": _SPRAY,
    "paint can": _PAINT, "paint tin": _PAINT, "shaker": _SMALL,
    "vase": Usual("cylinder", (0.09, 0.09, 0.20), 0.05, 0.40, 0.5, (0.30, 0.30)),
    "candle": Usual("cylinder", (0.06, 0.06, 0.12), 0.02, 0.32, 0.3, (0.25, 0.40)),
    "torch": Usual("cylinder", (0.04, 0.04, 0.15), 0.02, 0.35, 0.2, (0.25, 0.25)),
    "plant pot": Usual("cylinder", (0.10, 0.10, 0.11), 0.05, 0.30, 0.6, (0.25, 0.25)),
    "trophy": Usual("cylinder", (0.09, 0.09, 0.20), 0.05, 0.45, 0.6, (0.30, 0.30)),
    "brush": Usual("cylinder", (0.04, 0.04, 0.18), 0.01, 0.35, 0.1, (0.40, 0.30)),
    "filter": Usual("cylinder", (0.08, 0.08, 0.10), 0.03, 0.30, 0.3, (0.25, 0.30)),
    "drum": Usual("cylinder", (0.09, 0.09, 0.14), 0.05, 0.40, 0.8, (0.30, 0.35)),
    "glue stick": Usual("cylinder", (0.03, 0.03, 0.10), 0.015, 0.16, 0.05, (0.25, 0.20)),
    "tape roll": Usual("cylinder", (0.09, 0.09, 0.05), 0.01, 0.16, 0.15, (0.25, 0.35)),
    "bandage": Usual("cylinder", (0.06, 0.06, 0.08), 0.02, 0.16, 0.05, (0.25, 0.30)),
    "stopwatch": Usual("cylinder", (0.06, 0.06, 0.03), 0.01, 0.10, 0.1, (0.20, 0.40)),
    "box": _BOX, "packet": _BOX, "cartridge": _BOX, "tray": _BOX, "battery": _BOX,
    "book": Usual("box", (0.15, 0.21, 0.03), 0.005, 0.35, 0.3, (0.40, 0.60)),
    "radio": Usual("box", (0.07, 0.12, 0.12), 0.03, 0.40, 0.5, (0.40, 0.35)),
    "stapler": Usual("box", (0.05, 0.13, 0.06), 0.02, 0.25, 0.3, (0.40, 0.25)),
    "hole punch": Usual("box", (0.08, 0.11, 0.08), 0.03, 0.30, 0.4, (0.30, 0.25)),
    "lunch box": Usual("box", (0.10, 0.14, 0.08), 0.04, 0.30, 0.3, (0.35, 0.25)),
    "remote control": Usual("box", (0.05, 0.16, 0.025), 0.01, 0.26, 0.1, (0.60, 0.35)),
    "wallet": Usual("box", (0.09, 0.11, 0.03), 0.01, 0.22, 0.15, (0.25, 0.40)),
    "pencil case": Usual("box", (0.07, 0.19, 0.05), 0.02, 0.28, 0.2, (0.50, 0.30)),
    "tape measure": Usual("box", (0.05, 0.07, 0.05), 0.02, 0.14, 0.25, (0.20, 0.30)),
    "bowl": _BOWL, "plate": Usual("cylinder", (0.22, 0.22, 0.025), 0.01, 0.32), "saucer": _BOWL,
    "fruit": _FRUIT, "apple": _FRUIT, "orange": _FRUIT, "lemon": _FRUIT, "pear": _FRUIT,
    "tomato": _FRUIT, "peach": _FRUIT, "potato": _FRUIT,
    "fork": _CUTLERY, "knife": _CUTLERY, "spoon": _CUTLERY, "marker": _CUTLERY,
}  # fmt: skip
"""By category; of several words ("blue pill bottle") the last ones say what it is."""


SOLD_IN: dict[str, str] = {
    **dict.fromkeys(("jam", "honey", "marmalade", "mustard", "pesto", "pickles", "salsa"), "jar"),
    **dict.fromkeys(("milk", "juice", "cream"), "carton"),
    **dict.fromkeys(("oil", "vinegar", "wine", "water", "ketchup", "syrup", "sauce", "shampoo",
                     "lotion", "lemonade", "cleaner"), "bottle"),
    **dict.fromkeys(("cola", "soda", "beer", "beans", "soup", "tuna", "paint"), "can"),
    **dict.fromkeys(("cereal", "muesli", "rice", "pasta", "flour", "sugar", "tea", "biscuits",
                     "cookies", "crackers", "tissues", "oats"), "box"),
    **dict.fromkeys(("pills", "tablets", "vitamins"), "pill bottle"),
    **dict.fromkeys(("coffee", "cocoa"), "tin"),
}  # fmt: skip
"""What people call by what is in it ("get the honey"), and what that is usually in."""


def usual(category: str) -> Usual:
    """What things of a category are usually like; `UNKNOWN` where the word says nothing."""
    words = container(category).split()
    known = (USUAL.get(" ".join(words[first:])) for first in range(len(words)))
    return next((one for one in known if one is not None), UNKNOWN)


def container(category: str) -> str:
    """What things of a category are: of what is told by what is in it, what that is in."""
    words = category.replace("_", " ").split()
    kept = SOLD_IN.get(words[-1]) if words else None
    return kept if kept is not None else " ".join(words)
