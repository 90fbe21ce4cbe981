"""Pick up an object: find it, stand before it, grasp it by sight, lift it, and step back."""

from __future__ import annotations

import contextlib

from executive.skills.ability import no_hand
from executive.skills.context import SkillContext
from executive.skills.forecast import Forecast, Outlook
from executive.skills.holding import Held
from executive.skills.motions.approach import approach, come_nearer, withdraw
from executive.skills.motions.fingers import (
    begin_opening,
    check_grips,
    check_taken,
    close_fingers,
    open_fingers,
    set_payload,
)
from executive.skills.motions.fitting_grasp import ask_fitting
from executive.skills.motions.gaze import see
from executive.skills.motions.grasp import (
    aim,
    centred,
    check_gap,
    check_reachable,
    followed,
    has_fallen,
    last_seen,
)
from executive.skills.motions.look_over import limit_s
from executive.skills.motions.object_search import find
from executive.skills.motions.planning import stance_of
from executive.skills.motions.reach import move_arm, move_hand, posture_rad
from executive.skills.motions.script import GaveUp, Script, give_up
from executive.skills.motions.stow import HOME, stow_arms
from executive.skills.motions.support import UPRIGHT_RAD, surroundings, tilt
from executive.skills.parameters import SkillParams
from executive.skills.scripted import ScriptedSkill
from robot.failures import Failure, failure
from robot.messages import ObjectInfo, Side, WorldMap
from robot.model.description import RobotDescription
from robot.physics import GRAVITY_M_S2
from robot.planning.requests import WALK_COST_PER_M, PickPlan, PickRequest
from robot.se3 import SE3

GRASPS = 2
REACH_CORRECTIONS = 2
MOVE_OVER_COST_PER_M = 0.5
"""Cost of walking to another stance once the robot stands before the object."""
LEAST_LOAD = 0.3
"""Of the weight: less means that it did not come up with the hand."""
MOVE_THE_BASE = ("out_of_reach", "no_path", "goal_in_collision", "planner_timeout")


class PickParams(SkillParams, frozen=True, kw_only=True):
    """Take an object; without a side the planner chooses the hand.

    With `for_place_id` in a way in which it can be put on that place afterwards, if there is one.
    """

    object_id: str
    side: Side | None = None
    for_place_id: str | None = None


class Pick(ScriptedSkill[PickParams]):
    """Take an object off a surface with one hand; ends in the carry posture, clear of it."""

    name = "pick"
    summary = "find a thing, take it with one hand, and step back with it"
    takes = PickParams
    resources = frozenset({"legs", "head", "left_arm", "right_arm"})

    @classmethod
    def lack(cls, wanted: PickParams, robot: RobotDescription) -> str:
        """A hand."""
        return no_hand(robot, wanted.side)

    @classmethod
    def refusal(
        cls, wanted: PickParams, world_map: WorldMap, robot: RobotDescription
    ) -> Failure | None:
        """What no hand closes on, or carries."""
        info = world_map.object(wanted.object_id)
        if info is None:
            text = f"there is no object {wanted.object_id!r} in this world"
            return failure("unknown_object", text)
        holds = info.shape.held_pieces
        width_m = min(min(one.size_m[:2]) for one in holds or (info.shape,))
        opening_m = (
            max(hand.max_opening_m for hand in robot.hands.values()) - robot.handy.gripping.spare_m
        )
        if width_m > opening_m:
            text = f"{info.full_name} is {width_m * 100:.0f} cm wide, the hand opens to hold "
            return failure("no_grasp", f"{text}{opening_m * 100:.0f} cm", width_m=width_m)
        if not holds:
            text = f"{info.full_name} has no upright sides for fingers to close on"
            return failure("no_grasp", text)
        most_kg = robot.arms.max_lift_kg
        if info.mass_kg > most_kg:
            text = f"{info.full_name} weighs {info.mass_kg:g} kg, a hand carries {most_kg:g} kg"
            return failure("invalid_goal", text, suggestion="name something lighter")
        return None

    @classmethod
    def forecast(cls, wanted: PickParams, outlook: Outlook) -> Forecast:
        """The way, and what it typically takes there."""
        return outlook.pick(wanted.object_id, side=wanted.side).then(outlook.robot.paces.pick_s)

    def __init__(self, parameters: PickParams, context: SkillContext) -> None:
        """What to take."""
        super().__init__(parameters, context)
        self._tare_n = 0.0
        self._begin_s = 0.0
        self._X_WG_pre: SE3 | None = None
        self._X_WG_closed: SE3 | None = None
        self._closing: Side | None = None
        self._stance: PickPlan | None = None  # the plan at whose stance it stands

    def limit_s(self) -> float:
        """As long as it takes to look everywhere, and then some."""
        return limit_s(self.body)

    def script(self) -> Script[None]:
        """Find, approach, grasp, lift, withdraw; on a failure withdraw all the same."""
        body = self.body
        self._begin_s = body.now_s
        info = body.object_info(self.parameters.object_id)
        held_already = self._check_hands(info)
        yield from stow_arms(body)
        if held_already:
            return
        X_WO = yield from find(body, info.id)
        check_reachable(body, info, X_WO)
        plan = yield from self._plan(info)
        body.progress = 0.1
        plan = yield from self._get_there(info, plan)
        self._stance = plan
        try:
            body.progress = 0.4
            plan = yield from self._grasp(info, plan)
        except GaveUp as end:
            yield from self._back_off(info)
            raise end
        body.progress = 0.85
        yield from withdraw(body, plan, plan.carry_rad, what=info.name)
        check_grips(body)
        check_taken(body)

    def halt(self) -> Script[None]:
        """Fingers that were closing open again: what is between them is not held for certain."""
        if self._closing is not None:
            with contextlib.suppress(GaveUp):  # then they stay as they are
                yield from open_fingers(self.body, self._closing)
        yield from super().halt()

    def _check_hands(self, info: ObjectInfo) -> bool:
        """Whether the object is in a hand already; gives up if the hand wanted is not free."""
        holdings = self.body.context.holdings
        if holdings.find(info.id) is not None:
            check_taken(self.body)
            return True
        free = holdings.free_sides()
        wanted = self.parameters.side
        if not free or (wanted is not None and wanted not in free):
            names = ", ".join(held.object_id for held in holdings.all())
            raise give_up("hands_full", f"no free hand for the {info.name}", held=names)
        return False

    def _get_there(self, info: ObjectInfo, plan: PickPlan) -> Script[PickPlan]:
        """Walk up with the hand raised; where no way up is found for it, with the other one.

        Sampling found none in all its checks, and asked again it mostly finds none again.
        """
        body = self.body
        try:
            yield from approach(body, plan, what=info.name, thing=info)
        except GaveUp as end:
            free = body.context.holdings.free_sides()
            others: list[Side] = [side for side in free if side != plan.side]
            chosen = self.parameters.side is not None
            if end.failure.code != "planner_timeout" or chosen or not others:
                raise
            plan = yield from self._plan(info, attempt=1, side=others[0])
            yield from stow_arms(body)
            yield from approach(body, plan, what=info.name, thing=info)
        return plan

    def _plan(
        self, info: ObjectInfo, *, attempt: int = 0, side: Side | None = None
    ) -> Script[PickPlan]:
        """Ask for a grasp and a stance, with the hand that is free, or a certain one."""
        self.body.phase = f"planning how to take the {info.name}"
        free = self.body.context.holdings.free_sides()
        side = side or self.parameters.side or (free[0] if len(free) == 1 else None)
        request = PickRequest(
            object_id=info.id,
            around=surroundings(self.body),
            start=stance_of(self.body.X_WS),
            side=side,
            walk_cost_per_m=WALK_COST_PER_M if attempt == 0 else MOVE_OVER_COST_PER_M,
            seed=self.body.context.seed + attempt,
        )
        place = self.body.map.place(self.parameters.for_place_id or "")
        return (yield from ask_fitting(self.body, request, place))

    def _grasp(self, info: ObjectInfo, plan: PickPlan) -> Script[PickPlan]:
        """Take hold of it and lift it; tries again from where the body stands if it slips away."""
        for attempt in range(GRASPS):
            plan, X_WO = yield from self._reach(info, plan)
            try:
                yield from self._close(info, plan, X_WO)
                yield from self._lift(info, plan)
            except GaveUp as end:
                if attempt + 1 == GRASPS or end.failure.code != "grasp_missed":
                    raise
                yield from self._draw_back(plan)
            else:
                break
        return plan

    def _close(self, info: ObjectInfo, plan: PickPlan, X_WO: SE3) -> Script[None]:
        """Bring the open fingers around the object and close them."""
        body, side = self.body, plan.side
        body.phase = f"moving in on the {info.name}"
        yield from move_hand(
            body,
            side,
            lambda: aim(plan, info, followed(body, info, X_WO)),
            speed_m_s=body.description.handy.speeds.approach_m_s,
            near_rad=plan.over and plan.over.at_rad,
        )
        body.phase = f"closing the {side} fingers"
        self._tare_n = body.hand(side).load_n
        self._closing = side
        gap_m = yield from close_fingers(body, side)
        self._X_WG_closed = body.X_WG(side)
        X_GO = centred(body.X_WG(side).inverse() @ last_seen(body, info, X_WO))
        check_gap(body, info, plan, gap_m)
        body.context.holdings.take(
            Held(
                object_id=info.id,
                side=side,
                X_GO=X_GO,
                gap_m=gap_m,
                mass_kg=info.mass_kg,
                carry_rad=plan.carry_rad,
                upright=tilt(X_WO) < UPRIGHT_RAD,
            )
        )
        self._closing = None
        set_payload(body, side, info.mass_kg)

    def _reach(self, info: ObjectInfo, plan: PickPlan) -> Script[tuple[PickPlan, SE3]]:
        """Look, and move to the pre-grasp; moves the base if it is out of reach from here."""
        body = self.body
        for attempt in range(1 + REACH_CORRECTIONS):
            body.phase = f"looking at the {info.name}"
            opening_m = plan.opening_m + body.description.handy.gripping.open_to_take_m
            if attempt == 0:  # they may open while it looks: the hand is before the thing by then
                begin_opening(body, plan.side, opening_m=opening_m)
            X_WO = yield from see(body, info.id, remembered_since_s=self._begin_s)
            check_reachable(body, info, X_WO)
            if has_fallen(plan, X_WO):
                plan = yield from self._move_over(info, attempt=attempt + 1)
                continue
            body.phase = f"reaching for the {info.name}"
            opening_m = plan.opening_m + body.description.handy.gripping.open_to_take_m
            yield from open_fingers(body, plan.side, opening_m=opening_m)
            X_WG_pre = aim(plan, info, X_WO) @ (plan.X_WG_grasp.inverse() @ plan.X_WG_pre)
            try:
                yield from move_arm(body, plan.side, X_WG_pre, near_rad=plan.pre_rad)
            except GaveUp as end:
                if attempt == REACH_CORRECTIONS or end.failure.code not in MOVE_THE_BASE:
                    raise
                if not (yield from come_nearer(body, plan, end.failure)):
                    plan = yield from self._move_over(info, attempt=attempt + 1)
                continue
            self._X_WG_pre = X_WG_pre
            return plan, X_WO
        raise give_up(
            "grasp_missed", f"the {info.name} did not stay where it was seen", object=info.id
        )

    def _move_over(self, info: ObjectInfo, *, attempt: int) -> Script[PickPlan]:
        """Plan again, with a stance near this one if there is one, and go there, the arms in."""
        plan = yield from self._plan(info, attempt=attempt)
        yield from stow_arms(self.body)
        self._X_WG_pre = self._stance = None
        yield from approach(self.body, plan, what=info.name, thing=info)
        self._stance = plan
        return plan

    def _draw_back(self, plan: PickPlan) -> Script[None]:
        """Put down what may hang between the fingers, open them, and go back to the pre-grasp."""
        body, side = self.body, plan.side
        self._closing = None
        body.context.holdings.release(side)
        set_payload(body, side, 0.0)
        body.phase = "drawing the hand back"
        if self._X_WG_closed is not None:
            X_WG_closed = self._X_WG_closed  # never let go above nothing
            near_rad = plan.over and plan.over.at_rad
            yield from move_hand(
                body,
                side,
                lambda: X_WG_closed,
                speed_m_s=body.description.handy.speeds.give_back_m_s,
                near_rad=near_rad,
            )
            self._X_WG_closed = None
        yield from open_fingers(body, side)
        if self._X_WG_pre is not None:
            X_WG_pre = self._X_WG_pre
            near_rad = plan.over and plan.over.back_rad
            yield from move_hand(
                body,
                side,
                lambda: X_WG_pre,
                speed_m_s=body.description.handy.speeds.approach_m_s,
                near_rad=near_rad,
            )

    def _lift(self, info: ObjectInfo, plan: PickPlan) -> Script[None]:
        """Lift straight up, and see by gap and weight that the object came along."""
        body, side = self.body, plan.side
        body.phase = f"lifting the {info.name}"
        X_WG_grasp = body.X_WG(side)
        rise = tuple(b - a for a, b in zip(plan.X_WG_grasp.p, plan.X_WG_lift.p, strict=True))
        p_W = tuple(a + b for a, b in zip(X_WG_grasp.p, rise, strict=True))
        X_WG_lift = SE3((p_W[0], p_W[1], p_W[2]), X_WG_grasp.quat_wxyz)
        near_rad = plan.over and plan.over.up_rad
        yield from move_hand(
            body,
            side,
            lambda: X_WG_lift,
            speed_m_s=body.description.handy.speeds.lift_m_s,
            near_rad=near_rad,
        )
        yield from body.wait(0.4)
        check_grips(body)
        check_taken(body)
        load_n = body.hand(side).load_n - self._tare_n
        if load_n < LEAST_LOAD * GRAVITY_M_S2 * info.mass_kg:
            raise give_up(
                "grasp_missed",
                f"the {info.name} did not come up with the hand",
                object=info.id,
                load_n=round(load_n, 2),
                expected_n=round(GRAVITY_M_S2 * info.mass_kg, 2),
            )

    def _back_off(self, info: ObjectInfo) -> Script[None]:
        """After a failure: let go, draw the hand back the way it came, step back, arm home."""
        body, plan = self.body, self._stance
        if plan is None:
            return  # on its way to another stance, the arms in
        side = plan.side
        try:
            if self._X_WG_pre is not None:
                yield from self._draw_back(plan)
            yield from withdraw(body, plan, posture_rad(body, side, HOME), what=info.name)
        except GaveUp:
            return  # the first failure is the one to report; the halting script does the rest
