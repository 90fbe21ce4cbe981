"""How near an arm may come to things on its way: as much room as there is, at every posture."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from robot.planning.robot_body import Arm
from robot.planning.scene import Scene, Touch
from robot.se3 import Array

STRAY_M = 0.004
"""The spline may stray from the path by this much [m]."""
RESOLUTION_RAD = 0.02  # 0.05 let collisions through
TILT_RAD = 0.35


class Rung(NamedTuple):
    """A clearance [m], and after how many checks of a search there is taken to be no way with it.

    Counts instead of times, so that a seed gives the same plan on any machine.
    """

    clearance_m: float
    checks: int


RUNGS = (Rung(0.03, 2_000), Rung(0.02, 2_000), Rung(0.012, 12_000))
"""Tried in turn: as much as there is room for. An arm sags by 1 cm under a load, and an IMU that is
askew has it lower still; with less than the last, the fingers topple what they pass by."""
LEAST = RUNGS[-1]


@dataclass(slots=True)
class Corridor:
    """Whether an arm's joint values are free; remembers what was in the way.

    `slack` are pairs that may come as near as this [m], as they are no farther apart at the start
    or the goal.
    """

    scene: Scene
    arm: Arm
    allowed: frozenset[str]
    clearance_m: float = LEAST.clearance_m
    slack: dict[tuple[str, str], float] = field(default_factory=dict)
    ups: list[Array] = field(default_factory=list)
    blocked: Counter[str] = field(default_factory=Counter)

    def __post_init__(self) -> None:
        """Ask the scene for the clearance."""
        self.scene.set_clearance(self.clearance_m)

    def wider(self, clearance_m: float, ends: list[Array]) -> Corridor:
        """One in which more is kept clear, but by what is nearer than that at one of the ends."""
        other = Corridor(
            self.scene, self.arm, self.allowed, clearance_m, dict(self.slack), self.ups
        )
        for q in ends:
            other.admit(other.touches(q))
        return other

    def admit(self, touches: list[Touch]) -> None:
        """Let these pairs stay as near as they are."""
        for touch in touches:
            pair = (touch.first, touch.second)
            limit_m = touch.distance_m - 0.001
            self.slack[pair] = min(self.slack.get(pair, np.inf), limit_m)

    def touches(self, q: Array | list[float]) -> list[Touch]:
        """What the arm is too near to."""
        self.scene.set_motors(self.arm.motors, q)
        self.scene.update()
        return self.scene.touches(
            self.scene.arm_geoms(self.arm.side), allowed=self.allowed, slack=self.slack
        )

    def free(self, q: Array | list[float]) -> bool:
        """Whether it is near nothing, and upright if it must be."""
        touches = self.touches(q)
        if touches:
            self.blocked[touches[0].second] += 1
            return False
        return not self.ups or self._upright()

    def _upright(self) -> bool:
        up = self.scene.grasp_rotation(self.arm.side)[6:9]
        if max(float(up @ wanted) for wanted in self.ups) >= math.cos(TILT_RAD):
            return True
        self.blocked["keeping it upright"] += 1
        return False

    def keep_upright(self, q: Array) -> None:
        """From now on the hand's tilt must be about that at `q` (or at others so given)."""
        self.scene.set_motors(self.arm.motors, q)
        self.scene.update()
        self.ups.append(self.scene.grasp_rotation(self.arm.side)[6:9].copy())

    def line_free(self, a: Array, b: Array) -> bool:
        """Whether the straight line between two free states is free."""
        count = max(2, math.ceil(float(np.linalg.norm(b - a)) / RESOLUTION_RAD))
        # Coarse steps first, then those between: what is in the way is met soonest.
        order = sorted(range(1, count), key=lambda i: i & -i, reverse=True)
        return self.free(b) and all(self.free(a + (b - a) * (i / count)) for i in order)

    def all_free(self, path: Array) -> bool:
        """Whether every state of a dense path is free."""
        return all(self.free(q) for q in path)

    def spline_free(self, path: Array) -> bool:
        """The same of the spline through a path that is free, which strays from it a little."""
        least_m, kept = LEAST.clearance_m - STRAY_M, self.slack
        self.slack = {
            pair: min(limit_m, max(limit_m - STRAY_M, least_m)) for pair, limit_m in kept.items()
        }
        self.scene.set_clearance(self.clearance_m - STRAY_M)
        free = self.all_free(path)
        self.scene.set_clearance(self.clearance_m)
        self.slack = kept
        return free
