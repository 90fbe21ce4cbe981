"""Signs to people: wave, point, nod, shake the head, bow, raise an arm; and lower it."""

from __future__ import annotations

import math
from typing import Literal

import numpy as np

from executive.skills.ability import no_hand
from executive.skills.forecast import Forecast, Outlook
from executive.skills.motions.back_away import back_away
from executive.skills.motions.gaze import look_at, turn_head
from executive.skills.motions.pacing import turning_s
from executive.skills.motions.planning import stance_of
from executive.skills.motions.reach import move_arm, posture_rad
from executive.skills.motions.script import GaveUp, Script, give_up
from executive.skills.motions.stow import stow_arm
from executive.skills.motions.walk import stand_still, turn_by
from executive.skills.parameters import SkillParams
from executive.skills.scripted import ScriptedSkill
from executive.skills.skill import Resource
from robot.messages import Side
from robot.model.description import RobotDescription
from robot.model.handling import Signs
from robot.model.paces import Paces
from robot.se3 import SE3, Array, Vector3, wrap_angle

GestureKind = Literal[
    "wave", "point", "nod", "shake_head", "bow",
    "raise_arm", "raise_left_arm", "raise_right_arm", "raise_both_arms",
    "lower_arm", "lower_left_arm", "lower_right_arm", "lower_both_arms",
]  # fmt: skip

HEAD_AHEAD_M = 1.5  # where the description measures a nod
TIMES = 3
AHEAD_RAD = 0.9
"""What is further to the side than this is turned to before it is pointed at."""
ARMS: dict[str, tuple[Side, ...]] = {
    "raise_left_arm": ("left",),
    "raise_right_arm": ("right",),
    "raise_both_arms": ("left", "right"),
    "lower_left_arm": ("left",),
    "lower_right_arm": ("right",),
    "lower_both_arms": ("left", "right"),
}
LOWERING = ("lower_arm", "lower_left_arm", "lower_right_arm", "lower_both_arms")
SHOWN_S = 1.0
"""So long an arm stays up."""
ONE_HANDED = ("wave", "point", "raise_arm")
HEAD_ONLY = ("nod", "shake_head")
DOING: dict[GestureKind, str] = {
    "wave": "waving", "point": "pointing", "nod": "nodding", "shake_head": "shaking the head",
    "bow": "bowing", "raise_arm": "raising an arm", "raise_left_arm": "raising the left arm",
    "raise_right_arm": "raising the right arm", "raise_both_arms": "raising both arms",
    "lower_arm": "lowering the arms", "lower_left_arm": "lowering the left arm",
    "lower_right_arm": "lowering the right arm", "lower_both_arms": "lowering both arms",
}  # fmt: skip
"""What the robot is at, as it stands in a sentence: "I fell while waving"."""


class GestureParams(SkillParams, frozen=True, kw_only=True):
    """Make a sign, towards an object, a place or a person if one is given.

    `side` is the hand to wave or point with (None: whichever is free, and fits).
    """

    kind: GestureKind
    object_id: str | None = None
    place_id: str | None = None
    person_id: str | None = None
    side: Side | None = None

    def __post_init__(self) -> None:
        """Check that there is at most one target, and one to point at."""
        targets = [self.object_id, self.place_id, self.person_id]
        given = sum(target is not None for target in targets)
        if given > 1 or (self.kind == "point" and not given):
            raise ValueError(f"a gesture ({self.kind}) is towards one thing, not {given}")
        if self.side is not None and self.kind not in ONE_HANDED:
            raise ValueError(f"{self.kind.replace('_', ' ')} is not done with one hand of a choice")


class Gesture(ScriptedSkill[GestureParams]):
    """Make a sign and come back to how the body stood."""

    name = "gesture"
    summary = "wave, point, nod, shake the head, bow, raise or lower an arm"
    takes = GestureParams
    resources = frozenset({"legs", "left_arm", "right_arm", "head"})

    @classmethod
    def lack(cls, wanted: GestureParams, robot: RobotDescription) -> str:
        """A neck, a waist, a hand to point with, or arms that know the sign."""
        kind = wanted.kind
        if kind in HEAD_ONLY:
            return "" if robot.groups["head"] else "has no neck"
        if kind == "bow":
            return "" if robot.groups["waist"] else "has no waist to bow with"
        if wanted.side is not None and wanted.side not in robot.arm_sides:
            return f"has no {wanted.side} arm"
        if kind == "point":
            return no_hand(robot)
        if robot.signs is None and kind not in LOWERING:
            return "knows no gestures of its arms"
        missing = [side for side in ARMS.get(kind, robot.arm_sides) if side not in robot.arm_sides]
        if missing or not robot.arm_sides:
            return f"has no {missing[0]} arm" if missing else "has no arms"
        return ""

    @classmethod
    def needs(cls, wanted: GestureParams) -> frozenset[Resource]:
        """The head alone for what it does alone."""
        return frozenset({"head"}) if wanted.kind in HEAD_ONLY else cls.resources

    @classmethod
    def forecast(cls, wanted: GestureParams, outlook: Outlook) -> Forecast:
        """The sign, and turning the body to what it is for where that is far to the side."""
        paces = outlook.robot.paces
        p_W = None if wanted.kind in HEAD_ONLY else _foreseen(wanted, outlook)
        aside_rad = 0.0 if p_W is None else _aside_rad(outlook.X_WS, p_W)
        if abs(aside_rad) <= AHEAD_RAD:
            return Forecast(_sign_s(wanted.kind, paces))
        outlook.move(SE3.from_xy_yaw(0.0, 0.0, aside_rad))
        turned_s = paces.begin_s + turning_s(aside_rad, paces)
        return Forecast(_sign_s(wanted.kind, paces) + turned_s)

    def script(self) -> Script[None]:
        """Face whom it is for, then make it."""
        body, kind, p_W = self.body, self.parameters.kind, self._target()
        body.phase = DOING[kind]
        if p_W is not None:
            if kind not in HEAD_ONLY:
                yield from self._face(p_W)
            yield from turn_head(body, p_W)
        if kind in HEAD_ONLY:
            yield from self._move_head(p_W)
        elif kind == "bow":
            balance = body.description.balance
            yield from stand_still(body, pitch_rad=balance.bow_rad)
            yield from body.wait(balance.bow_s)
            yield from stand_still(body)
        elif kind == "point":
            assert p_W is not None
            yield from self._point(p_W)
        elif kind in LOWERING:
            for side in ARMS.get(kind, body.description.arm_sides):
                yield from stow_arm(body, side)
        else:
            yield from self._raise(waving=kind == "wave")

    def _target(self) -> Vector3 | None:
        """The point of the world that it is towards."""
        body, wanted = self.body, self.parameters
        if wanted.person_id is not None:
            x_m, y_m, _ = body.X_WPerson(wanted.person_id).p
            return (x_m, y_m, self.body.description.gaze.eye_m)
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
        aside_rad = _aside_rad(self.body.X_WS, p_W)
        if abs(aside_rad) > AHEAD_RAD:
            yield from turn_by(self.body, aside_rad)
            yield from stand_still(self.body)

    def _move_head(self, p_W: Vector3 | None) -> Script[None]:
        """Up and down, or left and right, about where the eyes are to rest."""
        body, gaze = self.body, self.body.description.gaze
        x_m, y_m, yaw_rad = stance_of(body.X_WS)
        if p_W is not None:
            yaw_rad = math.atan2(p_W[1] - y_m, p_W[0] - x_m)
        for step in range(2 * TIMES + 1):
            side = 0.0 if step == 2 * TIMES else (1.0 if step % 2 else -1.0)
            nod = self.parameters.kind == "nod"
            aim_rad = yaw_rad if nod else yaw_rad + side * gaze.shake_rad
            height_m = gaze.eye_m + (side * gaze.nod_m if nod else 0.0)
            at = (x_m + HEAD_AHEAD_M * math.cos(aim_rad), y_m + HEAD_AHEAD_M * math.sin(aim_rad))
            yield from turn_head(body, (*at, height_m))

    def _raise(self, *, waving: bool) -> Script[None]:
        """Raise the arms that are free, wave with them if asked for, and bring them in again."""
        body, signs = self.body, self._signs()
        free = self._free_arms()
        chosen = (self.parameters.side,) if self.parameters.side else free[:1]
        wanted: tuple[Side, ...] = ARMS.get(self.parameters.kind, chosen)
        sides: tuple[Side, ...] = tuple(side for side in wanted if side in free)
        if not sides:
            raise give_up("hands_full", "there is no free hand for that")
        for side in sides:
            yield from back_away(body, side, swing_m=signs.ahead_m)
            yield from move_arm(body, side, posture_rad(body, side, signs.raised))
        for posture in signs.waving * TIMES if waving else ():
            yield from move_arm(body, sides[0], posture_rad(body, sides[0], posture))
        if not waving:
            yield from body.wait(SHOWN_S)
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
        side = self.parameters.side or (nearer if nearer in free else free[0])
        if side not in free:
            raise give_up("hands_full", f"the {side} hand is not free to point with")
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


def _sign_s(kind: GestureKind, paces: Paces) -> float:
    """How long a sign takes alone; either arm takes as long [s], and up as long as down."""
    if kind in LOWERING:
        raising = "raise_both_arms" if kind == "lower_both_arms" else "raise_arm"
        return 0.5 * (float(getattr(paces.signs_s, raising)) - SHOWN_S)
    either = "raise_arm" if kind in ("raise_left_arm", "raise_right_arm") else kind
    return float(getattr(paces.signs_s, either))


def _foreseen(wanted: GestureParams, outlook: Outlook) -> Vector3 | None:
    """Where a dry run has what it is towards; an object where the place that it stands on is."""
    person = outlook.map.person(wanted.person_id or "")
    place = outlook.map.place(wanted.place_id or "") or outlook.place_of(wanted.object_id or "")
    if person is not None:
        return person.X_WO.p
    return place.X_WP.p if place is not None else None


def _aside_rad(X_WS: SE3, p_W: Vector3) -> float:
    """How far to the side of where the robot faces a point is, positive to its left."""
    to_rad = math.atan2(p_W[1] - X_WS.p[1], p_W[0] - X_WS.p[0])
    return wrap_angle(to_rad - X_WS.yaw_rad)


def _pointing(shoulder: Array, p_W: Array, reach_m: float) -> SE3:
    """X_WG with the hand on the line from the shoulder to a point, looking along it, level."""
    x = (p_W - shoulder) / max(float(np.linalg.norm(p_W - shoulder)), 1e-6)
    y = np.cross([0.0, 0.0, 1.0], x)
    y /= max(float(np.linalg.norm(y)), 1e-6)
    return SE3.from_rotation(np.stack([x, y, np.cross(x, y)], axis=1), shoulder + reach_m * x)
