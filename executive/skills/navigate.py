"""Walk to a pose, a place or a person, or by a step."""

from __future__ import annotations

import math

import msgspec
from msgspec.structs import replace

from executive.skills.context import SkillContext
from executive.skills.forecast import Forecast, Outlook
from executive.skills.motions.body_access import Body
from executive.skills.motions.final_steps import step_to
from executive.skills.motions.free_floor import ROUND_RAD, free_stance, may_stand, nearest_thing
from executive.skills.motions.map_edge import beyond
from executive.skills.motions.pacing import turning_s
from executive.skills.motions.planning import pose_of, stance_of
from executive.skills.motions.script import GaveUp, Script, give_up
from executive.skills.motions.standpoints import (
    AT_PERSON_M,
    heading_to,
    stances_around,
    stances_at,
    stances_before,
    walk_to_any,
)
from executive.skills.motions.stow import stow_arms
from executive.skills.motions.walk import follow, plan_path, stand_still, turn_by, walk_to
from executive.skills.parameters import SkillParams, exactly_one, finite, within
from executive.skills.scripted import ScriptedSkill
from robot.failures import Failure, failure
from robot.messages import WorldMap
from robot.model.description import RobotDescription
from robot.planning.requests import BasePath, Stance
from robot.se3 import SE3, wrap_angle

MAX_DISPLACEMENT_M = 20.0
MAX_TURN_RAD = 4.0 * math.pi
FREEING_M = 0.4
AHEAD = 0.5
"""Share of a step that leads forward (60 degrees to either side), from which on it is ahead."""
DETOUR = 1.25
"""A path longer than the straight line by more than this goes around something."""


class FloorPose(msgspec.Struct, frozen=True, kw_only=True):
    """A stance X_WS on the floor; without a heading any will do."""

    x_m: float
    y_m: float
    yaw_rad: float | None = None


class Step(msgspec.Struct, frozen=True, kw_only=True):
    """A motion relative to where the robot stands: first turn, then walk.

    With `or_less`, where that much is not free, a shorter step or one in another direction will do.
    """

    forward_m: float = 0.0
    left_m: float = 0.0
    turn_rad: float = 0.0
    or_less: bool = False


class NavigateParams(SkillParams, frozen=True, kw_only=True):
    """Walk somewhere: exactly one of a pose, a place of the map, an object or person, a step."""

    pose: FloorPose | None = None
    place_id: str | None = None
    person_id: str | None = None
    by: Step | None = None

    def __post_init__(self) -> None:
        """Check the numbers."""
        exactly_one(self, "pose", "place_id", "person_id", "by")
        if self.pose is not None:
            finite(self.pose.x_m, self.pose.y_m, self.pose.yaw_rad or 0.0)
        if self.by is not None:
            within("forward_m", self.by.forward_m, MAX_DISPLACEMENT_M)
            within("left_m", self.by.left_m, MAX_DISPLACEMENT_M)
            within("turn_rad", self.by.turn_rad, MAX_TURN_RAD)


class Navigate(ScriptedSkill[NavigateParams]):
    """Walk there and stand within 3 cm and 3 degrees."""

    name = "navigate"
    summary = "walk to a place, a person or a pose, or by a step"
    takes = NavigateParams
    resources = frozenset({"legs", "head", "left_arm", "right_arm"})

    @classmethod
    def refusal(
        cls, wanted: NavigateParams, world_map: WorldMap, robot: RobotDescription
    ) -> Failure | None:
        """What lies outside the map, and steps that lead out of it wherever they begin."""
        if wanted.pose is not None:
            return beyond(world_map, wanted.pose.x_m, wanted.pose.y_m)
        x_min, y_min, x_max, y_max = world_map.bounds_m
        across_m = math.dist((x_min, y_min), (x_max, y_max))
        if wanted.by is None or _length_m(wanted.by) < across_m:
            return None
        text = f"{_length_m(wanted.by):g} m from here is outside this world"
        size = f"it is {x_max - x_min:g} by {y_max - y_min:g} m"
        return failure("invalid_goal", text, suggestion=size)

    @classmethod
    def forecast(cls, wanted: NavigateParams, outlook: Outlook) -> Forecast:
        """The way."""
        if wanted.by is not None:
            return _forecast_step(wanted.by, outlook)
        if wanted.pose is not None:
            yaw_rad = wanted.pose.yaw_rad or outlook.X_WS.yaw_rad
            return outlook.walk([(wanted.pose.x_m, wanted.pose.y_m, yaw_rad)])
        person = outlook.map.person(wanted.person_id or "")
        if person is not None:
            away_m = AT_PERSON_M + person.radius_m
            return outlook.walk(stances_around(person.X_WO.p, outlook.X_WS, distance_m=away_m))
        return outlook.walk_to_place(outlook.map.place(wanted.place_id or ""))

    def __init__(self, parameters: NavigateParams, context: SkillContext) -> None:
        """Where to."""
        super().__init__(parameters, context)
        self._turned_rad = 0.0
        self._goal: Stance | None = None

    def script(self) -> Script[None]:
        """Tuck the arms in, then walk."""
        body, wanted = self.body, self.parameters
        if wanted.by is not None:
            outside = _leads_out(wanted.by, body.X_WS, body.map)
            if outside is not None:
                raise GaveUp(outside)
        yield from stow_arms(body)
        if wanted.by is not None:
            body.phase = "walking"
            yield from self._walk_by(wanted.by)
        elif wanted.pose is not None:
            x_m, y_m, yaw_rad = wanted.pose.x_m, wanted.pose.y_m, wanted.pose.yaw_rad
            if yaw_rad is None:
                yaw_rad = heading_to(body.X_WS, x_m, y_m)
            body.phase = f"walking to ({x_m:.1f}, {y_m:.1f})"
            yield from walk_to(body, (x_m, y_m, yaw_rad))
        elif wanted.place_id is not None:
            place = body.place(wanted.place_id)
            body.phase = f"walking to the {place.name}"
            edge_m = body.description.walking.room.before_edge_m
            stances = stances_at(place, body.X_WS, before_edge_m=edge_m)
            yield from walk_to_any(body, stances, name=place.name)
        elif wanted.person_id is not None:
            yield from self._to_person(wanted.person_id)

    def remaining(self) -> NavigateParams:
        """The same goal; of a step what is left of the turn, then the stance that it leads to."""
        by = self.parameters.by
        if by is None:
            return self.parameters
        if self._goal is None:
            return NavigateParams(by=replace(by, turn_rad=by.turn_rad - self._turned_rad))
        x_m, y_m, yaw_rad = self._goal
        return NavigateParams(pose=FloorPose(x_m=x_m, y_m=y_m, yaw_rad=yaw_rad))

    def _walk_by(self, step: Step) -> Script[None]:
        """Turn, then walk, relative to here: straight if nothing is in the way, else around it."""
        body = self.body
        X_WS = body.X_WS
        X_WS_turned = SE3.from_xy_yaw(X_WS.p[0], X_WS.p[1], X_WS.yaw_rad + step.turn_rad)
        if abs(step.turn_rad) > 1e-6:
            yield from self._turn_by(step.turn_rad)
        goal = self._goal = stance_of(X_WS_turned @ SE3((step.forward_m, step.left_m, 0.0)))
        if abs(step.turn_rad) > 1e-6:
            yield from step_to(body, stance_of(X_WS_turned))
        straight_m = _length_m(step)
        if straight_m < 1e-6:
            return
        if _is_beside(step) and not may_stand(body, goal):
            X_WS_free = free_stance(body, towards_rad=ROUND_RAD) if step.or_less else None
            if X_WS_free is None:
                raise _no_room(body, goal)
            yield from step_to(body, stance_of(X_WS_free))
            return
        if (yield from _is_free(body, goal, straight_m)):
            yield from _walk_straight(body, goal)
        else:
            yield from walk_to(body, goal)

    def _turn_by(self, angle_rad: float) -> Script[None]:
        """Turn on the spot, counting how far."""
        before_rad = self.body.X_WS.yaw_rad
        for _ in turn_by(self.body, angle_rad):
            yield
            yaw_rad = self.body.X_WS.yaw_rad
            self._turned_rad += wrap_angle(yaw_rad - before_rad)
            before_rad = yaw_rad

    def _to_person(self, person_id: str) -> Script[None]:
        body = self.body
        person = body.person(person_id)
        body.phase = f"walking to {person.name}"
        stances = stances_before(body, person, distance_m=AT_PERSON_M + person.radius_m)
        yield from walk_to_any(body, stances, name=person.name)


def _is_beside(step: Step) -> bool:
    """Whether a step leads to the side or back, where elbows and heels are and no eyes.

    Ahead the body is flat: there people have it step up to a table, nearer than its radius.
    """
    return step.forward_m < AHEAD * _length_m(step)


def _no_room(body: Body, goal: Stance) -> GaveUp:
    """What is in the way of standing there."""
    thing, distance_m = nearest_thing(body, goal)
    if thing is None or distance_m >= body.description.body_radius_m:
        return give_up("path_blocked", "there somebody stands, or the map ends")
    return give_up(
        "goal_in_collision",
        f"the {thing.name} would be {100.0 * distance_m:.0f} cm from its middle there",
        blocked_by=thing.id,
        clearance_m=round(distance_m, 3),
    )


def _is_free(body: Body, goal: Stance, straight_m: float) -> Script[bool]:
    """Whether nothing stands on the straight line.

    A short step away from what the robot touches is what frees it, so that is no obstacle.
    """
    try:
        path = yield from plan_path(body, goal)
    except GaveUp as end:
        freeing = straight_m <= FREEING_M and may_stand(body, goal)
        if end.failure.code == "start_in_collision" and freeing:
            return True
        raise
    return path.length_m <= DETOUR * straight_m + 0.1


def _walk_straight(body: Body, goal: Stance) -> Script[None]:
    """Keep the heading: forwards, sideways or backwards."""
    distance_m = math.dist(body.X_WS.p[:2], pose_of(goal).p[:2])
    straight = BasePath(waypoints=(goal,), length_m=distance_m, clearance_m=0.0)
    blocker = yield from follow(body, straight)
    if blocker is not None:
        yield from stand_still(body)
        yield from walk_to(body, goal)
        return
    yield from step_to(body, goal)


def _length_m(step: Step) -> float:
    return math.hypot(step.forward_m, step.left_m)


def _motion(step: Step) -> SE3:
    """Where a step leads, relative to where it begins."""
    turned = SE3.from_xy_yaw(0.0, 0.0, step.turn_rad)
    return turned @ SE3((step.forward_m, step.left_m, 0.0))


def _leads_out(step: Step, X_WS: SE3, world_map: WorldMap) -> Failure | None:
    """Why a step leads nowhere, if it leads out of the map; out there it may lead anywhere."""
    if _length_m(step) < 1e-6 or beyond(world_map, *X_WS.p[:2]) is not None:
        return None
    return beyond(world_map, *(X_WS @ _motion(step)).p[:2])


def _forecast_step(by: Step, outlook: Outlook) -> Forecast:
    paces = outlook.robot.paces
    outside = _leads_out(by, outlook.X_WS, outlook.map)
    if outside is not None:
        return Forecast(paces.begin_s, outside.cause)
    outlook.move(_motion(by))
    walked_s = _length_m(by) / paces.walk_m_s
    return Forecast(paces.begin_s + walked_s + turning_s(by.turn_rad, paces))
