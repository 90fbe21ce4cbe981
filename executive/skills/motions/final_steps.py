"""Stepping onto an exact stance: the last steps of every walk."""

from __future__ import annotations

import math
from collections.abc import Callable

from executive.skills.motions.body_access import Body
from executive.skills.motions.fingers import check_grips
from executive.skills.motions.personal_space import get_familiar
from executive.skills.motions.planning import pose_of, stance_of
from executive.skills.motions.script import Script, give_up
from robot.messages import Stand, WalkTo
from robot.planning.requests import Stance
from robot.se3 import SE3, wrap_angle

CORRECTIONS = 2
MOVED_M = 0.015
MOVED_RAD = 0.015
REAIM_EVERY_S = 0.5
AIM_SHARE = 0.7
STAND_TIMEOUT_S = 5.0
SETTLE_S = 0.1
"""The newest fix of localisation comes in; the soles rest since the step was reported done."""


def step_to(
    body: Body,
    goal: Stance | Callable[[], Stance],
    *,
    position_tolerance_m: float | None = None,
    yaw_tolerance_rad: float | None = None,
) -> Script[None]:
    """Step straight to a stance of W and stand there, within tolerance, corrected at most twice.

    The tolerances are those of the body unless given; a goal that is asked for may move by some
    centimetres on the way. Gives up with `walk_stalled` when it does not get there.
    """
    exact = body.description.walking.exact_steps
    goal_now = goal if callable(goal) else lambda: goal
    within_m = exact.tolerance_m if position_tolerance_m is None else position_tolerance_m
    within_rad = exact.tolerance_rad if yaw_tolerance_rad is None else yaw_tolerance_rad
    off_m = off_rad = math.inf
    for _ in range(1 + CORRECTIONS):
        yield from _step_once(body, goal_now, tolerance_m=within_m)
        yield from body.wait(SETTLE_S)
        off_m, off_rad = miss(body.X_WS, pose_of(goal_now()))
        if off_m <= within_m and off_rad <= within_rad:
            get_familiar(body)
            return
    raise give_up(
        "walk_stalled",
        f"stopped {off_m * 100:.1f} cm and {math.degrees(off_rad):.1f} deg from where it should",
        off_m=round(off_m, 4),
        off_rad=round(off_rad, 4),
        goal=_words(goal_now()),
        stance=_words(stance_of(body.X_WS)),
    )


def is_at_stance(body: Body, goal: Stance) -> bool:
    """Whether the robot stands there already, exactly enough not to step at all."""
    exact = body.description.walking.exact_steps
    off_m, off_rad = miss(body.X_WS, pose_of(goal))
    return body.state.mode == "stand" and off_m <= exact.there_m and off_rad <= exact.there_rad


def miss(X_WA: SE3, X_WB: SE3) -> tuple[float, float]:
    """Distance on the floor [m] and angle between headings [rad] of two stances."""
    off_rad = abs(wrap_angle(X_WA.yaw_rad - X_WB.yaw_rad))
    return math.dist(X_WA.p[:2], X_WB.p[:2]), off_rad


def _step_once(body: Body, goal: Callable[[], Stance], *, tolerance_m: float) -> Script[None]:
    """One WalkTo, aimed again when the goal has moved, in W or with localisation in N."""
    X_WS_goal = pose_of(goal())
    far_m, far_rad = miss(body.X_WS, X_WS_goal)
    exact = body.description.walking.exact_steps
    patience_s = exact.patience_s_m * far_m + exact.patience_s_rad * far_rad
    end_s = body.now_s + max(exact.least_s, patience_s)
    aim, command_id = _aim(body, X_WS_goal, tolerance_m=tolerance_m)
    aimed_s = body.now_s
    while True:
        yield
        check_grips(body)
        activity = body.activity("legs", command_id)
        if activity is not None and activity.status == "done":
            return
        if activity is not None and activity.status == "failed":
            raise give_up("walk_stalled", f"while {body.phase}: {activity.detail or 'no step'}")
        if body.now_s > end_s:
            yield from _stand(body)  # near enough or not: the caller looks
            return
        X_WS_goal = pose_of(goal())
        moved_m, moved_rad = miss(aim, body.to_N(X_WS_goal))
        if body.now_s - aimed_s > REAIM_EVERY_S and (moved_m > MOVED_M or moved_rad > MOVED_RAD):
            aim, command_id = _aim(body, X_WS_goal, tolerance_m=tolerance_m)
            aimed_s = body.now_s


def _aim(body: Body, X_WS_goal: SE3, *, tolerance_m: float) -> tuple[SE3, int]:
    """Send the body to a stance; returns it in N, and the command's id."""
    exact = body.description.walking.exact_steps
    X_NS = body.to_N(X_WS_goal)
    x_m, y_m, yaw_rad = stance_of(X_NS)
    command = WalkTo(
        **body.header(),
        x_m=x_m,
        y_m=y_m,
        yaw_rad=yaw_rad,
        position_tolerance_m=min(exact.there_m, AIM_SHARE * tolerance_m),
        yaw_tolerance_rad=exact.there_rad,
    )
    return X_NS, body.send(command)


def _stand(body: Body) -> Script[None]:
    body.send(Stand(**body.header()))
    end_s = body.now_s + STAND_TIMEOUT_S
    yield
    while body.state.mode != "stand" and body.now_s < end_s:
        yield


def _words(stance: Stance) -> str:
    return f"({stance[0]:.3f}, {stance[1]:.3f}) m, {math.degrees(stance[2]):.1f} deg"
