"""Moving an arm: planned motions around things, and straight lines that follow what moves."""

from __future__ import annotations

import math
from collections.abc import Callable

from executive.skills.motions.body_access import ARM_CHANNEL, Body
from executive.skills.motions.fingers import check_grips
from executive.skills.motions.personal_space import near_hand, wait_for_room
from executive.skills.motions.planning import ask, held_in
from executive.skills.motions.rest import hold_arm
from executive.skills.motions.script import GaveUp, Script, give_up
from executive.skills.motions.support import surroundings
from robot.messages import MoveArm, MoveHand, Side
from robot.planning.requests import ArmPlan, ArmRequest, Joints
from robot.se3 import SE3

ARM_TIMEOUT_S = 4.0
LINE_TIMEOUT_S = 5.0
RETARGET_M = 0.004
RETARGET_EVERY_S = 0.2
SAME_POSTURE_RAD = 0.15
PLAN_ATTEMPTS = 2  # another seed may find what sampling missed
INTERRUPTIONS = 4
SAMPLING = ("no_path", "planner_timeout")


def move_arm(
    body: Body,
    side: Side,
    goal: SE3 | Joints,
    *,
    keep_upright: bool = False,
    allowed: tuple[str, ...] = (),
    near_rad: Joints | None = None,
    speed: float = 1.0,
    X_WB: SE3 | None = None,
) -> Script[None]:
    """Plan a motion of an arm to joint values or a pose X_WG, and carry it out.

    It is planned for the base at X_WB, where the feet are about to bring it (None: where it is).
    Waits while somebody is near the hand, and plans again. Gives up with the planner's failure,
    `arm_stalled`, `person_near` or `object_dropped`.
    """
    for _ in range(INTERRUPTIONS):
        plan = yield from _plan(
            body,
            lambda attempt: ArmRequest(
                side=side,
                q_start_rad=body.state.q_rad,
                X_WB=X_WB or body.X_WN @ body.state.X_NB,
                goal=goal,
                around=surroundings(body),
                held=held_in(body, side),
                keep_upright=keep_upright,
                allowed=allowed,
                near_rad=near_rad,
                speed=speed,
                seed=body.context.seed + attempt,
            ),
        )
        command = MoveArm(
            **body.header(), side=side, times_s=plan.times_s, positions_rad=plan.positions_rad
        )
        body.send(command)
        timeout_s = plan.duration_s + ARM_TIMEOUT_S
        if (yield from _finish_arm(body, side, command.id, timeout_s=timeout_s)):
            return
    raise give_up("person_near", f"somebody came near again and again while {body.phase}")


def move_hand(
    body: Body,
    side: Side,
    target: Callable[[], SE3],
    *,
    speed_m_s: float,
    stop_load_n: float | None = None,
    near_rad: Joints | None = None,
) -> Script[None]:
    """Move the hand on a straight line to a pose X_WG, aimed again as the pose moves.

    With `near_rad` the elbow goes where it is at these joints.
    `target` is asked every tick, so it follows the newest localisation and sight of the object.
    Gives up with `arm_stalled` or `object_dropped`.
    """
    end_s = body.now_s + LINE_TIMEOUT_S + 3.0 * _off_m(body, side, target()) / speed_m_s
    aim: SE3 | None = None
    aimed_s = -math.inf
    command_id = 0
    while True:
        X_NG = body.to_N(target())
        moved_m = math.inf if aim is None else math.dist(aim.p, X_NG.p)
        if moved_m > RETARGET_M and body.now_s - aimed_s >= RETARGET_EVERY_S:
            aim, aimed_s = X_NG, body.now_s
            command_id = body.send(
                MoveHand(
                    **body.header(),
                    side=side,
                    X_NG=X_NG,
                    speed_m_s=speed_m_s,
                    stop_load_n=stop_load_n,
                    near_rad=near_rad or (),
                )
            )
        yield
        check_grips(body)
        activity = body.activity(ARM_CHANNEL[side], command_id)
        if activity is not None and activity.status == "done":
            return
        if near_hand(body, body.X_WG(side).p) is not None:
            before_s = body.now_s
            yield from _yield_to_people(body, side)
            aim, aimed_s, end_s = None, -math.inf, end_s + body.now_s - before_s
            continue
        if body.now_s > end_s or (activity is not None and activity.status == "failed"):
            detail = activity.detail if activity is not None else "it did not begin"
            raise give_up(
                "arm_stalled",
                f"the {side} hand stopped {_off_m(body, side, target()) * 100:.1f} cm short "
                f"while {body.phase}: {detail or 'too slow'}",
                off_m=round(_off_m(body, side, target()), 4),
            )


def posture_rad(body: Body, side: Side, name: str) -> Joints:
    """Joint values of an arm in a named posture of the description."""
    values = body.description.posture(name)
    return tuple(values[index] for index in body.description.indices(f"{side}_arm"))


def is_at(body: Body, side: Side, goal_rad: Joints) -> bool:
    """Whether an arm is about where these joint values say."""
    pairs = zip(body.arm_rad(side), goal_rad, strict=True)
    return all(abs(a - b) < SAME_POSTURE_RAD for a, b in pairs)


def _plan(body: Body, request: Callable[[int], ArmRequest]) -> Script[ArmPlan]:
    """Ask for an arm motion, once more with another seed if sampling found none."""
    for attempt in range(PLAN_ATTEMPTS):
        try:
            return (yield from ask(body, request(attempt), ArmPlan))
        except GaveUp as end:
            if attempt + 1 == PLAN_ATTEMPTS or end.failure.code not in SAMPLING:
                raise
    raise AssertionError("unreachable")


def _finish_arm(body: Body, side: Side, command_id: int, *, timeout_s: float) -> Script[bool]:
    """Wait until a motion is done; False if it was interrupted because somebody came near."""
    end_s = body.now_s + timeout_s
    while True:
        yield
        check_grips(body)
        activity = body.activity(ARM_CHANNEL[side], command_id)
        if activity is not None and activity.status == "done":
            return True
        if near_hand(body, body.p_WE(side)) is not None:
            yield from _yield_to_people(body, side)
            return False
        if body.now_s > end_s or (activity is not None and activity.status == "failed"):
            detail = activity.detail if activity is not None else "it did not begin"
            raise give_up(
                "arm_stalled", f"the {side} arm stopped while {body.phase}: {detail or 'too slow'}"
            )


def _yield_to_people(body: Body, side: Side) -> Script[None]:
    """Hold the arm where it is until there is room again."""
    hold_arm(body, side)
    yield from wait_for_room(body, body.p_WE(side))


def _off_m(body: Body, side: Side, X_WG: SE3) -> float:
    return math.dist(body.X_WG(side).p, X_WG.p)
