"""Arms near the body before walking: home when empty, in the carry posture when holding."""

from __future__ import annotations

from executive.skills.motions.back_away import back_away
from executive.skills.motions.body_access import Body
from executive.skills.motions.final_steps import step_to
from executive.skills.motions.obstructions import may_step
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
    the hand is among things, steps back once and tries again.
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
        if end.failure.code not in ("no_path", "start_in_collision", "planner_timeout"):
            raise
        steps_m = body.description.handy.reaching.steps_back_m
        back = next((back for back_m in steps_m if (back := _free_behind(body, back_m))), None)
        if back is None:
            raise
        yield from step_to(body, stance_of(back))
        yield from move_arm(body, side, goal_rad, keep_upright=keep_upright)
    body.phase = before


def _free_behind(body: Body, back_m: float) -> SE3 | None:
    """The stance so far straight back, if nothing stands there."""
    back = body.X_WS @ SE3((-back_m, 0.0, 0.0))
    things = (*body.map.obstacles, *body.world.unmapped)
    here, there = (body.X_WS.p[0], body.X_WS.p[1]), (back.p[0], back.p[1])
    radius_m = body.description.body_radius_m
    return back if may_step(here, there, things, radius_m=radius_m) else None
