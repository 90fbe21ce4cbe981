"""A body alone: a plant and the controller on it, no sensors but the body's own, one thread.

The controller sees what it would see of motors; `X_WB`, `X_WS` and the like are the simulator's
truth, for the judge only.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from robot.control.loop import BUS_PERIOD_S, ControlLoop
from robot.messages import BodyCommand, Channel
from robot.model import description
from robot.reality.contract import USUAL
from robot.se3 import SE3, wrap_angle
from sim.plant import Plant
from sim.world import empty
from sim.world_schema import World

STEPS = round(BUS_PERIOD_S / 0.001)


class Rig:
    """One robot on a floor.

    Attributes:
        plant: reality's stand-in.
        loop: the controller.
        X_WN: where the odometry frame truly began.
    """

    def __init__(
        self,
        *,
        seed: int = 0,
        world: World | None = None,
        robot: str = "juno",
        reality: str = USUAL,
    ) -> None:
        """Stand at the world's start; noise, and what is wrong, is drawn from `seed`."""
        self.robot = description.load(robot)
        self.plant = Plant(world or empty(), self.robot, seed=seed, reality=reality)
        self.loop = ControlLoop(self.robot)
        self.X_WN = self.X_WS
        self._last_id = 0

    @property
    def time_s(self) -> float:
        """Simulated time."""
        return self.plant.time_s

    def send(self, kind: type[BodyCommand], **fields: Any) -> int:
        """Send a command with these fields; returns its id."""
        self._last_id += 1
        self.loop.handle(kind(stamp_s=self.time_s, id=self._last_id, **fields))
        return self._last_id

    def run(self, duration_s: float) -> bool:
        """Let time pass; False as soon as the motors gave up (down, or damping)."""
        plant, loop = self.plant, self.loop
        for _ in range(round(duration_s / BUS_PERIOD_S)):
            plant.write(loop.tick(plant.read()))
            plant.step(STEPS)
            if loop.mode in ("fallen", "damping"):
                return False
        return True

    def pass_by(self, duration_s: float) -> None:
        """Let time pass, whatever becomes of the robot."""
        end_s = self.time_s + duration_s
        while self.time_s < end_s:
            self.run(BUS_PERIOD_S)

    def wait(self, channel: Channel, timeout_s: float) -> str:
        """Run until the channel's activity ends: `done`, `failed`, `fell` or `timeout`."""
        end_s = self.time_s + timeout_s
        while self.time_s < end_s:
            if not self.run(0.02):
                return "fell"
            status = self.loop.state().activities[channel].status
            if status != "running":
                return status
        return "timeout"

    @property
    def X_WB(self) -> SE3:
        """True pose of the pelvis."""
        return self.plant.oracle.X_WB()

    @property
    def X_WS(self) -> SE3:
        """True stance: midpoint and mean heading of the soles, on the floor."""
        soles = [self.site(foot.sole_site) for foot in self.robot.feet.values()]
        x, y = (float(np.mean([sole.p[k] for sole in soles])) for k in (0, 1))
        yaw = soles[0].yaw_rad + 0.5 * wrap_angle(soles[1].yaw_rad - soles[0].yaw_rad)
        return SE3.from_xy_yaw(x, y, yaw)

    @property
    def X_NS(self) -> SE3:
        """Estimated stance."""
        return self.loop.state().X_NS

    def site(self, name: str) -> SE3:
        """True pose of one of the robot's sites."""
        site = self.plant.data.site(name)
        return SE3.from_rotation(site.xmat.reshape(3, 3), site.xpos)

    @property
    def upright(self) -> bool:
        """Truly on its feet: the trunk within 40 degrees of vertical, the pelvis high."""
        X_WB = self.X_WB
        up = float(X_WB.rotation()[2, 2])
        return up > math.cos(math.radians(40.0)) and X_WB.p[2] > 0.35

    def drift_m(self) -> float:
        """How far the estimated stance is from the true one."""
        return planar_error(self.X_WN @ self.X_NS, self.X_WS)[0]


def planar_error(X_WA: SE3, X_WB: SE3) -> tuple[float, float]:
    """Distance [m] and turn [rad] in the plane between two poses."""
    X_AB = X_WA.flat().inverse() @ X_WB.flat()
    return math.hypot(X_AB.p[0], X_AB.p[1]), abs(X_AB.yaw_rad)
