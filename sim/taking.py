"""How a simulated person takes what is held out: hand to it, fingers about it, up, back, and keep.

The hand is soft (`sim.grip`): a robot that holds on feels it pull, and is not dragged along.
"""

from __future__ import annotations

import math
from collections.abc import Generator

import mujoco
import numpy as np

from robot.se3 import Array
from sim import person_arm
from sim.grip import PULL_N, Grip
from sim.person_arm import ArmSide
from sim.somebody import PERIOD_S, Script, Somebody
from sim.world_schema import Object

HAND_M_S = 0.35
DRAW_M_S = 0.15
"""How fast they draw a hand back with something in it: slower than a robot's fingers open."""
CLOSE_S, BEAR_S, PATIENCE_S = 0.4, 0.5, 4.0
"""Closing the fingers; taking over the weight; pulling at what does not come."""
STEP_UP_M = 0.25
"""How far they step up to take something; not so far that a hand touches their body."""
LIFT_M = (-0.06, 0.0, 0.08)
"""How they draw at first: back and up, as one lifts a cup out of fingers. A level pull of 8 N moved
a robot's arm less than the 2 cm at which it lets go (1 of 26 tries: the box, held stiffly)."""
KEPT = (0.26, 0.17, 1.06)
"""Where a figure of 1.70 m keeps what it has taken, on its left: before the ribs."""


class Hold:
    """A hand of somebody on its way to an object, on it, and away with it."""

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        one: Somebody,
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
        """Bear the weight, draw it up and back as it comes, keep it; False if it never comes."""
        scale = self._one.person.height_m / 1.70
        keep = scale * np.array((KEPT[0], self._side * KEPT[1], KEPT[2]))
        lifted = self._local(self.grip.at) + np.array(LIFT_M)
        return (yield from self._draw(lifted)) and (yield from self._draw(keep))

    def _draw(self, keep: Array) -> Script:
        """Draw what is held to a point; the harder it is held, the slower, so never too hard."""
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
