"""How long a planned way takes: the follower of the skills leads a point along it.

What the point cannot show is added: getting under way, the exact steps at the end, and that a body
sways where a point does not. They were fitted to six ways of 2.5 to 5 m with bends and turns,
of which none then took 4 % longer or shorter; other ways may be further off.
"""

from __future__ import annotations

import math

from executive.skills.motions.path_follower import Follower, turn_towards
from executive.skills.motions.planning import pose_of
from executive.skills.motions.walk import cruise_m_s, facing_the_way, is_there
from robot.model.description import RobotDescription
from robot.planning.requests import BasePath, Stance
from robot.se3 import SE3, wrap_angle

WALK_M_S, TURN_RAD_S = 0.23, 0.38
"""Where no way is planned: a step by so much, or one too many."""
BEGIN_S = 1.5
"""Of such a step: getting under way, coming to a stand."""
PERIOD_S = 0.05
SET_OFF_S, STEP_IN_S, SWAY = 0.8, 2.2, 1.05
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
    return SWAY * (SET_OFF_S + spent_s + STEP_IN_S)


def straight_s(start: Stance, goal: Stance) -> float:
    """About how long the straight line takes, where no way is planned [s]."""
    return BEGIN_S + math.dist(start[:2], goal[:2]) / WALK_M_S


def turning_s(angle_rad: float) -> float:
    """About how long turning on the spot takes, getting under way left out [s]."""
    return abs(angle_rad) / TURN_RAD_S
