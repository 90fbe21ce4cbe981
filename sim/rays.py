"""Bundles of rays from one point through a simulation, with MuJoCo's own ray caster: no GL."""

from __future__ import annotations

import mujoco
import numpy as np
from numpy.typing import NDArray

from robot.se3 import Array

GROUPS = np.array([1, 1, 1, 0, 0, 0], dtype=np.uint8)  # what is visible; 3 and up is hidden
STATIC = True  # hit what cannot move, too


class Rays:
    """Casts rays; `body` (of the sensor itself) is looked through."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, *, body: int) -> None:
        """Cast in one simulation, its positions as they are."""
        self._model, self._data, self.body = model, data, body
        self._geom_body = model.geom_bodyid

    def cast(
        self, origin: Array, directions: Array, *, range_m: float
    ) -> tuple[Array, NDArray[np.int32]]:
        """Distances [m] along unit directions, shape (n, 3) in the world, and the geoms hit.

        A miss is -1 in both, and so is anything beyond `range_m`.
        """
        count = len(directions)
        geoms = np.empty(count, dtype=np.int32)
        distances = np.empty(count)
        mujoco.mj_multiRay(
            self._model, self._data, origin, directions.reshape(-1), GROUPS, STATIC, self.body,
            geoms, distances, None, count, range_m,
        )  # fmt: skip
        beyond = distances > range_m
        distances[beyond], geoms[beyond] = -1.0, -1
        return distances, geoms

    def bodies_hit(self, origin: Array, vectors: Array) -> NDArray[np.int32]:
        """The body that each ray meets first, -1 for none; vectors of any length, shape (n, 3)."""
        lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
        _, geoms = self.cast(origin, vectors / lengths, range_m=1e3)
        return np.where(geoms >= 0, self._geom_body[geoms], -1)
