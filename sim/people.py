"""What the people of a world do: they hear the robot, take what it holds out, answer, make room.

Simulated people, and bodies moved by script: they stand for what a person would do, so that a robot
that hands something over, asks or wants to pass can be tried out. They go by what they hear and by
where things truly are. Deterministic: how fast they react is drawn from the plant's seed.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Generator
from typing import Literal, TypeAlias

import mujoco
import numpy as np

from robot.messages import Heard
from robot.model.description import RobotDescription
from robot.se3 import SE3, Array, wrap_angle
from sim import furniture, person_arm
from sim.footprint import Point
from sim.grip import PULL_N, Grip
from sim.person_arm import ArmSide, PersonArm
from sim.standing_room import Around, free_spot, in_the_way
from sim.world_schema import Object, Person, World

PERIOD_S = 0.004
"""Between two looks at a hand that pulls: a hold of 30 rad/s is stable up to 30 ms."""
EARSHOT_M = 3.5
REACT_S = (0.6, 1.2)
WALK_M_S, TURN_RAD_S, HAND_M_S = 0.4, 1.2, 0.35
DRAW_M_S = 0.15
"""How fast they draw a hand back with something in it: slower than a robot's fingers open."""
CLOSE_S, BEAR_S, PATIENCE_S = 0.4, 0.5, 4.0
"""Closing the fingers; taking over the weight; pulling at what does not come."""
OFFERED_M = 0.85
"""How far from a person something is at most that is held out to them."""
HELD_M = 0.10
"""Between a robot's hand and the middle of what it holds."""
STEP_UP_M = 0.25
"""How far they step up to take something; not so far that a hand touches their body."""
LOST_M = 0.15
"""How far out of the hand something is that they have lost."""
WAY_M = 2.0
"""Within which somebody stands in the robot's way, if they stand before it."""
KEPT = (0.26, 0.17, 1.06)
"""Where a figure of 1.70 m keeps what it has taken, on its left: before the ribs."""

Wish = Literal["take", "make room", "answer", ""]
Script: TypeAlias = Generator[None, None, bool]
"""What somebody does, tick by tick; True if it came to what was asked for."""


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
        self._everybody = [_Somebody(model, data, person) for person in world.people]
        self._said: list[tuple[str, str]] = []

    @property
    def busy(self) -> bool:
        """Whether anybody is doing something, or holds something."""
        return any(one.script or one.grip for one in self._everybody)

    def hear(self, text: str) -> None:
        """Let everybody in earshot hear the robot; who can do what it wants begins to."""
        wish = wish_in(text)
        around = self._around()
        near = [
            one
            for one in self._everybody
            if not one.script and math.dist(one.at, around.robot) <= EARSHOT_M
        ]
        for one in sorted(near, key=lambda one: math.dist(one.at, around.robot)):
            script = self._script(one, wish, around)
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

    def _script(self, one: _Somebody, wish: Wish, around: Around) -> Script | None:
        """What somebody does about a wish, None if it is nothing to them."""
        behaviour = one.person.behaviour
        match wish:
            case "take" if behaviour.takes and one.grip is None:
                thing = self._offered(one)
                return None if thing is None else self._take(one, thing)
            case "make room" if behaviour.steps_aside:
                if in_the_way(one.at, around, within_m=WAY_M):
                    return self._make_room(one)
            case "answer" if behaviour.answers:
                return self._answer(one, behaviour.answers)
            case _:
                pass
        return None

    def _do(self, one: _Somebody, script: Script, answer: str) -> Script:
        """React after a moment, do it, and say so if that was wanted."""
        yield from _pause(float(self._rng.uniform(*REACT_S)))
        done = yield from script
        if done and answer and one.person.behaviour.answers:
            self._said.append((one.person.id, answer))
        return done

    def _answer(self, one: _Somebody, text: str) -> Script:
        """Face the robot and say something."""
        yield from one.turn(lambda: self._around().robot)
        self._said.append((one.person.id, text))
        return True

    def _make_room(self, one: _Somebody) -> Script:
        """Walk out of the robot's way, if there is somewhere to go."""
        spot = free_spot(self._world, one.at, self._around(one))
        if spot is None:
            return False
        yield from one.walk(spot)
        return True

    # --- taking ---

    def _take(self, one: _Somebody, thing: Object) -> Script:
        """Turn to it, step up if need be, close the hand on it, pull it out, and keep it."""
        body = int(self._model.body(f"object/{thing.id}").id)
        yield from one.turn(lambda: _floor(self._data.xpos[body]))
        hold = _Hold(self._model, self._data, one, body, thing)
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

    def _offered(self, one: _Somebody) -> Object | None:
        """What a hand of the robot holds within reach of somebody."""
        for thing in self._world.objects:
            p = self._data.body(f"object/{thing.id}").xpos
            held = any(math.dist(self._data.site_xpos[hand], p) < HELD_M for hand in self._hands)
            if held and math.dist(_floor(p), one.at) < OFFERED_M:
                return thing
        return None

    # --- what is around ---

    def _around(self, but: _Somebody | None = None) -> Around:
        """The robot, the others, and what is movable, as they truly are."""
        rotation = self._data.xmat[self._base].reshape(3, 3)
        others = [(one.at, 0.25) for one in self._everybody if one is not but]
        for item in self._world.furniture:
            if furniture.movable(item):
                depth, width, _ = furniture.size_m(item)
                p = self._data.body(f"furniture/{item.id}").xpos
                others.append((_floor(p), 0.5 * math.hypot(depth, width)))
        heading_rad = math.atan2(rotation[1, 0], rotation[0, 0])
        return Around(_floor(self._data.xpos[self._base]), heading_rad, tuple(others))


class _Somebody:
    """One person's body: a mocap body that glides, two arms, and what they are doing."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, person: Person) -> None:
        self.person, self._data = person, data
        self._mocap = int(model.body_mocapid[model.body(f"person/{person.id}").id])
        sides: tuple[ArmSide, ArmSide] = ("left", "right")
        self.arms = {side: PersonArm(model, person.id, side) for side in sides}
        self.script: Script | None = None
        self.grip: Grip | None = None

    @property
    def X_WPerson(self) -> SE3:
        """Where they stand; a fault may have put them there."""
        p, quat = self._data.mocap_pos[self._mocap], self._data.mocap_quat[self._mocap]
        return SE3(tuple(p.tolist()), tuple(quat.tolist()))

    @property
    def at(self) -> Point:
        """Where they stand on the floor."""
        return _floor(self._data.mocap_pos[self._mocap])

    def go_on(self) -> None:
        """One tick of what they are doing; they drop what was torn out of their hand."""
        if self.script is not None and next(self.script, "over") == "over":
            self.script = None
        if self.grip is not None and math.dist(self.grip.at, self.grip.where) > LOST_M:
            self.grip = self.script = None
            for arm in self.arms.values():
                arm.hang()

    def walk(self, spot: Point) -> Generator[None]:
        """Glide to a spot, facing as before."""
        while (left_m := math.dist(self.at, spot)) > 1e-3:
            part = min(1.0, WALK_M_S * PERIOD_S / left_m)
            pos = self._data.mocap_pos[self._mocap]
            pos[:2] += part * (np.array(spot) - pos[:2])
            yield

    def turn(self, towards: Callable[[], Point]) -> Generator[None]:
        """Turn on the spot to face a point, wherever that is by then."""
        while True:
            (x, y), (to_x, to_y) = self.at, towards()
            yaw_rad = self.X_WPerson.yaw_rad
            left_rad = wrap_angle(math.atan2(to_y - y, to_x - x) - yaw_rad)
            most_rad = TURN_RAD_S * PERIOD_S
            yaw_rad += max(-most_rad, min(most_rad, left_rad))
            quat = SE3.from_xy_yaw(0.0, 0.0, yaw_rad).quat_wxyz
            self._data.mocap_quat[self._mocap] = quat
            if abs(left_rad) <= most_rad:
                return
            yield


class _Hold:
    """A hand of somebody on its way to an object, on it, and away with it."""

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        one: _Somebody,
        body: int,
        thing: Object,
    ) -> None:
        self._one, self._data, self._body = one, data, body
        side: ArmSide = "left" if self._local(data.xpos[body])[1] > 0.0 else "right"
        self._arm = one.arms[side]
        self._side = 1.0 if side == "left" else -1.0
        self._half_m = 0.5 * max(thing.size_m[:2])
        self._high_m = 0.28 * thing.size_m[2]  # above the robot's fingers, on the upper third
        self._closed = 0.0
        self._hand: Array = self._arm.palm.copy()
        self.grip = Grip(model, data, body)

    @property
    def is_there(self) -> bool:
        """Whether the palm lies against the object."""
        return math.dist(self._arm.palm, self._palm_for(self._local(self.grip.where))) < 0.02

    def step_up(self) -> Generator[None]:
        """Step towards the object as far as the arm is short of it."""
        one, thing = self._one, self._local(self._data.xpos[self._body])
        wrist = self._palm_for(thing) - self._arm.hand_m * self._into(thing)
        far = wrist - self._arm.shoulder
        across_m = math.hypot(far[1], far[2])
        spare_m = math.sqrt(max(self._arm.reach_m**2 - across_m**2, 0.0))
        step_m = min(STEP_UP_M, far[0] - spare_m + 0.03)
        if step_m > 0.0:
            x, y, _ = one.X_WPerson.apply((step_m, 0.0, 0.0))
            yield from one.walk((float(x), float(y)))

    def reach(self) -> Generator[None]:
        """Bring the open hand to the object."""
        for _ in range(round(3.0 / PERIOD_S)):
            goal = self._palm_for(self._local(self.grip.where))
            if self._move(goal, HAND_M_S) < 1e-3:
                return
            yield

    def close(self) -> Generator[None]:
        """Close the fingers."""
        for k in range(1, round(CLOSE_S / PERIOD_S) + 1):
            self._closed = k * PERIOD_S / CLOSE_S
            self._move(self._palm_for(self._local(self.grip.where)), HAND_M_S)
            yield

    def pull(self) -> Script:
        """Bear the weight, draw it up and back as it comes, and keep it; False if it never comes.

        The harder it is held, the slower they draw: never harder than `PULL_N`.
        """
        scale = self._one.person.height_m / 1.70
        keep = scale * np.array((KEPT[0], self._side * KEPT[1], KEPT[2]))
        stuck_s = 0.0
        at = self._local(self.grip.at)
        while (left_m := float(np.linalg.norm(keep - at))) > 1e-3:
            self.grip.share = min(1.0, self.grip.share + PERIOD_S / BEAR_S)
            held_back = float(np.linalg.norm(self.grip.pull_n)) / PULL_N
            stuck_s = stuck_s + PERIOD_S if held_back > 0.5 else 0.0
            if stuck_s > PATIENCE_S:
                return False
            step_m = DRAW_M_S * PERIOD_S * max(0.0, 1.0 - held_back)
            at = at + min(1.0, step_m / left_m) * (keep - at)
            self.grip.at = self._world(at)
            self._move(self._palm_for(self._local(self.grip.where)), 4.0 * HAND_M_S)
            yield
        return True

    def let_go(self) -> Generator[None]:
        """Open the hand, and let the arm down again."""
        self._closed = 0.0
        while self._move(self._arm.hanging, HAND_M_S) > 1e-3:
            yield
        self._arm.hang()

    def _palm_for(self, thing: Array) -> Array:
        """Where the palm lies against an object: on this person's side of it."""
        into = self._into(thing)
        lifted = np.array([0.0, 0.0, self._high_m])
        return thing + lifted - (self._half_m + person_arm.PALM_M) * into

    def _into(self, thing: Array) -> Array:
        """The unit vector in which the hand comes to an object: level, from the shoulder."""
        off = thing - self._arm.shoulder
        off[2] = 0.0
        return off / max(float(np.linalg.norm(off)), 1e-6)

    def _move(self, palm: Array, speed_m_s: float) -> float:
        """Move the palm towards a point for one tick; how far it is from it then [m]."""
        left_m = float(np.linalg.norm(palm - self._hand))
        self._hand = self._hand + min(1.0, speed_m_s * PERIOD_S / max(left_m, 1e-9)) * (
            palm - self._hand
        )
        into = self._into(self._local(self.grip.where))
        self._arm.put(self._hand, into, half_m=self._half_m, closed=self._closed)
        return float(np.linalg.norm(palm - self._hand))

    def _local(self, p_W: Array) -> Array:
        return np.asarray(self._one.X_WPerson.inverse().apply(p_W), dtype=float)

    def _world(self, p: Array) -> Array:
        return np.asarray(self._one.X_WPerson.apply(p), dtype=float)


def _pause(duration_s: float) -> Generator[None]:
    for _ in range(round(duration_s / PERIOD_S)):
        yield


def _floor(p: Array) -> Point:
    return (float(p[0]), float(p[1]))
