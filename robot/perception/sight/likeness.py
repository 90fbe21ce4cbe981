"""How well something seen fits something told: by kind, colour and size.

In logarithms of how much likelier it would be seen so if it were that thing than if it were another
one. What fits badly in one respect may be made up for in another, but not without limit.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from robot.messages import ObjectInfo
from robot.perception.sight.tracking import Seen
from robot.perception.things.naming import NOTHING, UNKNOWN, Classes, Sure
from robot.usual_things import usual

PLAIN = 0.5
"""What is of no kind at all may be a plain form of any: a cup without a handle."""
DOUBT, ANY = 0.12, 0.35
"""What the namer may be wrong by, and what a thing that was not told gets of a kind."""
OTHER_KIND = -4.0
"""A thing that is surely of another kind."""
LOOKS_TO_BE_SURE = 3
ALIKE: dict[str, tuple[str, ...]] = {
    "red": ("orange", "brown", "pink", "purple"), "orange": ("red", "brown", "yellow"),
    "yellow": ("orange", "brown", "green"), "green": ("teal", "yellow"),
    "teal": ("green", "blue"), "blue": ("teal", "purple"), "purple": ("blue", "pink", "red"),
    "pink": ("red", "purple"), "brown": ("orange", "black", "red"),
    "white": ("gray", "yellow"), "gray": ("white", "black"), "black": ("gray", "brown"),
}  # fmt: skip
"""Colours that one takes for another in other light."""
ALIKE_COUNTS = 0.35
OTHER_COLOUR, ANY_COLOUR = 0.02, 0.14
SAME_AS = {"grey": "gray", "silver": "gray", "steel": "gray", "charcoal": "black", "cream": "white",
           "beige": "white", "violet": "purple", "turquoise": "teal"}  # fmt: skip
FITS, PER_OCTAVE, LEAST_SIZE = 0.5, 4.0, -4.0
"""A size that such things have; what each factor of two beyond that takes away, and at most."""
MARGIN_M = 0.015
"""Errors of a size."""
HARDLY = 0.1
"""So little of what was seen of a thing had the colour that was told, or one taken for it."""


class Knowledge(NamedTuple):
    """What a namer knows.

    Attributes:
        classes: that it tells apart.
        sure: from which probability it is believed.
        voted: the same of a thing that may be of a kind that it never learnt: then looks that
            agree may all be wrong in the same way.
    """

    classes: Classes
    sure: Sure
    voted: Sure


def likeness(track: Seen, info: ObjectInfo, plural: str, namer: Knowledge) -> float:
    """How well a thing that is seen fits one that was told.

    Args:
        track: what is seen.
        info: what was told: its category and its colour; nothing else of it is looked at.
        plural: of the category.
        namer: what it knows.
    """
    return (
        _kind(track, info.category, plural, namer)
        + _colour(track, info.color)
        + _size(track, info.category)
    )


def kinds_of(category: str, plural: str, classes: Classes) -> frozenset[int]:
    """Which classes of the namer a category is: one of that name, a family, or none."""
    own = category.replace(" ", "_")
    if own in classes.names:
        return frozenset({classes.names.index(own)})
    words = plural.split()
    family = plural if plural in classes.families else words[-1] if words else ""
    return frozenset(
        k
        for k, name in enumerate(classes.families)
        if name == family and classes.names[k] not in (UNKNOWN, NOTHING)
    )


def _kind(track: Seen, category: str, plural: str, namer: Knowledge) -> float:
    classes = namer.classes
    mine = kinds_of(category, plural, classes)
    chances = track.chances
    plain = float(chances[classes.names.index(UNKNOWN)])
    fits = sum(float(chances[k]) for k in mine) + PLAIN * plain
    name = classes.name(chances, namer.sure if mine else namer.voted, track.looks_m)
    is_told = name.kind or name.family
    if is_told and track.looks >= LOOKS_TO_BE_SURE:
        known = classes.names.index(name.kind) if name.kind else -1
        families = {classes.families[k] for k in mine}
        if (known >= 0 and known not in mine) or (known < 0 and name.family not in families):
            return OTHER_KIND
    return math.log((fits + DOUBT) / ANY)


def _colour(track: Seen, told: str) -> float:
    if not told:
        return 0.0
    word = SAME_AS.get(told, told)
    if word not in ALIKE:
        return 0.0  # a word that eyes have no idea of
    share = track.colour_share(word)
    share += ALIKE_COUNTS * sum(track.colour_share(other) for other in ALIKE[word])
    return math.log((min(share, 1.0) + OTHER_COLOUR) / ANY_COLOUR)


def other_colour(track: Seen, told: str) -> str:
    """The colour that a thing plainly has in place of the one that was told; "" if it may be that.

    Args:
        track: what is seen.
        told: the colour that it should have; none, or one that eyes have no idea of, fits all.
    """
    word = SAME_AS.get(told, told)
    if word not in ALIKE or track.colour_looks < LOOKS_TO_BE_SURE:
        return ""
    fits = sum(track.colour_share(one) for one in (word, *ALIKE[word]))
    return track.colours[0] if fits < HARDLY else ""


def _size(track: Seen, category: str) -> float:
    known = usual(category)
    longest, shortest = float(max(track.size_m)), float(min(track.size_m))
    over = max(longest / (known.most_m + MARGIN_M), (known.least_m) / (shortest + MARGIN_M))
    return max(LEAST_SIZE, FITS - PER_OCTAVE * max(0.0, math.log2(max(over, 1e-6))))
