"""One simulated person's body: it glides and turns, has two arms, and does what a script says."""

from __future__ import annotations

import math
from collections.abc import Callable, Generator
from typing import TypeAlias

import mujoco

from robot.se3 import SE3, Array, wrap_angle
from sim.footprint import Point
from sim.grip import Grip
from sim.person_arm import ArmSide, PersonArm
from sim.world_schema import Person

PERIOD_S = 0.004
"""Between two looks at a hand that pulls: a hold of 30 rad/s is stable up to 30 ms."""
WALK_M_S, TURN_RAD_S = 0.4, 1.2
LOST_M = 0.15
"""How far out of the hand something is that they have lost."""

Script: TypeAlias = Generator[None, None, bool]
"""What somebody does, tick by tick; True if it came to what was asked for."""


class Somebody:
    """One person's body: a mocap body that glides, two arms, and what they are doing."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, person: Person) -> None:
        self.person, self._data = person, data
        self._mocap = int(model.body_mocapid[model.body(f"person/{person.id}").id])
        sides: tuple[ArmSide, ArmSide] = ("left", "right")
        self.arms = {side: PersonArm(model, person.id, side) for side in sides}
        self.script: Script | None = None
        self.grip: Grip | None = None
        self.made_room_s = -math.inf

    @property
    def X_WPerson(self) -> SE3:
        """Where they stand; a fault may have put them there."""
        p, quat = self._data.mocap_pos[self._mocap], self._data.mocap_quat[self._mocap]
        return SE3(tuple(p.tolist()), tuple(quat.tolist()))

    @property
    def at(self) -> Point:
        """Where they stand on the floor."""
        return floor(self._data.mocap_pos[self._mocap])

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
        while math.dist(self.at, spot) > 1e-3:
            self._data.mocap_pos[self._mocap][:2] = self.step_towards(spot)
            yield

    def step_towards(self, spot: Point) -> Point:
        """Where they are one tick on, if they go there."""
        x, y = self.at
        left_m = math.dist((x, y), spot)
        part = min(1.0, WALK_M_S * PERIOD_S / max(left_m, 1e-9))
        return (x + part * (spot[0] - x), y + part * (spot[1] - y))

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


def floor(p: Array) -> Point:
    """The point of the floor under a point."""
    return (float(p[0]), float(p[1]))
