"""Signs to people: wave, point, nod, shake the head, bow, raise an arm."""

from __future__ import annotations

import math

import numpy as np

from executive.skills.context import SkillContext
from executive.skills.motions.gaze import look_at, turn_head
from executive.skills.motions.planning import stance_of
from executive.skills.motions.reach import move_arm, posture_rad
from executive.skills.motions.script import GaveUp, Script, give_up
from executive.skills.motions.scripted import ScriptedSkill
from executive.skills.motions.stow import stow_arm
from executive.skills.motions.walk import stand_still, turn_by
from executive.skills.parameters import GestureParams
from executive.skills.skill import Resource
from robot.messages import Side
from robot.model.handling import Signs
from robot.se3 import SE3, Array, Vector3, wrap_angle

BOW_S = 0.8
NOD_M, SHAKE_RAD, HEAD_AHEAD_M, EYE_M = 0.45, 0.35, 1.5, 1.2
TIMES = 3
AHEAD_RAD = 0.9
"""What is further to the side than this is turned to before it is pointed at."""
ARMS: dict[str, tuple[Side, ...]] = {
    "raise_left_arm": ("left",),
    "raise_right_arm": ("right",),
    "raise_both_arms": ("left", "right"),
}
HEAD_ONLY = ("nod", "shake_head")


class Gesture(ScriptedSkill):
    """Make a sign and come back to how the body stood."""

    def __init__(self, parameters: GestureParams, context: SkillContext) -> None:
        """Which, towards what."""
        super().__init__(context)
        self.parameters = parameters
        arms: frozenset[Resource] = frozenset({"legs", "left_arm", "right_arm", "head"})
        self.resources = frozenset({"head"}) if parameters.kind in HEAD_ONLY else arms

    def script(self) -> Script[None]:
        """Face whom it is for, then make it."""
        kind, p_W = self.parameters.kind, self._target()
        self.body.phase = kind.replace("_", " ")
        if p_W is not None:
            if kind not in HEAD_ONLY:
                yield from self._face(p_W)
            yield from turn_head(self.body, p_W)
        if kind in HEAD_ONLY:
            yield from self._move_head(p_W)
        elif kind == "bow":
            yield from stand_still(self.body, pitch_rad=self.body.description.balance.bow_rad)
            yield from self.body.wait(BOW_S)
            yield from stand_still(self.body)
        elif kind == "point":
            assert p_W is not None
            yield from self._point(p_W)
        else:
            yield from self._raise(waving=kind == "wave")

    def _target(self) -> Vector3 | None:
        """The point of the world that it is towards."""
        body, wanted = self.body, self.parameters
        if wanted.person_id is not None:
            x_m, y_m, _ = body.X_WPerson(wanted.person_id).p
            return (x_m, y_m, EYE_M)
        if wanted.place_id is not None:
            return body.place(wanted.place_id).X_WP.p
        if wanted.object_id is None:
            return None
        track = body.track(wanted.object_id)
        if track is None or track.X_WO is None:
            name = body.object_info(wanted.object_id).name
            raise give_up("object_not_seen", f"the {name} has not been seen yet")
        return track.X_WO.p

    def _face(self, p_W: Vector3) -> Script[None]:
        """Turn the body towards a point that is far to the side."""
        X_WS = self.body.X_WS
        to_rad = math.atan2(p_W[1] - X_WS.p[1], p_W[0] - X_WS.p[0])
        aside_rad = wrap_angle(to_rad - X_WS.yaw_rad)
        if abs(aside_rad) > AHEAD_RAD:
            yield from turn_by(self.body, aside_rad)
            yield from stand_still(self.body)

    def _move_head(self, p_W: Vector3 | None) -> Script[None]:
        """Up and down, or left and right, about where the eyes are to rest."""
        body = self.body
        x_m, y_m, yaw_rad = stance_of(body.X_WS)
        if p_W is not None:
            yaw_rad = math.atan2(p_W[1] - y_m, p_W[0] - x_m)
        for step in range(2 * TIMES + 1):
            side = 0.0 if step == 2 * TIMES else (1.0 if step % 2 else -1.0)
            nod = self.parameters.kind == "nod"
            aim_rad = yaw_rad if nod else yaw_rad + side * SHAKE_RAD
            height_m = EYE_M + (side * NOD_M if nod else 0.0)
            at = (x_m + HEAD_AHEAD_M * math.cos(aim_rad), y_m + HEAD_AHEAD_M * math.sin(aim_rad))
            yield from turn_head(body, (*at, height_m))

    def _raise(self, *, waving: bool) -> Script[None]:
        """Raise the arms that are free, wave with them if asked for, and bring them in again."""
        body, signs = self.body, self._signs()
        free = self._free_arms()
        wanted: tuple[Side, ...] = ARMS.get(self.parameters.kind, free[:1])
        sides: tuple[Side, ...] = tuple(side for side in wanted if side in free)
        if not sides:
            raise give_up("hands_full", "there is no free hand for that")
        for side in sides:
            yield from move_arm(body, side, posture_rad(body, side, signs.raised))
        for posture in signs.waving * TIMES if waving else ():
            yield from move_arm(body, sides[0], posture_rad(body, sides[0], posture))
        if not waving:
            yield from body.wait(1.0)
        for side in sides:
            yield from stow_arm(body, side)

    def _signs(self) -> Signs:
        """How this robot makes signs with its arms; others are refused before this is asked."""
        signs = self.body.description.signs
        assert signs is not None
        return signs

    def _free_arms(self) -> tuple[Side, ...]:
        """The arms that hold nothing, right first."""
        arms = self.body.description.arm_sides
        return tuple(side for side in self.body.context.holdings.free_sides() if side in arms)

    def _point(self, p_W: Vector3) -> Script[None]:
        """Stretch the nearer free arm towards a point."""
        body = self.body
        look_at(body, p_W)
        X_SP = body.X_WS.inverse().apply(p_W)
        nearer: Side = "left" if X_SP[1] > 0.0 else "right"
        hands = body.description.hands
        free: list[Side] = [side for side in self._free_arms() if side in hands]
        if not free:
            raise give_up("hands_full", "there is no free hand to point with")
        side = nearer if nearer in free else free[0]
        robot, stretched_m = body.description, self._signs().pointing_m
        aside_m = robot.shoulder_aside_m if side == "left" else -robot.shoulder_aside_m
        shoulder = np.array(body.X_WS.apply((0.0, aside_m, robot.shoulder_height_m)))
        for attempt, reach_m in enumerate(stretched_m):
            try:
                yield from move_arm(body, side, _pointing(shoulder, np.array(p_W), reach_m))
                break
            except GaveUp as end:
                out = end.failure.code in ("out_of_reach", "goal_in_collision", "no_path")
                if not out or attempt + 1 == len(stretched_m):
                    raise
        yield from body.wait(1.0)
        yield from stow_arm(body, side)


def _pointing(shoulder: Array, p_W: Array, reach_m: float) -> SE3:
    """X_WG with the hand on the line from the shoulder to a point, looking along it, level."""
    x = (p_W - shoulder) / max(float(np.linalg.norm(p_W - shoulder)), 1e-6)
    y = np.cross([0.0, 0.0, 1.0], x)
    y /= max(float(np.linalg.norm(y)), 1e-6)
    return SE3.from_rotation(np.stack([x, y, np.cross(x, y)], axis=1), shoulder + reach_m * x)
