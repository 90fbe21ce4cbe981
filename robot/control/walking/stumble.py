"""A foot in the air that meets an edge: a step, a sill, the side of a stone.

The front of a foot that is driven on against an edge is held there by friction, and the leg winds
the foot up about its toe. So one that falls behind its way goes back a little, and over what holds
it; late in a step it comes down before it. What pushes a foot back without bearing it is no floor.
"""

from __future__ import annotations

import math

from robot.se3 import Array

BEHIND_M = 0.02
"""Feet are up to 6 mm behind their way, with the loosest gears 13, also as they catch a push."""
BACK_M = 0.02  # more than it is pressed into what gives
RAISE_M = 0.03  # over an edge that is half as high again as the foot was to clear
MOST_RAISES = 2
OVER_SHARE = 0.55  # of a step: until then there is time to go over
ALONG_SHARE = 0.08  # of the weight that may push along a sole beyond what friction holds: sensors


def bearing(load: list[float], wrenches: Array, weight_n: float) -> list[float]:
    """The share of the weight that each foot bears as a floor bears it: none against a side.

    Args:
        load: what each bears, left and right.
        wrenches: at the ankles, force over torque, shape (2, 6) [N, N m].
        weight_n: of the body.
    """
    return [
        share if math.hypot(*wrenches[k, :2].tolist()) < (share + ALONG_SHARE) * weight_n else 0.0
        for k, share in enumerate(load)
    ]
