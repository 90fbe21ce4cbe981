"""What a DCM error asks of the step under way: where to land, and when.

The stance foot takes small errors back through its ZMP; shifting or retiming a step for those only
shakes the swing foot. So an error counts only as far as the ZMP is at the edge of the foot.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from robot.control.walking.dcm import Point

TIMES = 9
"""Durations that are tried: one unknown, so that some are exact enough."""


def error_at_end(
    error: float, correction: float, left_s: float, *, omega_1_s: float, gain_1_s: float
) -> float:
    """DCM error [m] along one axis after `left_s`.

    While the ZMP is inside the foot the error decays with the feedback, exp(-k t). With the ZMP at
    the edge, `correction` [m] from its reference, what that cannot hold grows with exp(omega t).
    """
    decayed = error * math.exp(-gain_1_s * left_s)
    grown = correction + (error - correction) * math.exp(omega_1_s * left_s)
    return max(decayed, grown) if error > 0.0 else min(decayed, grown)


def dcm_at_end(xi: Point, zmp: Point, left_s: float, omega_1_s: float) -> Point:
    """Where the DCM [m] will be after `left_s` if the ZMP stays: p + (xi - p) exp(omega t)."""
    growth = math.exp(omega_1_s * left_s)
    return zmp[0] + growth * (xi[0] - zmp[0]), zmp[1] + growth * (xi[1] - zmp[1])


def cheapest_time(cost: Callable[[float], float], shortest_s: float, longest_s: float) -> float:
    """The duration [s] of a few between the bounds, both among them, that costs least.

    Time and place of a landing are chosen together, as in Khadiv et al., "Walking control based on
    step timing adaptation", 2020; one unknown, so that trying some is exact enough.
    """
    span_s = max(0.0, longest_s - shortest_s) / (TIMES - 1)
    return min((shortest_s + i * span_s for i in range(TIMES)), key=cost)


def nearest_time(
    begins: Callable[[float], Point], xi: Point, shortest_s: float, longest_s: float
) -> float:
    """The time [s] to shift the weight in, of which the plan begins nearest to where the DCM is.

    Soon where it runs ahead. Where the foot came down early the DCM has not got there yet: with the
    weight on the new foot at once the robot is left behind, and has to run backwards after it.

    Args:
        begins: the DCM [m] at which the plan of such a shift begins.
        xi: the measured DCM [m].
        shortest_s: the least time.
        longest_s: the most.
    """
    return cheapest_time(lambda shift_s: math.dist(xi, begins(shift_s)), shortest_s, longest_s)
