"""The ZMP's way under the feet, from now over the footsteps ahead, and the DCM that belongs to it.

In single support the ZMP rests under the foot that stands, in double support it goes on to the
next, and at the end to the middle of the stance.
"""

from __future__ import annotations

from collections.abc import Sequence

from robot.control.walking.dcm import DcmPlan, Point, Segment
from robot.control.walking.footsteps import Sole, stance_of
from robot.model.gait import Walking

HORIZON_STEPS = 4
"""Footsteps that are looked ahead: with fewer landings than that the walk ends with them."""


def standing(centre: Point, omega_1_s: float) -> DcmPlan:
    """The DCM over the middle of the stance, for ever."""
    return DcmPlan([], centre, omega_1_s)


def coming_to_rest(zmp: Point, centre: Point, duration_s: float, omega_1_s: float) -> DcmPlan:
    """From where the ZMP is to the middle of the stance, in the double support that begins now."""
    return DcmPlan([Segment(zmp, centre, duration_s)], centre, omega_1_s)


def stepping(
    walking: Walking,
    *,
    support: Sole,
    swing: Sole,
    landings: Sequence[Sole],
    single_s: float,
    omega_1_s: float,
    shift: tuple[Point, float] | None = None,
) -> DcmPlan:
    """Onto `support`, then over the landings.

    Args:
        walking: the gait's timing.
        support: the sole that stands, or is about to.
        swing: the other one.
        landings: of it and of those that follow, in turn.
        single_s: time of each single support.
        omega_1_s: the pendulum's frequency.
        shift: where the ZMP is and how long the double support takes that begins now; None: a foot
            lifts now.
    """
    segments: list[Segment] = []
    foot = point_of(support)
    if shift is not None:
        zmp, duration_s = shift
        segments.append(Segment(zmp, foot, duration_s))
    last, current = swing, support
    for k, landing in enumerate(landings):
        segments.append(Segment(foot, foot, single_s))
        last, current = current, landing
        if k + 1 < len(landings):
            following = point_of(landing)
            segments.append(Segment(foot, following, walking.double_support_s))
            foot = following
    if len(landings) < HORIZON_STEPS:
        stance = stance_of(last, current)
        terminal = (stance.x, stance.y)
        segments.append(Segment(foot, terminal, walking.stop_s))
    else:
        terminal = point_of(landings[-1])
        segments.append(Segment(foot, terminal, walking.double_support_s))
    return DcmPlan(segments, terminal, omega_1_s)


def point_of(sole: Sole) -> Point:
    """Where the ZMP is under a foot that bears alone."""
    return (sole.x, sole.y)
