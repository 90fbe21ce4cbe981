"""Hand over what is held: go to the person, hold it out, let go when they pull."""

from __future__ import annotations

import math

from executive.skills.ability import no_hand
from executive.skills.context import SkillContext
from executive.skills.forecast import Forecast, Outlook
from executive.skills.holding import Held
from executive.skills.motions.body_access import Body
from executive.skills.motions.fingers import (
    check_taken,
    closed_on_air,
    open_fingers,
    set_payload,
)
from executive.skills.motions.gaze import look_at
from executive.skills.motions.reach import move_arm, posture_rad
from executive.skills.motions.script import GaveUp, Script, give_up
from executive.skills.motions.standpoints import stances_around, stances_before, walk_to_any
from executive.skills.motions.stow import HOME, stow_arms
from executive.skills.parameters import SkillParams
from executive.skills.scripted import ScriptedSkill
from robot.messages import PersonInfo, Side
from robot.model.description import RobotDescription
from robot.se3 import SE3

FACE_M = 1.5
SETTLE_S = 0.6
TAKE_S, ASK_AGAIN_S = 20.0, 8.0
CLEAR_S = 0.8
NOT_THERE = ("out_of_reach", "goal_in_collision", "no_path", "planner_timeout")


class GiveParams(SkillParams, frozen=True, kw_only=True):
    """Hand what is held to a person."""

    object_id: str
    person_id: str


class Give(ScriptedSkill[GiveParams]):
    """Give a held object to a person; ends with the hand empty, or the object back in it."""

    name = "give"
    summary = "hand what a hand holds to a person, who pulls it out"
    takes = GiveParams
    resources = frozenset({"legs", "head", "left_arm", "right_arm", "voice"})

    @classmethod
    def lack(cls, wanted: GiveParams, robot: RobotDescription) -> str:
        """A hand."""
        return no_hand(robot)

    @classmethod
    def forecast(cls, wanted: GiveParams, outlook: Outlook) -> Forecast:
        """The way, holding it out, and letting go of it; they are taken to pull at once."""
        person = outlook.map.person(wanted.person_id)
        outlook.hand_over(wanted.object_id)
        if person is None:
            return Forecast(outlook.robot.paces.give_s)
        before_m = outlook.robot.handy.giving.before_person_m
        stances = stances_around(person.X_WO.p, outlook.X_WS, distance_m=before_m)
        return outlook.walk(stances).then(outlook.robot.paces.give_s)

    def __init__(self, parameters: GiveParams, context: SkillContext) -> None:
        """What to whom."""
        super().__init__(parameters, context)
        self._given = False

    def script(self) -> Script[None]:
        """Go there, hold it out, wait for the pull, let go, draw the hand back."""
        body = self.body
        info = body.object_info(self.parameters.object_id)
        person = body.person(self.parameters.person_id)
        held = body.context.holdings.find(info.id)
        if held is None:
            raise give_up("not_holding", f"no hand holds the {info.name}", object=info.id)
        body.companion = person.id
        yield from stow_arms(body)
        yield from go_before(body, person)
        check_taken(body)
        body.phase = f"holding out the {info.name}"
        yield from hold_out(body, held)
        look_at(body, (*body.X_WPerson(person.id).p[:2], FACE_M))
        yield from body.wait(SETTLE_S)
        words = f"Please take the {info.name}."
        body.context.say(words)
        body.phase = f"waiting for {person.name} to take the {info.name}"
        if (yield from pulled(body, held.side, ask_again=words)):
            yield from self._let_go(held)
            return
        body.phase = f"keeping the {info.name}"
        yield from move_arm(body, held.side, held.carry_rad, keep_upright=held.upright)
        raise give_up(
            "not_taken",
            f"{person.name} did not take the {info.name} within {TAKE_S:.0f} s",
            object=info.id,
            person=person.id,
        )

    def remaining(self) -> GiveParams | None:
        """Nothing, once the hand has begun to let go."""
        return None if self._given else self.parameters

    def _let_go(self, held: Held) -> Script[None]:
        """Open, give them time to draw it out, and bring the arm home."""
        body, side = self.body, held.side
        body.phase = "letting go"
        self._given = True
        body.context.holdings.hand_over(side, self.parameters.person_id)
        set_payload(body, side, 0.0)
        yield from open_fingers(body, side)
        yield from body.wait(CLEAR_S)
        body.phase = f"bringing the {side} arm in"
        yield from move_arm(
            body, side, posture_rad(body, side, HOME), allowed=(held.object_id,), speed=0.6
        )


def go_before(body: Body, person: PersonInfo) -> Script[None]:
    """Stand before a person, as near as a hand-over needs."""
    body.phase = f"walking to {person.name}"
    before_m = body.description.handy.giving.before_person_m
    stances = stances_before(body, person, distance_m=before_m)
    yield from walk_to_any(body, stances, name=person.name)


def hold_out(body: Body, held: Held) -> Script[None]:
    """Bring the object forward at the height of a person's hands, upright."""
    sign, places = 1.0 if held.side == "left" else -1.0, body.description.handy.giving.held_out_m
    for attempt, (ahead_m, aside_m, height_m) in enumerate(places):
        X_SG = body.X_WS.inverse() @ body.X_WG(held.side)
        at = SE3((ahead_m, sign * aside_m, height_m), X_SG.quat_wxyz)
        try:
            yield from move_arm(body, held.side, body.X_WS @ at, keep_upright=held.upright)
        except GaveUp as end:
            if attempt + 1 == len(places) or end.failure.code not in NOT_THERE:
                raise
        else:
            return


def pulled(body: Body, side: Side, *, ask_again: str) -> Script[bool]:
    """Wait until somebody pulls at what a hand holds out; False if nobody does.

    A pull shows as a change of the wrist's load, as the hand giving way, or as fingers that meet.
    """
    rest_n, X_NG_rest = body.hand(side).load_n, body.hand(side).X_NG
    giving = body.description.handy.giving
    begin_s, since_s, asked = body.now_s, math.inf, False
    while body.now_s - begin_s < TAKE_S:
        yield
        hand = body.hand(side)
        given_way_m = math.dist(hand.X_NG.p, X_NG_rest.p)
        if closed_on_air(body, hand.opening_m):
            return True
        if abs(hand.load_n - rest_n) < giving.pull_n and given_way_m < giving.pulled_m:
            since_s = math.inf
        elif math.isinf(since_s):
            since_s = body.now_s
        elif body.now_s - since_s >= giving.pull_s:
            return True
        if not asked and body.now_s - begin_s > ASK_AGAIN_S:
            asked = True
            body.context.say(ask_again)
    return False
