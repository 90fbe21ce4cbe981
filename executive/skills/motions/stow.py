"""Arms near the body before walking: home when empty, in the carry posture when holding."""

from __future__ import annotations

from executive.skills.motions.back_away import back_away
from executive.skills.motions.body_access import Body
from executive.skills.motions.final_steps import step_to
from executive.skills.motions.free_floor import ROUND_RAD, free_stance
from executive.skills.motions.planning import stance_of
from executive.skills.motions.reach import is_at, move_arm, posture_rad
from executive.skills.motions.script import GaveUp, Script
from robot.messages import Side
from robot.se3 import SE3

HOME = "nominal"


def stow_arms(body: Body) -> Script[None]:
    """Bring both arms in, each where it is not yet: home, or to how it carries what it holds."""
    for side in body.description.arm_sides:
        yield from stow_arm(body, side)


def stow_arm(body: Body, side: Side) -> Script[None]:
    """Bring one arm in.

    Steps back from somebody who is too near for the arm to move. Where no motion is free, because
    the hand is among things, steps back once and tries again; where something stands so near that
    the arm has no place at the body's side, steps to where it has.
    """
    held = body.context.holdings.at(side)
    goal_rad = held.carry_rad if held is not None else posture_rad(body, side, HOME)
    if is_at(body, side, goal_rad):
        return
    yield from back_away(body, side)
    keep_upright = body.context.holdings.must_stay_upright(side)
    before = body.phase
    body.phase = f"bringing the {side} arm in"
    try:
        yield from move_arm(body, side, goal_rad, keep_upright=keep_upright)
    except GaveUp as end:
        X_WS_clear = _clear_stance(body, end.failure.code)
        if X_WS_clear is None:
            raise
        yield from step_to(body, stance_of(X_WS_clear))
        yield from move_arm(body, side, goal_rad, keep_upright=keep_upright)
    body.phase = before


def _clear_stance(body: Body, code: str) -> SE3 | None:
    """Where to step to, of an arm that cannot come in; None if that would not help."""
    match code:
        case "no_path" | "start_in_collision" | "planner_timeout":
            return free_stance(body)
        case "goal_in_collision":
            return free_stance(body, towards_rad=ROUND_RAD, wide=True)
        case _:
            return None
