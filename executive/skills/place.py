"""Put what a hand holds on a place: stand before it, raise, step in, lower, let go, look."""

from __future__ import annotations

import contextlib
import math

import msgspec

from executive.skills.ability import no_hand
from executive.skills.context import SkillContext
from executive.skills.forecast import Forecast, Outlook
from executive.skills.holding import Held
from executive.skills.motions.approach import approach, come_nearer, withdraw
from executive.skills.motions.body_access import Body
from executive.skills.motions.fingers import check_grips, open_fingers, set_payload
from executive.skills.motions.gaze import look_at, see, turn_head
from executive.skills.motions.past_people import ask_past_people
from executive.skills.motions.planning import held_in, stance_of
from executive.skills.motions.reach import move_arm, move_hand, posture_rad
from executive.skills.motions.script import GaveUp, Script, give_up
from executive.skills.motions.stow import HOME, stow_arms
from executive.skills.motions.support import occupant, stands_on, surroundings, tilt
from executive.skills.parameters import SkillParams, exactly_one, finite
from executive.skills.scripted import ScriptedSkill
from robot.failures import Failure, failure
from robot.messages import ObjectInfo, Place, Shape, Side, WorldMap
from robot.model.description import RobotDescription
from robot.physics import GRAVITY_M_S2
from robot.planning.requests import (
    WALK_COST_PER_M,
    Joints,
    ObjectPose,
    PlacePlan,
    PlaceRequest,
)
from robot.se3 import SE3

CONTACT = 0.5
"""Of the weight, off the hand: then the object stands."""
TOO_HIGH_M = 0.02
LOWERINGS = 3
REACH_CORRECTIONS = 2
REPLANS = 1
"""The spot may be taken by now: another one is chosen once."""
ELSEWHERE = ("goal_in_collision", "out_of_reach", "no_path", "planner_timeout")
MOVE_OVER_COST_PER_M = 0.5
"""Cost of walking to another stance once the robot stands before the place."""
LOOK_S = 0.5
"""Two pictures and a half, of 5 a second."""
PLACED_WITHIN_M = 0.03
AROUND_FELT_M = 0.03
"""What holds a thing above its spot reaches so far beyond that, at a guess: nobody has seen it."""
FULL = ("no_free_spot", "goal_in_collision", "out_of_reach", "no_stance")
"""What another board of the same shelf is tried for."""
UPRIGHT_RAD = 0.25
SPOT_SIZE_M = 0.2


class PlaceParams(SkillParams, frozen=True, kw_only=True):
    """Put what is held on a place of the map, or at an exact pose X_WO of its own.

    Of the place only the `spots` will do, x and y in W [m]; none: all of it. Where there is no way
    to put it there, the places `or_place_ids` will do as well, the first in which there is one.
    """

    object_id: str
    place_id: str | None = None
    or_place_ids: tuple[str, ...] = ()
    X_WO: SE3 | None = None
    spots: tuple[tuple[float, float], ...] = ()

    def __post_init__(self) -> None:
        """Check that there is one target."""
        exactly_one(self, "place_id", "X_WO")
        for spot in self.spots:
            finite(*spot)
        if self.X_WO is not None:
            finite(*self.X_WO.p)


class Release(msgspec.Struct, frozen=True, kw_only=True):
    """How a hand lets go: how far the fingers open, and where the hand is drawn back to.

    `near_rad`: joints with the elbow where it should be then, None: anywhere.
    """

    side: Side
    opening_m: float
    X_WG_back: SE3
    near_rad: Joints | None = None


class PutDown(ScriptedSkill[PlaceParams]):
    """Put an object down; ends with the arm home, clear of the place, the object seen there."""

    name = "place"
    summary = "put what a hand holds on a place, and look whether it stands"
    takes = PlaceParams
    resources = frozenset({"legs", "head", "left_arm", "right_arm"})

    @classmethod
    def lack(cls, wanted: PlaceParams, robot: RobotDescription) -> str:
        """A hand."""
        return no_hand(robot)

    @classmethod
    def refusal(
        cls, wanted: PlaceParams, world_map: WorldMap, robot: RobotDescription
    ) -> Failure | None:
        """What is higher or lower than a hand gets.

        Where that was not measured, the reach is that of a stretched arm from the shoulder, lower
        by as much as the legs let the shoulder down.
        """
        place = world_map.place(wanted.place_id or "")
        if wanted.place_id is not None and place is None:
            text = f"there is no place {wanted.place_id!r} in this world"
            return failure("unknown_place", text)
        X = wanted.X_WO or (place.X_WP if place else None)
        if X is None:
            return None
        squat_m = robot.walking.base_height_m - robot.balance.lowest_base_m
        lowest_m, highest_m = robot.handy.reaching.surfaces_m or (
            robot.shoulder_height_m - robot.arm_reach_m - squat_m,
            robot.shoulder_height_m + robot.arm_reach_m,
        )
        if lowest_m <= X.p[2] <= highest_m:
            return None
        name = f"the {place.name}" if place else "that spot"
        text = f"{name} is {X.p[2]:.2f} m high; the hands reach {lowest_m:.2f} to {highest_m:.2f} m"
        return failure("out_of_reach", text, suggestion="name another place", height_m=X.p[2])

    @classmethod
    def forecast(cls, wanted: PlaceParams, outlook: Outlook) -> Forecast:
        """The way, and what it typically takes there."""
        place = outlook.map.place(wanted.place_id or "")
        return outlook.put(wanted.object_id, place).then(outlook.robot.paces.place_s)

    def __init__(self, parameters: PlaceParams, context: SkillContext) -> None:
        """What to put where."""
        super().__init__(parameters, context)
        self._release: Release | None = None
        self._released = False
        self._felt: tuple[ObjectPose, ...] = ()

    def script(self) -> Script[None]:
        """Plan, approach, lower, let go, withdraw, verify."""
        body = self.body
        info = body.object_info(self.parameters.object_id)
        held = body.context.holdings.find(info.id)
        place = self._place()
        if held is None:
            X_WO = self._standing(place)
            if X_WO is None:
                raise give_up("not_holding", f"no hand holds the {info.name}", object=info.id)
            yield from stow_arms(body)
            yield from self._verify(info, place, X_WO)
            return
        check_grips(body)
        yield from stow_arms(body)
        others = tuple(map(body.place, self.parameters.or_place_ids))
        place, plan = yield from self._bring(info, (place, *others), held)
        yield from self._let_go(info, plan, held)
        body.progress = 0.8
        yield from withdraw(body, plan, posture_rad(body, plan.side, HOME), what=place.name)
        yield from self._verify(info, place, plan.X_WO)

    def _bring(
        self, info: ObjectInfo, places: tuple[Place, ...], held: Held
    ) -> Script[tuple[Place, PlacePlan]]:
        """Go there and lower it; plans again, for another spot or stance, if this one is taken."""
        body = self.body
        for attempt in range(1 + REPLANS):
            place, plan = yield from self._choose(places, held, attempt=attempt)
            body.progress = 0.1
            yield from approach(body, plan, what=place.name)
            body.progress = 0.5
            try:
                yield from self._look_first(info, place, plan)
                yield from self._lower(info, place, plan, held)
            except GaveUp as end:
                yield from self._back_off(place, plan, held)
                is_felt = self._feel(info, place, plan, end.failure)
                if attempt == REPLANS or not (is_felt or end.failure.code in ELSEWHERE):
                    raise end
                body.progress = 0.1
            else:
                return place, plan
        raise AssertionError("unreachable")

    def _feel(self, info: ObjectInfo, place: Place, plan: PlacePlan, reason: Failure) -> bool:
        """Take note of what holds a thing above its spot, whether it was seen or not."""
        high_m = reason.evidence.get("high_m")
        if reason.code != "place_missed" or not isinstance(high_m, float):
            return False
        (x_m, y_m, _), floor_m = plan.X_WO.p, place.X_WP.p[2]
        long_m, wide_m, _ = info.shape.size_m
        size_m = (long_m + 2.0 * AROUND_FELT_M, wide_m + 2.0 * AROUND_FELT_M, high_m)
        felt = ObjectPose(
            id=f"felt_{len(self._felt)}",
            X_WO=SE3((x_m, y_m, floor_m + 0.5 * high_m), plan.X_WO.quat_wxyz),
            shape=Shape(kind="box", size_m=size_m),
        )
        self._felt = (*self._felt, felt)
        return True

    def _choose(
        self, places: tuple[Place, ...], held: Held, *, attempt: int
    ) -> Script[tuple[Place, PlacePlan]]:
        """A plan for the first of the places that has room; gives up with why none has."""
        reasons: list[Failure] = []
        for place in places:
            self.body.phase = f"planning how to put it on the {place.name}"
            if reasons:
                self.body.phase += f", as {reasons[-1].cause}"
            try:
                return place, (yield from self._plan(place, held, attempt=attempt))
            except GaveUp as end:
                if end.failure.code not in FULL:
                    raise
                reasons.append(end.failure)
        cause = "; ".join(reason.cause for reason in reasons)
        raise GaveUp(msgspec.structs.replace(reasons[0], cause=cause))

    def halt(self) -> Script[None]:
        """A hand that has begun to let go lets go and draws back before the body rests."""
        if self._release is not None:
            with contextlib.suppress(GaveUp):  # then it rests where it is
                yield from self._draw_back(self._release)
        yield from super().halt()

    def remaining(self) -> PlaceParams | None:
        """Nothing, once the hand has begun to let go: the object stands."""
        return None if self._released else self.parameters

    def _place(self) -> Place:
        """The place of the map, or for an exact pose the one under it, or a spot of its own."""
        X_WO = self.parameters.X_WO
        if self.parameters.place_id is not None or X_WO is None:
            return self.body.place(self.parameters.place_id or "")
        for place in self.body.map.places:
            if not place.floor and _is_over(place, X_WO):
                return place
        return Place(id="spot", name="spot", X_WP=X_WO, size_m=(SPOT_SIZE_M, SPOT_SIZE_M))

    def _standing(self, place: Place) -> SE3 | None:
        """Where it stands already as it is to: let go, before somebody kept the hand from it."""
        wanted, track = self.parameters, self.body.track(self.parameters.object_id)
        if track is None or track.X_WO is None or track.missing or tilt(track.X_WO) > UPRIGHT_RAD:
            return None
        spots = wanted.spots if wanted.X_WO is None else (wanted.X_WO.p[:2],)
        off_m = min((math.dist(track.X_WO.p[:2], spot) for spot in spots), default=0.0)
        return track.X_WO if off_m <= PLACED_WITHIN_M and stands_on(track.X_WO, place) else None

    def _plan(self, place: Place, held: Held, *, attempt: int) -> Script[PlacePlan]:
        known = held_in(self.body, held.side)
        assert known is not None
        around = surroundings(self.body, unnamed=True)
        around = msgspec.structs.replace(around, objects=(*around.objects, *self._felt))
        request = PlaceRequest(
            place=place,
            side=held.side,
            held=known,
            around=around,
            start=stance_of(self.body.X_WS),
            target=self.parameters.X_WO,
            spots=self.parameters.spots,
            walk_cost_per_m=WALK_COST_PER_M if attempt == 0 else MOVE_OVER_COST_PER_M,
            seed=self.body.context.seed + attempt,
        )
        return (yield from ask_past_people(self.body, request, PlacePlan))

    def _look_first(self, info: ObjectInfo, place: Place, plan: PlacePlan) -> Script[None]:
        """Look at the spot before the hand is over it and hides it: something may have come."""
        body = self.body
        body.phase = f"looking at where the {info.name} is to go"
        yield from turn_head(body, plan.X_WO.p)
        yield from body.wait(LOOK_S)
        _check_free(body, info, place, plan)

    def _reach_over(self, place: Place, plan: PlacePlan) -> Script[None]:
        """Bring the object above its spot; comes nearer if that is just out of reach."""
        for attempt in range(1 + REACH_CORRECTIONS):
            self.body.phase = f"reaching over the {place.name}"
            goal, near_rad = plan.X_WG_pre, plan.pre_rad
            try:
                keep_upright = self.body.context.holdings.must_stay_upright(plan.side)
                yield from move_arm(
                    self.body, plan.side, goal, keep_upright=keep_upright, near_rad=near_rad
                )
            except GaveUp as end:
                if attempt == REACH_CORRECTIONS:
                    raise
                if not (yield from come_nearer(self.body, plan, end.failure)):
                    raise
            else:
                return

    def _lower(self, info: ObjectInfo, place: Place, plan: PlacePlan, held: Held) -> Script[None]:
        """Bring the object above its spot, then down until half its weight is off the hand."""
        body, side = self.body, plan.side
        look_at(body, plan.X_WO.p)
        yield from self._reach_over(place, plan)
        near_rad = plan.over and plan.over.up_rad
        yield from move_hand(
            body,
            side,
            lambda: plan.X_WG_pre,
            speed_m_s=body.description.handy.speeds.carry_m_s,
            near_rad=near_rad,
        )
        check_grips(body)
        _check_free(body, info, place, plan)
        body.phase = f"lowering the {info.name}"
        gripping = body.description.handy.gripping
        below = _shifted(plan.X_WG_release, -gripping.press_m)
        contact_n = max(gripping.contact_n, CONTACT * GRAVITY_M_S2 * held.mass_kg)
        for _ in range(LOWERINGS):
            try:
                yield from move_hand(
                    body,
                    side,
                    lambda: below,
                    speed_m_s=body.description.handy.speeds.lower_m_s,
                    stop_load_n=contact_n,
                    near_rad=plan.over and plan.over.at_rad,
                )
            except GaveUp as end:
                if end.failure.code != "arm_stalled":
                    raise
            if body.X_WG(side).p[2] - plan.X_WG_release.p[2] < TOO_HIGH_M:
                return
        high_m = body.X_WG(side).p[2] - plan.X_WG_release.p[2]
        raise give_up(
            "place_missed",
            f"something holds the {info.name} {high_m * 100:.0f} cm above the {place.name}",
            high_m=round(high_m, 3),
        )

    def _back_off(self, place: Place, plan: PlacePlan, held: Held) -> Script[None]:
        """After a failure over the place: raise what is still held, step back, arm in."""
        body, side = self.body, plan.side
        holding = body.context.holdings.at(side) is not None
        try:
            if body.X_WG(side).p[2] < plan.X_WG_pre.p[2]:
                X_WG_up = _shifted(body.X_WG(side), plan.X_WG_pre.p[2] - body.X_WG(side).p[2])
                near_rad = plan.over and plan.over.up_rad
                yield from move_hand(
                    body,
                    side,
                    lambda: X_WG_up,
                    speed_m_s=body.description.handy.speeds.carry_m_s,
                    near_rad=near_rad,
                )
            arm_rad = held.carry_rad if holding else posture_rad(body, side, HOME)
            yield from withdraw(body, plan, arm_rad, what=place.name)
        except GaveUp:
            return  # the first failure is the one to report; the halting script does the rest

    def _let_go(self, info: ObjectInfo, plan: PlacePlan, held: Held) -> Script[None]:
        """Open and draw the hand back straight."""
        body, side = self.body, plan.side
        body.phase = f"letting go of the {info.name}"
        body.context.holdings.release(side)
        set_payload(body, side, 0.0)
        self._release = Release(
            side=side,
            opening_m=held.gap_m + body.description.handy.gripping.open_to_leave_m,
            X_WG_back=body.X_WG(side) @ plan.X_WG_release.inverse() @ plan.X_WG_retreat,
            near_rad=plan.over and plan.over.back_rad,
        )
        self._released = True
        yield from self._draw_back(self._release)
        self._release = None

    def _draw_back(self, release: Release) -> Script[None]:
        yield from open_fingers(self.body, release.side, opening_m=release.opening_m)
        self.body.phase = "drawing the hand back"
        back = release.X_WG_back
        yield from move_hand(
            self.body,
            release.side,
            lambda: back,
            speed_m_s=self.body.description.handy.speeds.approach_m_s,
            near_rad=release.near_rad,
        )

    def _verify(self, info: ObjectInfo, place: Place, X_WO_put: SE3) -> Script[None]:
        """Look: the object must stand where it was put. Gives up with `place_missed`."""
        self.body.phase = f"checking the {info.name}"
        try:
            X_WO = yield from see(self.body, info.id, p_W=X_WO_put.p)
        except GaveUp as end:
            if end.failure.code != "object_not_seen":
                raise
            cause = f"the {info.name} cannot be seen on the {place.name}"
            track = self.body.track(info.id)
            if track is not None and track.unlike:
                cause = f"what was put on the {place.name} for {info.full_name} is {track.unlike}"
            raise give_up("place_missed", cause, object=info.id) from end
        off_m = math.dist(X_WO.p, X_WO_put.p)
        tilt_rad = tilt(X_WO)
        if off_m <= PLACED_WITHIN_M and tilt_rad <= UPRIGHT_RAD:
            return
        toppled = ", and has toppled" if tilt_rad > UPRIGHT_RAD else ""
        raise give_up(
            "place_missed",
            f"the {info.name} is {off_m * 100:.1f} cm from where it was put{toppled}",
            object=info.id,
            off_m=round(off_m, 4),
            tilt_rad=round(tilt_rad, 3),
        )


def _check_free(body: Body, info: ObjectInfo, place: Place, plan: PlacePlan) -> None:
    """Give up when something has come to stand where the object is to go."""
    other = occupant(body, info, plan.X_WO)
    if other is not None:
        raise give_up(
            "goal_in_collision",
            f"the {other.name} stands on the {place.name} where the {info.name} is to go",
            object=other.id,
        )


def _is_over(place: Place, X_WO: SE3) -> bool:
    """Whether a pose is on a place: inside its rectangle, within a hand's breadth above it."""
    x_m, y_m, z_m = place.X_WP.inverse().apply(X_WO.p)
    inside = abs(x_m) <= 0.5 * place.size_m[0] and abs(y_m) <= 0.5 * place.size_m[1]
    return bool(inside and -0.02 < z_m < 0.25)


def _shifted(X_WG: SE3, up_m: float) -> SE3:
    return SE3((X_WG.p[0], X_WG.p[1], X_WG.p[2] + up_m), X_WG.quat_wxyz)
