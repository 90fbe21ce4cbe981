"""The gait: standing, double support and single support as one state machine.

Footsteps come from a wish (a twist or a target stance), are planned a few ahead, and give a
piecewise linear ZMP whose DCM is tracked. What to do next is decided when a foot lifts (one step
ahead): a robot that changes its mind at a landing falls sideways.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import partial
from typing import Literal

from robot.control.walking import zmp_plan
from robot.control.walking.adaptation import nearest_time
from robot.control.walking.catching import Catch
from robot.control.walking.dcm import DcmPlan, Point
from robot.control.walking.footsteps import (
    FootstepPlanner,
    Sole,
    Twist,
    Wish,
    other,
    stance_of,
)
from robot.control.walking.gait_reference import Reference
from robot.control.walking.support import SupportPolygon
from robot.control.walking.swing import FREEZE_S, Swing
from robot.control.walking.zmp_plan import HORIZON_STEPS, point_of
from robot.messages import Side
from robot.model.body import SIDES
from robot.model.description import RobotDescription
from robot.se3 import wrap_angle

TOUCHDOWN_LOAD = 0.02  # where the floor is expected a light touch is a landing
EXPECTED_SHARE = 0.6  # of a step: from then on the foot may touch the floor,
CLEAR_SHARE = 0.3  # and from this until then it surely hangs in the air
STAMP_LOAD = 0.3  # a swing foot that bears this much is down, whatever was planned
STAMP_S = 0.12
MAX_UNUSED_S = 0.1  # of an early landing: unless it is waited for, the DCM jumps
ESCAPE_MARGIN_M = 0.0  # from the edge of the support on no ZMP brings the DCM back
LATE_S = 0.25  # so long a foot goes on down where it finds no floor
TIMING_FILTER_S = 0.03
BACK_RAD = 0.06  # a step turns back onto the heading by so much at most,
ASTRAY_RAD = 0.3  # and a walk that was turned by more keeps the new one

Phase = Literal["stand", "double", "single"]


@dataclass(slots=True)
class Gait:
    """One body's gait.

    `planted` are the soles on the floor as last measured; `wish` is what drives the next decision,
    None for standing. `omega_1_s` is the pendulum's frequency, set by the caller every tick.
    """

    description: RobotDescription
    planted: dict[Side, Sole]
    omega_1_s: float = 4.0
    wish: Wish | None = None
    phase: Phase = "stand"
    phase_s: float = 0.0
    duration_s: float = 0.0
    support: Side = "right"
    swing: Swing | None = None
    steps_taken: int = 0
    planner: FootstepPlanner = field(init=False)
    _landings: list[Sole] = field(init=False, default_factory=list[Sole])
    _plan: DcmPlan = field(init=False)
    _polygon: SupportPolygon = field(init=False)
    _integral: list[float] = field(init=False, default_factory=lambda: [0.0, 0.0])
    _nominal_s: float = field(init=False, default=0.0)
    _one_leg_s: float = field(init=False, default=0.0)
    _heading_rad: float = field(init=False, default=0.0)
    _heading_then_rad: float = field(init=False, default=0.0)

    def __post_init__(self) -> None:
        """Begin standing."""
        description = self.description
        self.planner = FootstepPlanner(description.walking, description.feet["left"])
        self._stand()

    # --- decisions ---------------------------------------------------------------------------

    def lift(self, side: Side, duration_s: float) -> None:
        """From standing, shift onto `side` and keep the other foot in the air."""
        if self.phase != "stand":
            return
        self.support = side
        self._one_leg_s = duration_s
        self._landings = [self.planted[other(side)]]
        self._start_double(self.description.balance.one_leg_shift_s, self._stance_centre())

    def settled(self) -> bool:
        """Standing, with nothing left to do."""
        return (
            self.phase == "stand"
            and self.phase_s > self.description.walking.settle_s
            and not self._wants_step()
        )

    @property
    def landings(self) -> tuple[tuple[Side, Sole], ...]:
        """The landings that are planned, in order, each with its foot."""
        swing = other(self.support)
        return tuple(
            (swing if k % 2 == 0 else self.support, sole) for k, sole in enumerate(self._landings)
        )

    def hangs(self) -> int | None:
        """The foot that is surely in the air, 0 (left) or 1: in the middle of its step."""
        if self.phase != "single":
            return None
        share = self.phase_s / self.duration_s
        clear = CLEAR_SHARE < share < EXPECTED_SHARE
        return SIDES.index(other(self.support)) if clear else None

    def _wants_step(self) -> bool:
        """Would the wish move a foot?"""
        if self.wish is None:
            return False
        side = self.planner.first_swing(self.planted["left"], self.planted["right"], self.wish)
        landings = (
            self.planner.next(self.planted[other(s)], self.planted[s], s, self.wish)
            for s in (side, other(side))
        )
        return any(landing is not None for landing in landings)

    def _begin(self, *, swing: Side, start_s: float) -> None:
        """Leave standing with `swing` as the first foot in the air."""
        self.support = other(swing)
        self._one_leg_s = 0.0
        self._heading_rad = self._stance().yaw
        self._landings = self._look_ahead(self._next(swing) or self.planted[swing])
        self._start_double(start_s, self._stance_centre())

    def _next(self, swing: Side) -> Sole | None:
        """The next landing, by the wish; a walk keeps its heading whatever feet and floor do to it.

        A foot that lands a degree askew, or twists as it bears, would turn every step after it.
        """
        wish, support = self.wish or Twist(), self.planted[self.support]
        if isinstance(wish, Twist) and wish != Twist():
            off = wrap_angle(self._heading_rad - support.yaw)
            if abs(off) > ASTRAY_RAD:
                off, self._heading_rad = 0.0, support.yaw
            support = support.offset(0.0, 0.0, turn_rad=max(-BACK_RAD, min(BACK_RAD, off)))
        landing = self.planner.next(support, self.planted[swing], swing, wish)
        turn = wrap_angle(landing.yaw - support.yaw) if landing else 0.0
        self._heading_then_rad = self._heading_rad + turn
        return landing

    def _look_ahead(self, first: Sole) -> list[Sole]:
        """The first landing and those after it, as far as the wish goes."""
        wish = self.wish or Twist()
        landings = [first]
        feet = dict(self.planted)
        side = other(self.support)
        feet[side] = first
        while len(landings) < HORIZON_STEPS:
            side = other(side)
            landing = self.planner.next(feet[other(side)], feet[side], side, wish)
            if landing is None:
                break
            feet[side] = landing
            landings.append(landing)
        return landings

    # --- the machine ---------------------------------------------------------------------------

    def update(
        self, dt_s: float, xi: Point, measured: dict[Side, Sole], load: list[float]
    ) -> Reference:
        """Advance by `dt_s`.

        Args:
            dt_s: time since the last update.
            xi: measured DCM in N [m].
            measured: soles as the estimator sees them.
            load: share of the weight on the left and right foot.
        """
        self.phase_s += dt_s
        if self.phase == "stand":
            self._replant(measured, load)
            self._update_stand(xi)
        elif self.phase == "double":
            self._update_double(xi, measured, load)
        elif self.phase == "single":
            self._update_single(dt_s, xi, measured, load)
        return self._reference(dt_s, xi)

    def _update_stand(self, xi: Point) -> None:
        if self._escapes(xi):
            self._begin(swing=self._trailing(xi), start_s=self.description.walking.catching.start_s)
            return
        if self.phase_s > self.description.walking.settle_s and self._wants_step():
            assert self.wish is not None
            left, right = self.planted["left"], self.planted["right"]
            swing = self.planner.first_swing(left, right, self.wish)
            support = other(swing)
            if (
                self.planner.next(self.planted[support], self.planted[swing], swing, self.wish)
                is None
            ):
                swing = support
            self._begin(swing=swing, start_s=self.description.walking.start_s)

    def _replant(self, measured: dict[Side, Sole], load: list[float]) -> None:
        """Standing, believe the soles that bear, should one not be where it was planted.

        It slid, or hung in the air when another controller was replaced by this one and came down
        elsewhere. A walk that began from the old place would shift the weight beyond the new one.
        """
        if self._moved(measured, load):
            self._stand()

    def _moved(self, measured: dict[Side, Sole], load: list[float]) -> bool:
        """Take the soles that bear for where they are measured; whether one had moved."""
        moved: list[Side] = [
            side
            for side, share in zip(SIDES, load, strict=True)
            if share > STAMP_LOAD and self._slid(self.planted[side], measured[side])
        ]
        self.planted.update({side: measured[side] for side in moved})
        return bool(moved)

    def _escapes(self, xi: Point) -> bool:
        """Is the DCM where no ZMP inside the support brings it back?"""
        return self._polygon.margin_m(xi) < ESCAPE_MARGIN_M

    def _trailing(self, xi: Point) -> Side:
        """The foot that a step catches an escaping DCM with."""
        stance = self._stance()
        forward, left, _ = stance.relative(Sole(xi[0], xi[1], 0.0))
        lead, _, _ = self.planted["left"].relative(self.planted["right"])
        if abs(left) > abs(forward):
            return "left" if left > 0.0 else "right"  # outward: the other way the legs would cross
        if abs(lead) > 0.05:
            return "left" if (lead > 0.0) == (forward > 0.0) else "right"
        return "left" if left < 0.0 else "right"

    def _update_double(self, xi: Point, measured: dict[Side, Sole], load: list[float]) -> None:
        """Shift the weight, until the next foot lifts or both stay.

        A foot that comes down fast to catch a push slides on by 2 cm while it takes the weight. It
        carries the robot where it ends: with the support where it touched, the DCM would seem to
        escape, and a second step would begin by shifting the weight back.
        """
        if self._moved(measured, load):
            self._polygon = self._hull([self.planted["left"], self.planted["right"]])
        if not self._landings and self._escapes(xi):
            self._begin(swing=self._trailing(xi), start_s=self.description.walking.catching.start_s)
        elif self.phase_s >= self.duration_s:
            if self._landings:
                self._start_single()
            else:
                self._stand()

    def _update_single(
        self, dt_s: float, xi: Point, measured: dict[Side, Sole], load: list[float]
    ) -> None:
        side, swing = other(self.support), self.swing
        assert swing is not None
        if not self._one_leg_s:
            self._adjust(dt_s, xi)
        swing.heed(measured[side])
        swing.advance(dt_s)
        expected = self.phase_s > EXPECTED_SHARE * self.duration_s and swing.vz <= 0.0
        bears = load[SIDES.index(side)]
        touches = bears > TOUCHDOWN_LOAD and expected
        stamps = bears > STAMP_LOAD and self.phase_s > STAMP_S
        if touches or stamps or self.phase_s > self.duration_s + LATE_S:
            self._touch_down(side, measured, xi)

    def _touch_down(self, side: Side, measured: dict[Side, Sole], xi: Point) -> None:
        """The swing foot bears: plan the next double support from where it really stands."""
        xi_ref, _ = self._plan.at(self._plan_time())
        unused_s = max(0.0, min(MAX_UNUSED_S, self.duration_s - self.phase_s))
        before, self.support = self.support, side
        self.planted.update(measured)
        self.swing, self._one_leg_s = None, 0.0
        self.steps_taken += 1
        self._heading_rad = self._heading_then_rad
        zmp, walking = point_of(self.planted[before]), self.description.walking
        if len(self._landings) <= 1:
            self._landings = []
            self._start_double(walking.stop_s + unused_s, zmp)
            return
        self._landings = self._look_ahead(self._next(before) or self._landings[1])
        duration_s = walking.double_support_s + unused_s
        if math.dist(xi, xi_ref) > walking.catching.late_m:
            soon_s = min(walking.catching.double_support_s, duration_s)
            duration_s = nearest_time(partial(self._shift_begins, zmp), xi, soon_s, duration_s)
        self._start_double(duration_s, zmp)

    def _shift_begins(self, zmp: Point, duration_s: float) -> Point:
        """The DCM at which a shift of the weight begins that takes so long."""
        return self._stepping((zmp, duration_s)).at(0.0)[0]

    def _start_double(self, duration_s: float, zmp: Point) -> None:
        self.phase, self.phase_s, self.duration_s = "double", 0.0, duration_s
        self._replan(zmp)
        self._polygon = self._hull([self.planted["left"], self.planted["right"]])

    def _start_single(self) -> None:
        walking = self.description.walking
        side = other(self.support)
        self.phase, self.phase_s = "single", 0.0
        self.duration_s = self._nominal_s = self._one_leg_s or walking.single_support_s
        landing = self._landings[0]
        if not self._one_leg_s:
            self._landings = self._look_ahead(landing)
        self.swing = Swing(self.planted[side], landing, self.duration_s, walking)
        self._replan(point_of(self.planted[self.support]))
        self._polygon = self._hull([self.planted[self.support]])

    def _stand(self) -> None:
        self.phase, self.phase_s, self.duration_s = "stand", 0.0, 0.0
        self.swing = None
        self._landings = []
        self._integral = [0.0, 0.0]
        self._plan = zmp_plan.standing(self._stance_centre(), self.omega_1_s)
        self._polygon = self._hull([self.planted["left"], self.planted["right"]])

    # --- references ----------------------------------------------------------------------------

    def _stance(self) -> Sole:
        return stance_of(self.planted["left"], self.planted["right"])

    def _stance_centre(self) -> Point:
        stance = self._stance()
        return (stance.x, stance.y)

    def _hull(self, soles: list[Sole]) -> SupportPolygon:
        foot = self.description.feet["left"]
        margin_m = self.description.balance.zmp_margin_m
        return SupportPolygon(soles, foot.half_length_m, foot.half_width_m, margin_m=margin_m)

    def _replan(self, zmp: Point) -> None:
        """From now: the rest of this phase, then the footsteps ahead."""
        double = self.phase == "double"
        if double and not self._landings:
            centre, omega_1_s = self._stance_centre(), self.omega_1_s
            self._plan = zmp_plan.coming_to_rest(zmp, centre, self.duration_s, omega_1_s)
            return
        self._plan = self._stepping((zmp, self.duration_s) if double else None)

    def _stepping(self, shift: tuple[Point, float] | None) -> DcmPlan:
        walking = self.description.walking
        return zmp_plan.stepping(
            walking,
            support=self.planted[self.support],
            swing=self.planted[other(self.support)],
            landings=self._landings,
            single_s=self._one_leg_s or walking.single_support_s,
            omega_1_s=self.omega_1_s,
            shift=shift,
        )

    def _adjust(self, dt_s: float, xi: Point) -> None:
        """Shift the landing and its time by the DCM error that the stance foot leaves."""
        assert self.swing is not None
        if self.duration_s - self.phase_s <= FREEZE_S:
            return
        xi_ref, zmp_ref = self._plan.at(self._plan_time())
        catch = Catch(
            plan=self._plan,
            planned_s=self._nominal_s,
            past_s=self.phase_s,
            omega_1_s=self.omega_1_s,
            gain_1_s=self.description.balance.dcm_1_s,
            xi=xi,
            zmp=self._command(xi, xi_ref, zmp_ref, beyond_m=0.0),
            planned=self._landings[0],
            support=self.planted[self.support],
            side=other(self.support),
            planner=self.planner,
        )
        left_s = self._nominal_s * max(0.0, 1.0 - self.phase_s / self.duration_s)
        shift = catch.error(xi_ref, zmp_ref, left_s)
        if math.hypot(*shift) > self.description.walking.catching.retimed_m:
            x, y, _ = self.swing.position
            self._retime(dt_s, catch.best_time(x, y))
            self.swing.urgent = True
            shift = catch.shift(self.duration_s)
        else:
            self._retime(dt_s, self._nominal_s)
        # At the landing itself: aimed beyond it, for what an early touch leaves, knees overspeed.
        self.swing.aim(catch.landing(shift), dt_s)

    def _retime(self, dt_s: float, wanted_s: float) -> None:
        """Move the end of the step towards `wanted_s` after its begin."""
        assert self.swing is not None
        wanted_s = max(wanted_s, self.phase_s + FREEZE_S)
        gain = dt_s / (TIMING_FILTER_S + dt_s)
        self.duration_s += gain * (wanted_s - self.duration_s)
        self.swing.duration_s = self.duration_s

    def _plan_time(self) -> float:
        """Where on the plan this phase is: a single support that was retimed is stretched."""
        if self.phase != "single":
            return self.phase_s
        return min(1.0, self.phase_s / self.duration_s) * self._nominal_s

    def _command(self, xi: Point, xi_ref: Point, zmp_ref: Point, *, beyond_m: float) -> Point:
        """The ZMP that brings the DCM back, clipped to the support or so far beyond it."""
        gain = 1.0 + self.description.balance.dcm_1_s / self.omega_1_s
        x = zmp_ref[0] + gain * (xi[0] - xi_ref[0]) + self._integral[0]
        y = zmp_ref[1] + gain * (xi[1] - xi_ref[1]) + self._integral[1]
        return self._polygon.clip((x, y), beyond_m=beyond_m)

    def _reference(self, dt_s: float, xi: Point) -> Reference:
        xi_ref, zmp_ref = self._plan.at(self._plan_time())
        if self.phase == "stand":
            balance = self.description.balance
            most_m = balance.dcm_integral_m
            for k in (0, 1):
                step = self._integral[k] + balance.dcm_integral_1_s * dt_s * (xi[k] - xi_ref[k])
                self._integral[k] = max(-most_m, min(most_m, step))
        elif self.phase == "single":
            self._integral = [0.0, 0.0]
        # Standing, the trunk's help costs more than it catches: 14 N s, 14 of 16 without, 13 with.
        beyond_m = 0.0 if self.phase == "stand" else self.description.balance.trunk_zmp_m
        command = self._command(xi, xi_ref, zmp_ref, beyond_m=beyond_m)
        beyond_m = -self._polygon.margin_m(command)
        strain = max(0.0, min(1.0, beyond_m / self.description.balance.trunk_zmp_m))
        contact, share = [True, True], [2.0, 2.0]
        swing_side: Side | None = None
        heading = self._stance().yaw
        if self.phase == "single":
            assert self.swing is not None
            swing_side = other(self.support)
            contact[SIDES.index(swing_side)] = False
            support_yaw = self.planted[self.support].yaw
            heading = support_yaw + 0.5 * wrap_angle(float(self.swing.position[2]) - support_yaw)
        elif self.phase == "double" and self._landings:
            lifting = SIDES.index(other(self.support))
            left = max(0.0, 1.0 - self.phase_s / self.duration_s)
            # Ramped down, so that the foot bears next to nothing by the time it lifts.
            share[lifting] = 0.03 + 1.2 * left
        return Reference(
            xi_ref, zmp_ref, command, contact, share, heading, strain, self.swing, swing_side
        )

    def _slid(self, planted: Sole, measured: Sole) -> bool:
        balance = self.description.balance
        forward, left, turn = planted.relative(measured)
        return math.hypot(forward, left) > balance.slid_m or abs(turn) > balance.slid_rad
