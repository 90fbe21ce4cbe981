"""How long a planned way takes: the follower of the skills leads a point along it.

What the point cannot show is added (`paces` of the description): getting under way, the exact steps
at the end, and that a body sways where a point does not.
"""

from __future__ import annotations

import math

from executive.skills.motions.path_follower import Follower, turn_towards
from executive.skills.motions.planning import pose_of
from executive.skills.motions.walk import cruise_m_s, facing_the_way, is_there
from robot.model.description import RobotDescription
from robot.model.paces import Paces
from robot.planning.requests import BasePath, Stance
from robot.se3 import SE3, wrap_angle

PERIOD_S = 0.05  # in which skills are stepped, so that the way takes as long as the follower takes
LONGEST_S = 600.0


def walking_s(
    start: Stance, path: BasePath, description: RobotDescription, *, carrying: bool
) -> float:
    """About how long a planned way takes, from standing to standing [s]."""
    gait, goal = description.walking, path.waypoints[-1]
    path = facing_the_way(start, path, free_m=description.body_radius_m)
    speeds_m_s = cruise_m_s(path, gait, carrying=carrying)
    follower = Follower(start, path.waypoints, walking=gait, speeds_m_s=speeds_m_s)
    at, spent_s = pose_of(start), 0.0
    while not is_there(at, follower, goal) and spent_s < LONGEST_S:
        twist = follower.twist(at)
        if follower.done:
            twist = turn_towards(wrap_angle(goal[2] - at.yaw_rad), gait)
        forward_m, left_m = twist.forward_m_s * PERIOD_S, twist.left_m_s * PERIOD_S
        at = at @ SE3.from_xy_yaw(forward_m, left_m, twist.turn_rad_s * PERIOD_S)
        spent_s += PERIOD_S
    paces = description.paces
    return paces.sway * (paces.set_off_s + spent_s + paces.step_in_s)


def straight_s(start: Stance, goal: Stance, paces: Paces) -> float:
    """About how long the straight line takes, where no way is planned [s]."""
    return paces.begin_s + math.dist(start[:2], goal[:2]) / paces.walk_m_s


def turning_s(angle_rad: float, paces: Paces) -> float:
    """About how long turning on the spot takes, getting under way left out [s]."""
    return abs(angle_rad) / paces.turn_rad_s
