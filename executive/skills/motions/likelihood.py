"""Where a thing is likely to be: what people put where, and what has been seen of it here.

Weights, not probabilities: they order the looks. A wrong one costs a detour, never a find, for in
the end everything is looked at.
"""

from __future__ import annotations

from collections.abc import Iterable

from executive.skills.motions.habits import usual_places
from executive.skills.motions.support import surface_under
from executive.skills.motions.survey import Prospect
from robot.messages import ObjectInfo, Place, Track, WorldMap

LYING = 0.3
"""Beds and sofas hold things now and then; tables, counters, shelves and cabinets are for it."""
KINDS = {"bed": LYING, "sofa": LYING, "box": 0.5, "chair": 0.1}
HANDY_M = (0.5, 1.3)
"""Surfaces at heights that people put things on; a lower crate or a higher machine is not one."""
LARGEST_BLOCK_M2 = 1.0
"""A solid block with a larger top is a machine."""
ODD_HEIGHT = 0.4
SAME_WORD, SAME_NAME = 6.0, 20.0
"""A filter is kept in the filter rack, a picture book on the picture book shelf, not the cart."""
ALIKE_HERE, ALIKE_NEAR = 3.0, 1.5
"""Others of its sort were seen on the surface, or in the same room."""
KEPT_THERE = 4.0
"""Mugs are kept in kitchens, glue on workbenches."""
LONG_WORD = 4
SAID, LIKELY, UNLIKELY = range(3)
"""Ranks: where it was said to be, then where it may well be, then everywhere else."""


def prospects(
    info: ObjectInfo, world_map: WorldMap, tracks: Iterable[Track], *, said: Iterable[str] = ()
) -> list[Prospect]:
    """Every surface of the map with how likely an object is to be there; `said`: ids of places."""
    seen = [(track, world_map.object(track.id)) for track in tracks if _is_known(track)]
    here: dict[str, list[ObjectInfo]] = {}
    surfaces = surfaces_of(world_map)
    for track, other in seen:
        on = surface_under(track.X_WO, surfaces) if track.X_WO is not None else None
        if on is not None and other is not None and other.id != info.id:
            here.setdefault(on.id, []).append(other)
    rooms = {
        place.room
        for place in surfaces
        if any(other.category == info.category for other in here.get(place.id, ()))
    }
    kept = usual_places(info, world_map)
    wanted = frozenset(said)
    found: list[Prospect] = []
    for place in surfaces:
        things = here.get(place.id, [])
        called_so = _same_word(info, place)
        odd = called_so == 1.0 and place.id not in kept and _is_odd(place, things)
        rank = SAID if place.id in wanted else UNLIKELY if odd else LIKELY
        alike = any(other.category == info.category for other in things)
        near = ALIKE_NEAR if place.room and place.room in rooms else 1.0
        worth = _usual(place) * (ALIKE_HERE if alike else near)
        worth *= KEPT_THERE if place.room in kept or place.id in kept else 1.0
        found.append(Prospect(place=place, worth=worth * called_so, rank=rank))
    return found


def surfaces_of(world_map: WorldMap) -> list[Place]:
    """Every surface once: a shelf as a whole is one of its boards by another name."""
    found: dict[tuple[float, ...], Place] = {}
    for place in world_map.places:
        if not place.floor:
            found.setdefault(place.X_WP.p, place)
    return list(found.values())


def _usual(place: Place) -> float:
    """How often things are put there, whatever they are."""
    handy = HANDY_M[0] <= place.X_WP.p[2] <= HANDY_M[1]
    return KINDS.get(place.kind, 1.0) * (1.0 if handy else ODD_HEIGHT)


def _is_odd(place: Place, things: list[ObjectInfo]) -> bool:
    """Whether nobody looks there first: a seat, a machine, a crate; unless things are on it."""
    if things:
        return False
    if place.kind == "chair":
        return True
    handy = HANDY_M[0] <= place.X_WP.p[2] <= HANDY_M[1]
    block = place.kind == "box" and place.size_m[0] * place.size_m[1] > LARGEST_BLOCK_M2
    return block or (place.kind == "box" and not handy)


def _same_word(info: ObjectInfo, place: Place) -> float:
    """More for a place that is called after such things: "bookshelf" for a book, "toy chest"."""
    names = (info.plain_name, info.category, *info.synonyms)
    words = {word.casefold() for name in names for word in name.split()} - {place.kind}
    called = " ".join((place.name, *place.synonyms)).casefold().split()
    shared = {word for word in words if any(_begins(name, word) for name in called)}
    sort = set(info.category.casefold().split())
    if len(sort) > 1 and sort <= shared:
        return SAME_NAME
    return SAME_WORD if shared else 1.0


def _begins(name: str, word: str) -> bool:
    """Whether a name begins with a word; with a short one only if it is that."""
    return name.startswith(word) if len(word) >= LONG_WORD else name == word and len(word) > 2


def _is_known(track: Track) -> bool:
    return track.X_WO is not None and not track.missing and track.held_by is None
