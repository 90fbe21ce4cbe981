"""Where something stands that nobody has made out: there a surface has not been looked over yet.

A thing that is seen and has no name, or one that another told thing might have as well, may be the
one that is looked for. It is let be once it was seen so well that one more look as good would not
tell more.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from robot.perception.sight.recognising import SETTLED
from robot.perception.sight.tracking import Seen
from robot.perception.things.eyes import SeenThing
from robot.se3 import Vector3

WELL_ENOUGH = 3
"""Looks from near by at a whole thing: in homes names that come at all have come by then."""


def doubtful(
    tracks: Iterable[Seen], clear: Mapping[int, float], cut_off: Iterable[SeenThing]
) -> tuple[Vector3, ...]:
    """Middles of what may be something else still [m], in W.

    Args:
        tracks: all that is believed to stand somewhere.
        clear: of those that have a name, by number, how much likelier it is than others.
        cut_off: things of the last picture that go on beyond its border.
    """
    open_ = (
        one.p_W
        for one in tracks
        if one.near_looks < WELL_ENOUGH and clear.get(one.number, 0.0) < SETTLED
    )
    return tuple(
        (float(x), float(y), float(z)) for x, y, z in (*open_, *(one.p_W for one in cut_off))
    )
