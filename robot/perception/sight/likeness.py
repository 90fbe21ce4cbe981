"""How well something seen fits something told: by kind, colour, size and form.

In logarithms of how much likelier it would be seen so if it were that thing than if it were another
one. What fits badly in one respect may be made up for in another, but not without limit.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from robot.messages import ObjectInfo
from robot.perception.sight.tracking import Seen
from robot.perception.things.naming import NOTHING, UNKNOWN, Classes, Sure
from robot.usual_things import UNKNOWN as UNKNOWN_THING
from robot.usual_things import container, usual

PLAIN = 0.5
"""What is of no kind at all may be a plain form of any: a cup without a handle."""
DOUBT, ANY = 0.12, 0.35
"""What the namer may be wrong by, and what a thing that was not told gets of a kind."""
OTHER_KIND = -4.0
"""A thing that is surely of another kind."""
LOOKS_TO_BE_SURE = 3
FEW = 0.5
"""Looks with all pixels that one wants: what a kind says after so few counts half. From 1.8 m a
plain can was "a mug" in two looks, and the mug beside it got its name."""
_BIT = 0.12
ALIKE: dict[str, dict[str, float]] = {
    "red": {"orange": 0.2, "brown": _BIT, "pink": 0.2, "purple": _BIT},
    "orange": {"red": 0.2, "brown": 0.25, "yellow": _BIT},
    "yellow": {"orange": 0.2, "brown": _BIT, "green": _BIT},
    "green": {"teal": 0.2, "yellow": _BIT},
    "teal": {"green": 0.25, "blue": 0.25},
    "blue": {"teal": 0.2, "purple": 0.2},
    "purple": {"blue": 0.2, "pink": 0.2, "red": _BIT},
    "pink": {"red": 0.25, "purple": 0.2, "orange": _BIT},
    "brown": {"orange": 0.25, "black": _BIT, "red": _BIT},
    "white": {"gray": 0.5, "yellow": _BIT},
    "gray": {"white": 0.25, "black": 0.2},
    "black": {"gray": 0.2, "brown": _BIT},
}  # fmt: skip
"""Colours that one takes for another in other light, and how often: of things in homes within 2 m
the first word was the told colour of all but 1 in 50, and white was gray in half of the looks."""
OTHER_COLOUR, ANY_COLOUR = 0.02, 0.14
WARM, WARM_SPREAD, MOST_WARM = 0.05, 0.02, 1.2
"""Between what white and what cream things show of a warm hue, how much that varies, and what it
says at most."""
CREAM = ("cream", "beige", "ivory")
SAME_AS = {"grey": "gray", "silver": "gray", "steel": "gray", "charcoal": "black", "cream": "white",
           "beige": "white", "ivory": "white", "violet": "purple", "turquoise": "teal"}  # fmt: skip
FITS, PER_OCTAVE, LEAST_SIZE = 0.5, 4.0, -4.0
"""What a usual size says, what each factor of two beyond sizes that such things may have takes
away, and at most."""
LEAST_ERROR = 0.06
"""A share of a size that eyes are wrong by at least."""
NARROW, USUAL_SPREAD = 1.0, 0.22
"""What has the size that things of a kind have is the likelier of that kind the less they vary:
cups are of nearly one size, filters of any."""
STANDS = -0.3
"""What speaks against a box that stands otherwise than such boxes usually do."""
MOST_FORM = 2.5
"""What a round box, or a cup with corners, takes away at most."""
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
        + _form(track, info.category)
    )


def kinds_of(category: str, plural: str, classes: Classes) -> frozenset[int]:
    """Which classes of the namer a category is: one of that name, a family, or none.

    A carton is every carton that it knows, and what is told by its contents ("jam") is what has
    that word, or is what such things are usually in.
    """
    own = category.replace(" ", "_")
    if own in classes.names:
        return frozenset({classes.names.index(own)})
    words = plural.split()
    family = plural if plural in classes.families else words[-1] if words else ""
    found = {
        k
        for k, name in enumerate(classes.families)
        if name == family and classes.names[k] not in (UNKNOWN, NOTHING)
    }
    if not found:
        asked = {word.split()[-1] for word in (category, container(category)) if word}
        found = {k for k, name in enumerate(classes.names) if asked & set(name.split("_"))}
    return frozenset(found)


def _kind(track: Seen, category: str, plural: str, namer: Knowledge) -> float:
    classes = namer.classes
    mine = kinds_of(category, plural, classes)
    chances = track.chances
    plain = float(chances[classes.names.index(UNKNOWN)])
    fits = sum(float(chances[k]) for k in mine) + PLAIN * plain
    found = math.log((fits + DOUBT) / ANY) * track.support / (track.support + FEW)
    if not mine and usual(category) is UNKNOWN_THING:
        return found  # a word that eyes have no idea of: it may be of a kind that they know
    name = classes.name(chances, namer.sure if mine else namer.voted, track.looks_m)
    is_told = name.kind or name.family
    if is_told and track.looks >= LOOKS_TO_BE_SURE:
        known = classes.names.index(name.kind) if name.kind else -1
        families = {classes.families[k] for k in mine}
        if (known >= 0 and known not in mine) or (known < 0 and name.family not in families):
            return OTHER_KIND
    return found


def _colour(track: Seen, told: str) -> float:
    if not told:
        return 0.0
    word = SAME_AS.get(told, told)
    if word not in ALIKE:
        return 0.0  # a word that eyes have no idea of
    share = track.colour_share(word)
    share += sum(often * track.colour_share(other) for other, often in ALIKE[word].items())
    return math.log((min(share, 1.0) + OTHER_COLOUR) / ANY_COLOUR) + _tint(track, told, word)


def _tint(track: Seen, told: str, word: str) -> float:
    """What tells cream from white and gray, which are one word otherwise."""
    if word not in ("white", "gray"):
        return 0.0
    warm = (track.warmth - WARM) / WARM_SPREAD
    odds = warm if told in CREAM else -warm
    return min(max(odds, -MOST_WARM), 0.0)


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
    """By how a thing's width and height go with those of such things."""
    known = usual(category)
    longest, shortest = float(max(track.size_m)), float(min(track.size_m))
    over = max(longest / (known.most_m + MARGIN_M), (known.least_m) / (shortest + MARGIN_M))
    if over > 1.0:
        return max(LEAST_SIZE, -PER_OCTAVE * math.log2(over))
    _, _, high_m, wide_m = track.size_m.tolist()
    lies = high_m < wide_m and known.size_m[2] > 1.2 * max(known.size_m[:2])
    if lies or known is UNKNOWN_THING:
        return 0.0
    x_m, y_m, z_m = known.size_m
    ways = [(0.5 * (x_m + y_m), z_m, 0.0)]
    if known.kind == "box":  # a book on a shelf stands on its edge
        ways += [(0.5 * (x_m + z_m), y_m, STANDS), (0.5 * (y_m + z_m), x_m, STANDS)]
    found = LEAST_SIZE
    for told_wide_m, told_high_m, turned in ways:
        fits = FITS + turned
        for seen_m, told_m, vary in (
            (wide_m, told_wide_m, known.vary[0]),
            (high_m, told_high_m, known.vary[1]),
        ):
            error = max(LEAST_ERROR, track.size_sigma_m / max(seen_m, 1e-3))
            spread = math.hypot(vary, error)
            fits -= 0.5 * (math.log(seen_m / told_m) / spread) ** 2
            fits -= NARROW * math.log(spread / USUAL_SPREAD)
        found = max(found, fits)
    return found


def spread_malus(category: str) -> float:
    """What the sizes of a kind take away from all that fits it, as they vary; 0 at the most."""
    known = usual(category)
    if known is UNKNOWN_THING:
        return 0.0
    spreads = (math.hypot(vary, LEAST_ERROR) for vary in known.vary)
    return min(0.0, -NARROW * sum(math.log(spread / USUAL_SPREAD) for spread in spreads))


def _form(track: Seen, category: str) -> float:
    """By whether a thing is round, where such things are known to be round or boxes."""
    known = usual(category)
    if known is UNKNOWN_THING:
        return 0.0
    odds = track.roundness if known.kind == "cylinder" else -track.roundness
    return min(max(odds, -MOST_FORM), 0.0)
