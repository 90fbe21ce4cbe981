"""Pick up an object: find it, stand before it, grasp it by sight, lift it, and step back."""

from __future__ import annotations

import math

from executive.skills.approaching import approach, come_nearer, withdraw
from executive.skills.asking import ask, stance_of
from executive.skills.context import SkillContext
from executive.skills.finding import find
from executive.skills.gripping import (
    LEAST_GAP_M,
    check_grips,
    close_fingers,
    open_fingers,
    set_payload,
)
from executive.skills.holding import Held
from executive.skills.looking import fresh_track, see
from executive.skills.parameters import PickParams
from executive.skills.reaching import move_arm, move_hand, posture_rad
from executive.skills.script import GaveUp, Script, give_up
from executive.skills.scripted import ScriptedSkill
from executive.skills.stowing import HOME, stow_arms
from executive.skills.support import pose_on_support, surroundings
from robot.messages import ObjectInfo
from robot.planning.requests import PickPlan, PickRequest
from robot.se3 import SE3

APPROACH_M_S = 0.12
LIFT_M_S = 0.12
LOWER_M_S = 0.06
OPEN_MARGIN_M = 0.045
GAP_TOLERANCE_M = 0.015
FOLLOW_AT_MOST_M = 0.04
FRESH_S = 0.5
REACH_CORRECTIONS = 2
GRAVITY_M_S2 = 9.81
LEAST_LOAD = 0.3
MOVE_THE_BASE = ("out_of_reach", "no_path", "goal_in_collision", "planner_timeout")


class Pick(ScriptedSkill):
    """Take an object off a surface with one hand; ends in the carry posture, clear of it."""

    resources = frozenset({"legs", "head", "left_arm", "right_arm"})

    def __init__(self, parameters: PickParams, context: SkillContext) -> None:
        """What to take."""
        super().__init__(context)
        self.parameters = parameters
        self._tare_n = 0.0
        self._reached = False
        self._X_WG_closed: SE3 | None = None

    def script(self) -> Script[None]:
        """Find, approach, grasp, lift, withdraw; on a failure withdraw all the same."""
        body = self.body
        info = body.object_info(self.parameters.object_id)
        held_already = self._check_hands(info)
        yield from stow_arms(body)
        if held_already:
            return
        yield from find(body, info.id)
        plan = yield from self._plan(info)
        body.progress = 0.1
        yield from approach(body, plan, what=info.name)
        try:
            body.progress = 0.4
            plan = yield from self._grasp(info, plan)
            body.progress = 0.7
            yield from self._lift(info, plan)
        except GaveUp as end:
            yield from self._back_off(plan, info)
            raise end
        body.progress = 0.85
        yield from withdraw(body, plan, plan.carry_rad, what=info.name)
        check_grips(body)

    def _check_hands(self, info: ObjectInfo) -> bool:
        """Whether the object is in a hand already; gives up if the hand wanted is not free."""
        holdings = self.body.context.holdings
        if holdings.find(info.id) is not None:
            return True
        free = holdings.free_sides()
        wanted = self.parameters.side
        if not free or (wanted is not None and wanted not in free):
            names = ", ".join(held.object_id for held in holdings.all())
            raise give_up("hands_full", f"no free hand for the {info.name}", held=names)
        return False

    def _plan(self, info: ObjectInfo, *, attempt: int = 0) -> Script[PickPlan]:
        """Ask for a grasp and a stance, with the hand that is free."""
        self.body.phase = f"planning how to take the {info.name}"
        free = self.body.context.holdings.free_sides()
        side = self.parameters.side or (free[0] if len(free) == 1 else None)
        request = PickRequest(
            object_id=info.id,
            around=surroundings(self.body),
            start=stance_of(self.body.X_WS),
            side=side,
            seed=self.body.context.seed + attempt,
        )
        return (yield from ask(self.body, request, PickPlan))

    def _grasp(self, info: ObjectInfo, plan: PickPlan) -> Script[PickPlan]:
        """Bring the open fingers around the object and close them. Returns the plan carried out."""
        body = self.body
        plan, X_WO = yield from self._reach(info, plan)
        side = plan.side
        body.phase = f"moving in on the {info.name}"
        yield from move_hand(
            body, side, lambda: self._where(info, X_WO) @ plan.X_OG, speed_m_s=APPROACH_M_S
        )
        body.phase = f"closing the {side} fingers"
        self._tare_n = body.hand(side).load_n
        gap_m = yield from close_fingers(body, side)
        self._X_WG_closed = body.X_WG(side)
        X_GO = _centred(body.X_WG(side).inverse() @ self._where(info, X_WO))
        self._check_gap(info, plan, gap_m)
        body.context.holdings.take(
            Held(
                object_id=info.id,
                side=side,
                X_GO=X_GO,
                gap_m=gap_m,
                mass_kg=info.mass_kg,
                carry_rad=plan.carry_rad,
            )
        )
        set_payload(body, side, info.mass_kg)
        return plan

    def _reach(self, info: ObjectInfo, plan: PickPlan) -> Script[tuple[PickPlan, SE3]]:
        """Look, and move to the pre-grasp; moves the base if it is out of reach from here."""
        body = self.body
        for attempt in range(1 + REACH_CORRECTIONS):
            body.phase = f"looking at the {info.name}"
            X_WO = yield from see(body, info.id)
            body.phase = f"reaching for the {info.name}"
            opening_m = plan.opening_m + OPEN_MARGIN_M
            yield from open_fingers(body, plan.side, opening_m=opening_m)
            X_OG_pre = plan.X_OG @ (plan.X_WG_grasp.inverse() @ plan.X_WG_pre)
            try:
                yield from move_arm(body, plan.side, X_WO @ X_OG_pre, near_rad=plan.pre_rad)
            except GaveUp as end:
                if attempt == REACH_CORRECTIONS or end.failure.code not in MOVE_THE_BASE:
                    raise
                if (yield from come_nearer(body, plan, end.failure)):
                    continue
                plan = yield from self._plan(info, attempt=attempt + 1)
                yield from self._step_over(plan, info)
                continue
            self._reached = True
            return plan, X_WO
        raise AssertionError("unreachable")

    def _step_over(self, plan: PickPlan, info: ObjectInfo) -> Script[None]:
        """Go to another stance: back to where the hand can be raised, then in again."""
        yield from stow_arms(self.body)
        yield from approach(self.body, plan, what=info.name)

    def _where(self, info: ObjectInfo, X_WO: SE3) -> SE3:
        """The object now: as just seen, unless that is stale or far from where it was."""
        track = fresh_track(self.body, info.id, self.body.now_s - FRESH_S)
        if track is None or track.X_WO is None:
            return X_WO
        X_WO_now = pose_on_support(self.body, info.id, track.X_WO)
        moved_m = math.dist(X_WO_now.p, X_WO.p)
        return X_WO_now if moved_m <= FOLLOW_AT_MOST_M else X_WO

    def _check_gap(self, info: ObjectInfo, plan: PickPlan, gap_m: float) -> None:
        """The fingers must have closed on the object, about where it is as wide as planned."""
        if gap_m < LEAST_GAP_M:
            cause = f"the fingers closed on air, not on the {info.name}"
        elif abs(gap_m - plan.opening_m) > GAP_TOLERANCE_M:
            cause = f"the fingers pinched the {info.name} off its middle"
        else:
            return
        raise give_up(
            "grasp_missed",
            cause,
            object=info.id,
            gap_m=round(gap_m, 4),
            expected_m=round(plan.opening_m, 4),
        )

    def _lift(self, info: ObjectInfo, plan: PickPlan) -> Script[None]:
        """Lift straight up, and see by gap and weight that the object came along."""
        body, side = self.body, plan.side
        body.phase = f"lifting the {info.name}"
        X_WG_grasp = body.X_WG(side)
        rise = tuple(b - a for a, b in zip(plan.X_WG_grasp.p, plan.X_WG_lift.p, strict=True))
        p_W = tuple(a + b for a, b in zip(X_WG_grasp.p, rise, strict=True))
        X_WG_lift = SE3((p_W[0], p_W[1], p_W[2]), X_WG_grasp.quat_wxyz)
        yield from move_hand(body, side, lambda: X_WG_lift, speed_m_s=LIFT_M_S)
        yield from body.wait(0.4)
        check_grips(body)
        load_n = body.hand(side).load_n - self._tare_n
        if load_n < LEAST_LOAD * GRAVITY_M_S2 * info.mass_kg:
            raise give_up(
                "grasp_missed",
                f"the {info.name} did not come up with the hand",
                object=info.id,
                load_n=round(load_n, 2),
                expected_n=round(GRAVITY_M_S2 * info.mass_kg, 2),
            )

    def _back_off(self, plan: PickPlan, info: ObjectInfo) -> Script[None]:
        """After a failure: let go, draw the hand back the way it came, step back, arm home."""
        body, side = self.body, plan.side
        body.context.holdings.release(side)
        set_payload(body, side, 0.0)
        try:
            if self._X_WG_closed is not None:
                X_WG_closed = self._X_WG_closed  # never let go above nothing
                yield from move_hand(body, side, lambda: X_WG_closed, speed_m_s=LOWER_M_S)
            if self._reached:
                yield from open_fingers(body, side)
                body.phase = "drawing the hand back"
                X_WG_back = body.X_WG(side) @ (plan.X_WG_grasp.inverse() @ plan.X_WG_pre)
                yield from move_hand(body, side, lambda: X_WG_back, speed_m_s=APPROACH_M_S)
            yield from withdraw(body, plan, posture_rad(body, side, HOME), what=info.name)
        except GaveUp:
            return  # the first failure is the one to report; the halting script does the rest


def _centred(X_GO: SE3) -> SE3:
    """The two coupled fingers centre what they close on: no offset along their direction y."""
    return SE3((X_GO.p[0], 0.0, X_GO.p[2]), X_GO.quat_wxyz)
