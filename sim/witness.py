"""Watches a plant while it runs, for the judge: the way, what was touched, what was said."""

from __future__ import annotations

import math
from typing import NamedTuple

import mujoco
import numpy as np
import numpy.typing as npt

from robot.se3 import SE3
from sim.plant import Plant

PERIOD_S = 0.01
"""Of looking at contacts, so that what is only grazed counts as well."""
WAY_PERIOD_S = 0.1
MOVING_M_S = 0.1
"""Slower is standing and swaying: somebody who comes near then is not run into."""
TOO_NEAR_M = 0.5
"""From axis to axis; a person is a disc of 0.25 m, the robot one of about 0.2 m."""


class Step(NamedTuple):
    """Where the base was."""

    time_s: float
    x_m: float
    y_m: float


class Witness:
    """What one plant does from now on.

    Attributes:
        begin: where every object was when the watching began.
        way: of the base, at 10 Hz.
        said: what the robot said aloud.
        touched: what it touched (docs/evaluation.md), in words, by when [s] that was first.
        too_near: the people it came too near while it walked, by how near [m].
    """

    def __init__(self, plant: Plant) -> None:
        """Begin to watch."""
        self._plant = plant
        self.begin: dict[str, SE3] = plant.oracle.poses()
        self.way: list[Step] = [self._here()]
        self.said: list[str] = []
        self.touched: dict[str, float] = {}
        self.too_near: dict[str, float] = {}
        self._next_s = self._next_step_s = plant.time_s
        self._parts = _Parts(plant)
        self._seen: set[tuple[int, int]] = set()

    def look(self) -> None:
        """After every step of the plant: note what is new."""
        now_s = self._plant.time_s
        if now_s < self._next_s:
            return
        self._next_s = now_s + PERIOD_S
        self._touches(now_s)
        if now_s >= self._next_step_s:
            self._next_step_s = now_s + WAY_PERIOD_S
            self._walked()

    def _here(self) -> Step:
        x_m, y_m, _ = self._plant.oracle.X_WB().p
        return Step(self._plant.time_s, x_m, y_m)

    def _walked(self) -> None:
        before, now = self.way[-1], self._here()
        self.way.append(now)
        elapsed_s = now.time_s - before.time_s
        if elapsed_s <= 0.0 or math.dist(before[1:], now[1:]) < MOVING_M_S * elapsed_s:
            return
        for person in self._plant.world.people:
            far_m = math.dist(self._plant.where(f"person/{person.id}").p[:2], now[1:])
            if far_m < min(TOO_NEAR_M, self.too_near.get(person.id, TOO_NEAR_M)):
                self.too_near[person.id] = far_m

    def _touches(self, now_s: float) -> None:
        pairs = self._parts.touching(self._plant.data)
        for ours, theirs in pairs - self._seen:
            self.touched.setdefault(self._parts.words(ours, theirs), round(now_s, 2))
        self._seen |= pairs


class _Parts:
    """Whose geom is whose."""

    def __init__(self, plant: Plant) -> None:
        model = self._model = plant.model
        root = model.body_rootid[model.body(plant.robot.base_body).id]
        robot = model.body_rootid[model.geom_bodyid] == root
        hands = {
            body
            for hand in plant.robot.hands.values()
            for body in _below(model, model.body(hand.body).id)
        }
        self._hand = np.array([body in hands for body in model.geom_bodyid])
        self._robot = robot
        names = [model.body(body).name for body in model.geom_bodyid]
        geoms = [model.geom(index).name for index in range(model.ngeom)]
        self._object = _begins(names, "object/")
        self._wall, self._furniture = _begins(names, "wall/"), _begins(names, "furniture/")
        # Geoms with a name are arms and hands: who takes something reaches for what holds it.
        self._person = _begins(names, "person/") & ~_begins(geoms, "person/")

    def touching(self, data: mujoco.MjData) -> set[tuple[int, int]]:
        """Bodies of the robot, or of what it holds, and the geoms that they should not touch."""
        contact = data.contact
        geoms = contact.geom[contact.dist < 0.0]
        if not len(geoms):
            return set()
        pairs = np.concatenate([geoms, geoms[:, ::-1]])
        ours, theirs = pairs.T
        # A hand may touch what it takes things from.
        furniture = self._furniture[theirs] & ~self._hand[ours]
        bad = self._robot[ours] & (self._wall[theirs] | self._person[theirs] | furniture)
        held = np.unique(theirs[self._hand[ours] & self._object[theirs]])
        carried = np.isin(ours, held) & (self._wall[theirs] | self._person[theirs])
        bodies = self._model.geom_bodyid
        return {(int(bodies[a]), int(b)) for a, b in pairs[bad | carried]}

    def words(self, body: int, geom: int) -> str:
        """What touched what."""
        theirs = self._model.body(self._model.geom_bodyid[geom]).name
        return f"{self._model.body(body).name} touched {theirs}"


def _begins(names: list[str], with_: str) -> npt.NDArray[np.bool_]:
    return np.array([name.startswith(with_) for name in names])


def _below(model: mujoco.MjModel, root: int) -> set[int]:
    """A body and all that hang from it."""
    found = {root}
    for body in range(root + 1, model.nbody):
        if int(model.body_parentid[body]) in found:
            found.add(body)
    return found
