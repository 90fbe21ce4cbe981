"""Tells people who look on how everything truly is, ten times a second: `robot.reality.trail`."""

from __future__ import annotations

from pathlib import Path
from typing import cast

import numpy as np

from robot.closing import Closing
from robot.reality.trail import Flat, TrailFile, Truth
from sim.plant import Plant

PERIOD_S, REST_S = 0.1, 1.0
"""Between two looks, and between two lines of a world in which nothing moves."""
MOVED = 0.002
"""What a coordinate [m], or a part of a quaternion, changes by without being news."""


class Trail(Closing):
    """What one plant does from now on, into a file."""

    def __init__(self, plant: Plant, path: Path) -> None:
        """Begin; the file is made with the first line."""
        self._plant = plant
        kinds = ("object", "person")
        self._names: list[tuple[str, str]] = []
        bodies = [int(plant.model.body(plant.robot.base_body).id)]
        for number in range(plant.model.nbody):
            kind, _, id = plant.model.body(number).name.partition("/")
            if kind in kinds and id and "/" not in id:
                self._names.append((kind, id))
                bodies.append(number)
        self._bodies = np.array(bodies)
        self._before = np.full((len(bodies), 7), np.inf)
        self._next_s = self._due_s = -np.inf
        self._file = TrailFile(path)

    def look(self) -> None:
        """After every step of the plant: tell what is new."""
        now_s = self._plant.time_s
        if now_s < self._next_s:
            return
        self._next_s = now_s + PERIOD_S
        data = self._plant.data
        poses = np.hstack([data.xpos[self._bodies], data.xquat[self._bodies]])
        moved = np.abs(poses - self._before).max(axis=1) > MOVED
        if not moved.any() and now_s < self._due_s:
            return
        self._due_s = now_s + REST_S
        self._before[moved] = poses[moved]
        found: dict[str, dict[str, Flat]] = {"object": {}, "person": {}}
        for place in np.flatnonzero(moved[1:]):
            kind, id = self._names[place]
            found[kind][id] = _flat(poses[place + 1])
        self._file.put(
            Truth(
                t_s=round(now_s, 3), base=_flat(poses[0]), objects=found["object"],
                people=found["person"],
            )
        )  # fmt: skip

    def close(self) -> None:
        """Write what is left."""
        self._file.close()


def _flat(pose: np.ndarray) -> Flat:
    return cast("Flat", tuple(round(float(one), 4) for one in pose))
