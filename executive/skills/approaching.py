"""Getting into place for the hand to work: stand off, raise the hand, step in, lean; and back."""

from __future__ import annotations

from executive.skills.body import Body
from executive.skills.reaching import move_arm
from executive.skills.script import Script
from executive.skills.stepping import is_at_stance, step_to
from executive.skills.walking import stand_still, walk_to
from robot.messages import Side
from robot.planning.requests import BodyPosture, Joints, PickPlan, PlacePlan


def approach(body: Body, plan: PickPlan | PlacePlan, *, what: str) -> Script[None]:
    """Walk to the standoff, raise the hand, step in to the stance and take the posture."""
    keep_upright = body.context.holdings.at(plan.side) is not None
    if not is_at_stance(body, plan.stance):
        body.phase = f"walking to the {what}"
        yield from walk_to(body, plan.standoff)
    body.phase = f"raising the {plan.side} hand"
    yield from move_arm(body, plan.side, plan.ready_rad, keep_upright=keep_upright)
    yield from step_in(body, plan, what=what)


def step_in(body: Body, plan: PickPlan | PlacePlan, *, what: str) -> Script[None]:
    """Step to the stance, the hand being raised, and take the posture."""
    if not is_at_stance(body, plan.stance):
        body.phase = f"stepping up to the {what}"
        yield from step_to(body, plan.stance)
    if plan.posture != BodyPosture():
        body.phase = "leaning over"
        posture = plan.posture
        yield from stand_still(
            body,
            height_m=posture.height_m,
            pitch_rad=posture.pitch_rad,
            yaw_rad=posture.yaw_rad,
        )


def withdraw(body: Body, plan: PickPlan | PlacePlan, arm_rad: Joints, *, what: str) -> Script[None]:
    """Straighten up, step back to the standoff, and bring the arm to `arm_rad`."""
    side: Side = plan.side
    if plan.posture != BodyPosture():
        body.phase = "straightening up"
        yield from stand_still(body)
    body.phase = f"stepping back from the {what}"
    yield from step_to(body, plan.standoff, position_tolerance_m=0.06, yaw_tolerance_rad=0.1)
    body.phase = f"bringing the {side} arm in"
    keep_upright = body.context.holdings.at(side) is not None
    yield from move_arm(body, side, arm_rad, keep_upright=keep_upright)
