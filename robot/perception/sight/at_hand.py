"""What is seen at a hand that holds something: that thing in pieces, between fingers.

A thing that stood there before the hand came stays what it is: it may be just what the hand is
about to put something on.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from robot.perception.sight.measuring import Measured
from robot.se3 import Array, Vector3

HELD_M = 0.13
"""What is so near to the middle of a thing in a hand is that."""
PIECE_M = 0.2
"""What is so near may be a piece of it: seen only so it is no thing of its own."""


def apart_from_hands(found: Iterable[Measured], held_W: Sequence[Vector3]) -> list[Measured]:
    """What stands somewhere, and not in a hand; what may be a piece of what is in one is marked.

    Args:
        found: things of one picture.
        held_W: middles of what the hands hold [m].
    """
    return [
        one._replace(is_at_hand=_is_near(one.p_W, held_W, PIECE_M))
        for one in found
        if not _is_near(one.p_W, held_W, HELD_M)
    ]


def _is_near(p_W: Array, held_W: Sequence[Vector3], within_m: float) -> bool:
    return any(float(np.linalg.norm(p_W - np.array(held))) < within_m for held in held_W)
