"""Walk to a pose, a place or a person, or by a step."""

from __future__ import annotations

import math

from msgspec.structs import replace

from executive.skills.context import SkillContext
from executive.skills.motions.body_access import Body
from executive.skills.motions.final_steps import step_to
from executive.skills.motions.planning import pose_of, stance_of
from executive.skills.motions.script import GaveUp, Script
from executive.skills.motions.scripted import ScriptedSkill
from executive.skills.motions.standpoints import (
    AT_PERSON_M,
    heading_to,
    stances_around,
    stances_at,
    walk_to_any,
)
from executive.skills.motions.stow import stow_arms
from executive.skills.motions.walk import follow, plan_path, stand_still, turn_by, walk_to
from executive.skills.parameters import FloorPose, NavigateParams, Step
from robot.planning.requests import BasePath, Stance
from robot.se3 import SE3, wrap_angle

FREEING_M = 0.4
DETOUR = 1.25
"""A path longer than the straight line by more than this goes around something."""


class Navigate(ScriptedSkill):
    """Walk there and stand within 3 cm and 3 degrees."""

    resources = frozenset({"legs", "head", "left_arm", "right_arm"})

    def __init__(self, parameters: NavigateParams, context: SkillContext) -> None:
        """Where to."""
        super().__init__(context)
        self.parameters = parameters
        self._turned_rad = 0.0
        self._goal: Stance | None = None

    def script(self) -> Script[None]:
        """Tuck the arms in, then walk."""
        body, wanted = self.body, self.parameters
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
            yield from walk_to_any(body, stances_at(place, body.X_WS), name=place.name)
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
        straight_m = math.hypot(step.forward_m, step.left_m)
        if straight_m < 1e-6:
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
        distance_m = AT_PERSON_M + person.radius_m
        stances = stances_around(body.X_WPerson(person_id).p, body.X_WS, distance_m=distance_m)
        yield from walk_to_any(body, stances, name=person.name)


def _is_free(body: Body, goal: Stance, straight_m: float) -> Script[bool]:
    """Whether nothing stands on the straight line.

    A short step away from what the robot touches is what frees it, so that is no obstacle.
    """
    try:
        path = yield from plan_path(body, goal)
    except GaveUp as end:
        if end.failure.code == "start_in_collision" and straight_m <= FREEING_M:
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
