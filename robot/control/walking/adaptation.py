"""What a DCM error asks of the step under way: where to land, and when.

The stance foot takes small errors back through its ZMP; shifting or retiming a step for those only
shakes the swing foot. So an error counts only as far as the ZMP is at the edge of the foot.
"""

from __future__ import annotations

import math

DCM_GAIN_1_S = 4.0


def error_at_end(error: float, correction: float, left_s: float, omega_1_s: float) -> float:
    """DCM error [m] along one axis after `left_s`.

    While the ZMP is inside the foot the error decays with the feedback, exp(-k t). With the ZMP at
    the edge, `correction` [m] from its reference, what that cannot hold grows with exp(omega t).
    """
    decayed = error * math.exp(-DCM_GAIN_1_S * left_s)
    grown = correction + (error - correction) * math.exp(omega_1_s * left_s)
    return max(decayed, grown) if error > 0.0 else min(decayed, grown)


def time_to_reach(now: float, end: float, omega_1_s: float) -> float:
    """Time [s] until the DCM, `now` [m] from a constant ZMP, is `end` from it on the same side.

    From xi(t) - p = (xi(0) - p) exp(omega t): Khadiv et al., "Walking control based on step timing
    adaptation", 2020, for one axis. Infinite where it never gets there.
    """
    if now < 0.005 or end < 0.005:
        return math.inf
    return math.log(end / now) / omega_1_s
