"""What names say of where a thing belongs: a paint can stands on the paint rack sooner than a cup.

Of things that look alike the one that shares a word with what it stands on is the likelier one.
Both names are an owner's; that a thing has to stand where it belongs nobody says.
"""

from __future__ import annotations

from collections.abc import Sequence

from robot.messages import ObjectInfo, Place
from robot.perception.sight.tracking import Seen

BELONGS = 1.0
"""How much likelier, in logarithms."""
OVER_EDGE_M, LEVEL_M = 0.04, 0.05
LEAST_LETTERS = 3


def belonging(track: Seen, info: ObjectInfo, places: Sequence[Place]) -> float:
    """What speaks for a thing by its name and that of the surface that it is seen on.

    Args:
        track: what is seen.
        info: what was told.
        places: surfaces of the map.
    """
    mine = _words(info.name) | _words(info.category)
    under = (place for place in places if not place.floor and _stands_on(track, place))
    return BELONGS if any(mine & _words(place.name) for place in under) else 0.0


def _words(name: str) -> set[str]:
    return {word for word in name.lower().replace("_", " ").split() if len(word) >= LEAST_LETTERS}


def _stands_on(track: Seen, place: Place) -> bool:
    x, y, _ = place.X_WP.inverse().apply(tuple(track.p_W.tolist()))
    inside = (
        abs(x) <= 0.5 * place.size_m[0] + OVER_EDGE_M
        and abs(y) <= 0.5 * place.size_m[1] + OVER_EDGE_M
    )
    return inside and abs(track.last.foot_m - place.X_WP.p[2]) < LEVEL_M
