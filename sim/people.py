"""What the people of a world do: they hear the robot, take what it holds out, answer, make room.

Simulated people, and bodies moved by script: they stand for what a person would do, so that a robot
that hands something over, asks or wants to pass can be tried out. They go by what they hear and by
where things truly are. Deterministic: how fast they react is drawn from the plant's seed.
"""

from __future__ import annotations

import math
import re
from collections.abc import Generator, Sequence
from typing import Literal

import mujoco
import numpy as np

from robot.messages import Heard
from robot.model.description import RobotDescription
from sim import furniture
from sim.footprint import Point
from sim.somebody import PERIOD_S, Script, Somebody, floor
from sim.standing_room import (
    BACK_M,
    LANE_M,
    ROBOT_M,
    WALKING_M,
    WIDE_LANE_M,
    Around,
    in_the_way,
    way_out,
)
from sim.taking import Hold
from sim.world_schema import Object, World

EARSHOT_M = 3.5
REACT_S = (0.6, 1.2)
OFFERED_M = 0.85
"""How far from a person something is at most that is held out to them."""
HELD_M = 0.10
"""Between a robot's hand and the middle of what it holds."""
WAY_M = 2.0
"""Within which somebody stands in the robot's way, if they stand before it."""
AGAIN_S = 20.0
"""Who made room so short a time ago and is asked again knows that it was not enough."""
PATIENCE_S = 3.0
"""So long somebody stands until a robot has passed that is where they wanted to go."""
NEARER_M = 0.02
"""By as much they come nearer to a robot that is near already."""
Wish = Literal["take", "make room", "answer", ""]


def wish_in(text: str) -> Wish:
    """What the robot wants of whoever hears it."""
    words = text.casefold()
    if re.search(r"\bplease take\b(?! away)", words):
        return "take"
    if re.search(r"\b(excuse me|step (back|aside)|clear the way|let me (pass|through))\b", words):
        return "make room"
    return "answer" if words.rstrip().endswith("?") else ""


class People:
    """Everybody in one plant's world."""

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        world: World,
        *,
        robot: RobotDescription,
        rng: np.random.Generator,
    ) -> None:
        """They stand there, their arms hanging."""
        self._model, self._data, self._world, self._rng = model, data, world, rng
        self._base = int(model.body(robot.base_body).id)
        self._hands = [int(model.site(hand.grasp_site).id) for hand in robot.hands.values()]
        self._everybody = [Somebody(model, data, person) for person in world.people]
        self._said: list[tuple[str, str]] = []

    @property
    def busy(self) -> bool:
        """Whether anybody is doing something, or holds something."""
        return any(one.script or one.grip for one in self._everybody)

    def hear(self, text: str) -> None:
        """Let everybody in earshot hear the robot; who can do what it wants begins to."""
        wish, apart_m = wish_in(text), BACK_M if "step back" in text.casefold() else ROBOT_M
        around = self._around()
        near = [
            one
            for one in self._everybody
            if not one.script and math.dist(one.at, around.robot) <= EARSHOT_M
        ]
        for one in sorted(near, key=lambda one: math.dist(one.at, around.robot)):
            script = self._script(one, wish, around, apart_m)
            if script is not None:
                answer = "continue" if "say continue" in text.casefold() else ""
                one.script = self._do(one, script, answer)
                return

    def tick(self) -> None:
        """Go on for `PERIOD_S`."""
        for one in self._everybody:
            one.go_on()

    def press(self) -> None:
        """Add what their hands do to the forces that act in the next step."""
        for one in self._everybody:
            if one.grip is not None:
                one.grip.press()

    def said(self, stamp_s: float) -> list[Heard]:
        """What they have said since this was asked last."""
        said, self._said = self._said, []
        return [Heard(stamp_s=stamp_s, text=text, person_id=who) for who, text in said]

    # --- who does what ---

    def _script(self, one: Somebody, wish: Wish, around: Around, apart_m: float) -> Script | None:
        """What somebody does about a wish, None if it is nothing to them."""
        behaviour = one.person.behaviour
        match wish:
            case "take" if behaviour.takes and one.grip is None:
                thing = self._offered(one)
                return None if thing is None else self._take(one, thing)
            case "make room" if behaviour.steps_aside:
                is_near = math.dist(one.at, around.robot) < apart_m
                lanes_m = self._lanes_m(one)
                if is_near or in_the_way(one.at, around, within_m=WAY_M, lane_m=lanes_m[0]):
                    return self._make_room(one, apart_m, lanes_m)
            case "answer" if behaviour.answers:
                return self._answer(one, behaviour.answers)
            case _:
                pass
        return None

    def _do(self, one: Somebody, script: Script, answer: str) -> Script:
        """React after a moment, do it, and say so if that was wanted."""
        yield from _pause(float(self._rng.uniform(*REACT_S)))
        done = yield from script
        if done and answer and one.person.behaviour.answers:
            self._said.append((one.person.id, answer))
        return done

    def _answer(self, one: Somebody, text: str) -> Script:
        """Face the robot and say something."""
        yield from one.turn(lambda: self._around().robot)
        self._said.append((one.person.id, text))
        return True

    def _make_room(self, one: Somebody, apart_m: float, lanes_m: Sequence[float]) -> Script:
        """Walk out of the robot's way, if there is somewhere to go: out of the widest lane."""
        around = self._around(one)
        ways = (way_out(self._world, one.at, around, apart_m=apart_m, lane_m=m) for m in lanes_m)
        way = next(filter(None, ways), ())
        for spot in way:
            if not (yield from self._walk(one, spot)):
                break
        one.made_room_s = self._data.time
        return bool(way)

    def _walk(self, one: Somebody, spot: Point) -> Script:
        """Walk to a spot; whoever would walk into a robot that has walked on stands instead.

        False if it does not leave.
        """
        walk, patience_s = one.walk(spot), PATIENCE_S
        least_m = min(WALKING_M, math.dist(one.at, self._robot) - NEARER_M)
        while patience_s > 0.0:
            if math.dist(one.step_towards(spot), self._robot) < least_m:
                patience_s -= PERIOD_S
            elif next(walk, "over") == "over":
                return True
            yield
        return False

    @property
    def _robot(self) -> Point:
        """Where the robot is on the floor."""
        return floor(self._data.xpos[self._base])

    def _lanes_m(self, one: Somebody) -> tuple[float, ...]:
        """How wide a lane somebody leaves, best first: who has to make room again leaves more."""
        again = self._data.time - one.made_room_s < AGAIN_S
        return (WIDE_LANE_M, LANE_M) if again else (LANE_M,)

    # --- taking ---

    def _take(self, one: Somebody, thing: Object) -> Script:
        """Turn to it, step up if need be, close the hand on it, pull it out, and keep it."""
        body = int(self._model.body(f"object/{thing.id}").id)
        yield from one.turn(lambda: floor(self._data.xpos[body]))
        hold = Hold(self._model, self._data, one, body, thing)
        yield from hold.step_up()
        yield from hold.reach()
        if not hold.is_there:
            yield from hold.let_go()
            return False
        yield from hold.close()
        one.grip = hold.grip
        if (yield from hold.pull()):
            return True
        one.grip = None
        yield from hold.let_go()
        return False

    def _offered(self, one: Somebody) -> Object | None:
        """What a hand of the robot holds within reach of somebody."""
        for thing in self._world.objects:
            p = self._data.body(f"object/{thing.id}").xpos
            held = any(math.dist(self._data.site_xpos[hand], p) < HELD_M for hand in self._hands)
            if held and math.dist(floor(p), one.at) < OFFERED_M:
                return thing
        return None

    # --- what is around ---

    def _around(self, but: Somebody | None = None) -> Around:
        """The robot, the others, and what is movable, as they truly are."""
        rotation = self._data.xmat[self._base].reshape(3, 3)
        others = [(one.at, 0.25) for one in self._everybody if one is not but]
        for item in self._world.furniture:
            if furniture.movable(item):
                depth, width, _ = furniture.size_m(item)
                p = self._data.body(f"furniture/{item.id}").xpos
                others.append((floor(p), 0.5 * math.hypot(depth, width)))
        heading_rad = math.atan2(rotation[1, 0], rotation[0, 0])
        return Around(floor(self._data.xpos[self._base]), heading_rad, tuple(others))


def _pause(duration_s: float) -> Generator[None]:
    for _ in range(round(duration_s / PERIOD_S)):
        yield
