"""Getting into place for the hand to work: stand off, raise the hand, step in, lean; and back.

Where there is room for an arm the hand is raised during the last steps to the standoff, and brought
in during the last steps back to it: the feet need not wait for the arm, nor the arm for the feet.
Beside an edge that the arm comes over they do: steps sway a hand there by more than it has room.
"""

from __future__ import annotations

import math

from executive.skills.motions.asking_aside import ask_for_room
from executive.skills.motions.body_access import Body
from executive.skills.motions.final_steps import is_at_stance, miss, step_to
from executive.skills.motions.gaze import look_at
from executive.skills.motions.grasp import followed_stance
from executive.skills.motions.obstructions import clearance_m
from executive.skills.motions.personal_space import get_familiar, somebody_near
from executive.skills.motions.planning import pose_of, stance_of
from executive.skills.motions.reach import move_arm
from executive.skills.motions.script import OVER, Script, side_by_side
from executive.skills.motions.walk import stand_still, walk_near
from robot.failures import Failure
from robot.messages import HoldArm, ObjectInfo
from robot.planning.requests import BodyPosture, Joints, PickPlan, PlacePlan, Stance
from robot.se3 import SE3

BACK_M, BACK_RAD = 0.06, 0.1
"""How exactly it steps back to the standoff."""
TURNED_RAD = 0.35
"""Nearer to the standoff's heading the hand comes up about where it was planned to; before that it
may be anywhere around the body."""


def approach(
    body: Body, plan: PickPlan | PlacePlan, *, what: str, thing: ObjectInfo | None = None
) -> Script[None]:
    """Walk to the standoff, raise the hand, step in to the stance and take the posture.

    The stance for a thing that is to be taken follows where that is seen to be from near by.
    """
    if not is_at_stance(body, plan.stance):
        X_WB = pose_of(plan.standoff) @ _X_SB(body)
        body.phase = f"walking to the {what}"
        yield from walk_near(body, plan.standoff)
        yield from _have_room(body, plan.stance)
        if plan.over is None and _has_room(body, plan.standoff):
            yield from _raise_stepping(body, plan, X_WB=X_WB)
        else:
            yield from step_to(body, plan.standoff)
            yield from _raise(body, plan)
    else:
        yield from _raise(body, plan)
    yield from step_in(body, plan, what=what, thing=thing)


def _have_room(body: Body, stance: Stance) -> Script[None]:
    """Ask who stands within half a metre of where the hand is to work to leave room for it."""
    person = somebody_near(body, (*stance[:2], 0.0))
    if person is not None:
        yield from stand_still(body)
        yield from ask_for_room(body, person)


def _raise(body: Body, plan: PickPlan | PlacePlan, *, X_WB: SE3 | None = None) -> Script[None]:
    body.phase = f"raising the {plan.side} hand"
    keep_upright = body.context.holdings.must_stay_upright(plan.side)
    yield from move_arm(body, plan.side, plan.ready_rad, keep_upright=keep_upright, X_WB=X_WB)


def _raise_stepping(body: Body, plan: PickPlan | PlacePlan, *, X_WB: SE3) -> Script[None]:
    """Raise the hand on the last steps to the standoff; ends when the feet can go straight in."""
    X_WS_goal, feet = pose_of(plan.standoff), step_to(body, plan.standoff)
    there = False
    while not there and not _may_raise(body, X_WS_goal):
        there = next(feet, OVER) is OVER
        yield
    get_familiar(body)
    hand = _raise(body, plan, X_WB=None if there else X_WB)
    while next(hand, OVER) is not OVER or not (there or _is_in_line(body, X_WS_goal)):
        there = next(feet, OVER) is OVER
        yield
    feet.close()


def _may_raise(body: Body, X_WS_goal: SE3) -> bool:
    """Whether the standoff is near, with room for an arm on the way there.

    While the body has yet to turn it is wanted all around.
    """
    within_m = body.description.handy.reaching.raise_within_m
    if not _is_within(body, X_WS_goal, within_m, math.pi):
        return False
    turned = _is_within(body, X_WS_goal, within_m, TURNED_RAD)
    room_m = None if turned else _raised_m(body) + body.description.walking.sway_m
    ends = (body.X_WS, X_WS_goal)
    return all(_has_room(body, stance_of(X_WS), room_m=room_m) for X_WS in ends)


def _raised_m(body: Body) -> float:
    """How far the fingertips of a raised hand get from the middle of the feet, over the floor."""
    handy = body.description.handy
    reaching = handy.reaching
    return math.hypot(reaching.upright_m, max(reaching.aside_m)) + handy.gripping.fingertip_m


def _is_within(body: Body, X_WS_goal: SE3, within_m: float, within_rad: float) -> bool:
    off_m, off_rad = miss(body.X_WS, X_WS_goal)
    return off_m <= within_m and off_rad <= within_rad


def _is_in_line(body: Body, X_WS_goal: SE3) -> bool:
    """Whether the way straight in may be taken from here: the standoff need not be met exactly."""
    steps = body.description.handy.reaching.stepping_in
    X_GS = X_WS_goal.inverse() @ body.X_WS
    return abs(X_GS.p[1]) <= steps.in_line_m and abs(X_GS.yaw_rad) <= steps.in_line_rad


def _X_SB(body: Body) -> SE3:
    """Where the base stands over the feet; of a body that stands."""
    return body.X_WS.inverse() @ body.X_WN @ body.state.X_NB


def _has_room(body: Body, stance: Stance, *, room_m: float | None = None) -> bool:
    """Whether so much is free about a stance; None: what an arm takes that is moved ahead."""
    things = (*body.map.obstacles, *body.world.unmapped)
    room_m = room_m or body.description.handy.reaching.arm_room_m
    return all(clearance_m(stance[:2], thing) >= room_m for thing in things)


def step_in(
    body: Body, plan: PickPlan | PlacePlan, *, what: str, thing: ObjectInfo | None = None
) -> Script[None]:
    """Step to the stance, the hand being raised and the eyes on the goal, and take the posture."""
    look_at(body, plan.X_WG_grasp.p if isinstance(plan, PickPlan) else plan.X_WO.p)

    def stance() -> Stance:
        if thing is not None and isinstance(plan, PickPlan):
            return followed_stance(body, plan, thing)
        return plan.stance

    if not is_at_stance(body, stance()):
        body.phase = f"stepping up to the {what}"
        yield from step_to(body, stance)
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
    steps = body.description.handy.reaching.stepping_in
    short_m = reason.evidence.get("short_m", math.inf)
    if reason.code != "out_of_reach" or not isinstance(short_m, float) or short_m > steps.short_m:
        return False
    short_rad = reason.evidence.get("short_rad", 0.0)
    if isinstance(short_rad, float) and short_rad > steps.short_rad:
        return False  # a step does not turn the hand
    body.phase = "stepping nearer"
    nearer = body.X_WS @ SE3((short_m + steps.nearer_m, 0.0, 0.0))
    yield from step_to(body, stance_of(nearer), position_tolerance_m=steps.nearer_tolerance_m)
    yield from take_posture(body, plan)
    return True


def withdraw(body: Body, plan: PickPlan | PlacePlan, arm_rad: Joints, *, what: str) -> Script[None]:
    """Straighten up, step back to the standoff, and bring the arm to `arm_rad`.

    A hand over an edge is raised first: the trunk goes down as it straightens up. What is held goes
    up with the trunk, as was planned: a hand that has come along a line stays where it is in the
    world, and took a remote control off a sofa into the sofa's arm.
    """
    keep_upright = body.context.holdings.must_stay_upright(plan.side)
    if plan.over is not None and plan.over.away_rad is not None:
        body.phase = f"raising the {plan.side} hand"
        yield from move_arm(body, plan.side, plan.over.away_rad, keep_upright=keep_upright)
    if plan.posture != BodyPosture():
        body.phase = "straightening up"
        if body.context.holdings.at(plan.side) is not None:
            body.send(HoldArm(**body.header(), side=plan.side))
        yield from stand_still(body)
    body.phase = f"stepping back from the {what}"
    X_WS_goal = pose_of(plan.standoff)
    X_WB = X_WS_goal @ _X_SB(body)
    feet = step_to(body, plan.standoff, position_tolerance_m=BACK_M, yaw_tolerance_rad=BACK_RAD)
    near, steps = False, body.description.handy.reaching.stepping_in
    while not near and next(feet, OVER) is not OVER:
        yield
        # What is held turns between the fingers where a swing of the arm and a step come together:
        # a cup by 15 degrees, and it was put down 15 mm off. So its arm waits for the last step,
        # and not for the feet to have settled after it.
        near = plan.over is None and (
            _has_landed(body, X_WS_goal)
            if keep_upright
            else _has_room(body, plan.standoff)
            and _is_within(body, X_WS_goal, steps.bring_in_m, steps.bring_in_rad)
        )
    body.phase = f"bringing the {plan.side} arm in"
    on_the_way = (
        near and not keep_upright
    )  # a base that has landed is where the feet have brought it
    arm = move_arm(
        body, plan.side, arm_rad, keep_upright=keep_upright, X_WB=X_WB if on_the_way else None
    )
    yield from side_by_side(feet, arm)


def _has_landed(body: Body, X_WS_goal: SE3) -> bool:
    """Whether the feet have made their last step to a stance that need not be met exactly."""
    return body.state.mode == "stand" and _is_within(body, X_WS_goal, BACK_M, BACK_RAD)
