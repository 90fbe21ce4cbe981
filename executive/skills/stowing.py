"""Arms near the body before walking: home when empty, in the carry posture when holding."""

from __future__ import annotations

from executive.skills.asking import stance_of
from executive.skills.body import SIDES, Body
from executive.skills.reaching import is_at, move_arm, posture_rad
from executive.skills.script import GaveUp, Script
from executive.skills.stepping import step_to
from robot.messages import Side
from robot.planning.requests import Joints
from robot.se3 import SE3

HOME = "nominal"
CARRY = "carry"
STEP_BACK_M = 0.30


def stow_arms(body: Body) -> Script[None]:
    """Bring every empty arm that is not at home there; an arm that holds something stays."""
    for side in SIDES:
        if body.context.holdings.at(side) is None:
            yield from stow_arm(body, side)


def stow_arm(body: Body, side: Side, *, goal_rad: Joints | None = None) -> Script[None]:
    """Bring one arm home (or to `goal_rad`), upright if it holds something.

    Where no motion is free, because the hand is among things, steps back once and tries again.
    """
    holding = body.context.holdings.at(side) is not None
    goal_rad = goal_rad or posture_rad(body, side, CARRY if holding else HOME)
    if is_at(body, side, goal_rad):
        return
    before = body.phase
    body.phase = f"bringing the {side} arm in"
    try:
        yield from move_arm(body, side, goal_rad, keep_upright=holding)
    except GaveUp as end:
        if end.failure.code not in ("no_path", "start_in_collision", "planner_timeout"):
            raise
        back = body.X_WS @ SE3((-STEP_BACK_M, 0.0, 0.0))
        yield from step_to(body, stance_of(back))
        yield from move_arm(body, side, goal_rad, keep_upright=holding)
    body.phase = before
