"""Bundles of rays from one point through a simulation, with MuJoCo's own ray caster: no GL."""

from __future__ import annotations

import math
from collections.abc import Generator
from contextlib import contextmanager

import mujoco
import numpy as np
from numpy.typing import NDArray

from robot.se3 import Array

GROUPS = np.array([1, 1, 1, 0, 0, 0], dtype=np.uint8)  # what is sensed, see UNSENSED
UNSENSED = 4
"""Geoms of this group are drawn and not sensed: Juno's wrists, which stand in its lidar's plane.

They were added to look at; what it senses, and so every run, is to stay as it was.
"""
SEEN = np.array([1, 1, 1, 0, 1, 0], dtype=np.uint8)
"""Groups of what is to be looked at."""
HIDDEN = 5  # a group that no ray meets
STATIC = True  # hit what cannot move, too


class Rays:
    """Casts rays; `body` (of the sensor itself) is looked through."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, *, body: int) -> None:
        """Cast in one simulation, its positions as they are."""
        self._model, self._data, self.body = model, data, body
        self._geom_body = model.geom_bodyid
        self._geom_group = model.geom_group
        self._geom_position = data.geom_xpos
        unbounded = model.geom_type == mujoco.mjtGeom.mjGEOM_PLANE
        self._geom_radius: Array = np.where(unbounded, np.inf, model.geom_rbound)

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

    @contextmanager
    def only_within(
        self, origin: Array, axis: Array, *, half_angle_rad: float, range_m: float
    ) -> Generator[None]:
        """Let rays inside a cone not be tried against what lies outside it; hits are the same.

        MuJoCo itself tries every ray against what is close to its origin: most of the robot. A
        geom counts as outside if the sphere around it is.

        Args:
            origin: of the cone and of the rays [m], shape (3,).
            axis: of the cone, a unit vector, shape (3,).
            half_angle_rad: between the axis and the outermost ray, under a right angle.
            range_m: of the rays.
        """
        offset = self._geom_position - origin
        along = offset @ axis
        distance = np.sqrt(np.einsum("ij,ij->i", offset, offset))
        across = np.sqrt(np.maximum(distance * distance - along * along, 0.0))
        beside = across * math.cos(half_angle_rad) - along * math.sin(half_angle_rad)
        outside = (beside > self._geom_radius) | (distance - self._geom_radius > range_m)
        groups = self._geom_group.copy()
        self._geom_group[outside] = HIDDEN
        try:
            yield
        finally:
            self._geom_group[:] = groups

    def bodies_hit(self, origin: Array, vectors: Array) -> NDArray[np.int32]:
        """The body that each ray meets first, -1 for none; vectors of any length, shape (n, 3)."""
        lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
        _, geoms = self.cast(origin, vectors / lengths, range_m=1e3)
        return np.where(geoms >= 0, self._geom_body[geoms], -1)
