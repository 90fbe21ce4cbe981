"""Getting into place for the hand to work: stand off, raise the hand, step in, lean; and back."""

from __future__ import annotations

import math

from executive.skills.motions.body_access import Body
from executive.skills.motions.final_steps import is_at_stance, step_to
from executive.skills.motions.planning import stance_of
from executive.skills.motions.reach import move_arm
from executive.skills.motions.script import Script
from executive.skills.motions.walk import stand_still, walk_to
from robot.failures import Failure
from robot.messages import Side
from robot.planning.requests import BodyPosture, Joints, PickPlan, PlacePlan
from robot.se3 import SE3

MOST_SHORT_M = 0.04
MOST_SHORT_RAD = 0.1
NEARER_M = 0.015
NEARER_TOLERANCE_M = 0.012


def approach(body: Body, plan: PickPlan | PlacePlan, *, what: str) -> Script[None]:
    """Walk to the standoff, raise the hand, step in to the stance and take the posture."""
    keep_upright = body.context.holdings.must_stay_upright(plan.side)
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
    yield from take_posture(body, plan)


def take_posture(body: Body, plan: PickPlan | PlacePlan) -> Script[None]:
    """Lean or turn the trunk as planned for the stance."""
    posture = plan.posture
    if posture == BodyPosture():
        return
    body.phase = "leaning over"
    yield from stand_still(
        body, height_m=posture.height_m, pitch_rad=posture.pitch_rad, yaw_rad=posture.yaw_rad
    )


def come_nearer(body: Body, plan: PickPlan | PlacePlan, reason: Failure) -> Script[bool]:
    """Step forward by what an arm was short of its pose, if that is a few centimetres.

    The stretched arm shifts the balance, so the body stands a little behind where it was planned.
    Returns whether it stepped.
    """
    short_m = reason.evidence.get("short_m", math.inf)
    if reason.code != "out_of_reach" or not isinstance(short_m, float) or short_m > MOST_SHORT_M:
        return False
    short_rad = reason.evidence.get("short_rad", 0.0)
    if isinstance(short_rad, float) and short_rad > MOST_SHORT_RAD:
        return False  # a step does not turn the hand
    body.phase = "stepping nearer"
    nearer = body.X_WS @ SE3((short_m + NEARER_M, 0.0, 0.0))
    yield from step_to(body, stance_of(nearer), position_tolerance_m=NEARER_TOLERANCE_M)
    yield from take_posture(body, plan)
    return True


def withdraw(body: Body, plan: PickPlan | PlacePlan, arm_rad: Joints, *, what: str) -> Script[None]:
    """Straighten up, step back to the standoff, and bring the arm to `arm_rad`."""
    yield from back_away(body, plan, what=what)
    yield from bring_in(body, plan.side, arm_rad)


def back_away(body: Body, plan: PickPlan | PlacePlan, *, what: str) -> Script[None]:
    """Straighten up and step back to the standoff, the hand still out."""
    if plan.posture != BodyPosture():
        body.phase = "straightening up"
        yield from stand_still(body)
    body.phase = f"stepping back from the {what}"
    yield from step_to(body, plan.standoff, position_tolerance_m=0.06, yaw_tolerance_rad=0.1)


def bring_in(body: Body, side: Side, arm_rad: Joints) -> Script[None]:
    """Bring an arm near the body, upright if it holds something."""
    body.phase = f"bringing the {side} arm in"
    keep_upright = body.context.holdings.must_stay_upright(side)
    yield from move_arm(body, side, arm_rad, keep_upright=keep_upright)
