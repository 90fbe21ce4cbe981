"""A closed surface of triangles, and what a body of that form weighs.

Faces run counter-clockwise as seen from outside. Lengths are in metres.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from robot.se3 import Array

Faces = NDArray[np.int32]


class Wrap(NamedTuple):
    """How a picture lies on a mesh.

    Attributes:
        uv: places in the picture, (0, 0) its upper left corner, shape (k, 2).
        faces: three of those for each face, shape (m, 3).
    """

    uv: Array
    faces: Faces


@dataclass(frozen=True)
class Mesh:
    """Triangles.

    Attributes:
        points: corners [m], shape (n, 3).
        faces: three corners each, shape (m, 3).
        wrap: how a picture lies on it; None: none does.
    """

    points: Array
    faces: Faces
    wrap: Wrap | None = None

    def is_watertight(self) -> bool:
        """Whether every edge is shared by two faces that run along it in opposite directions."""
        edges = np.concatenate(
            [self.faces[:, [0, 1]], self.faces[:, [1, 2]], self.faces[:, [2, 0]]]
        )
        ways = {(int(a), int(b)) for a, b in edges}
        return len(ways) == len(edges) and all((b, a) in ways for a, b in ways)

    @property
    def bounds(self) -> tuple[Array, Array]:
        """The least and the greatest coordinates [m], shape (3,) each."""
        return self.points.min(axis=0), self.points.max(axis=0)

    def moved(self, p: Sequence[float] | Array) -> Mesh:
        """The same elsewhere."""
        return replace(self, points=self.points + np.asarray(p, dtype=np.float64))

    def turned(self, R: Array) -> Mesh:
        """The same turned by a rotation, shape (3, 3)."""
        return replace(self, points=self.points @ R.T)

    def matter(self, density_kg_m3: float) -> Matter:
        """Mass, middle and inertia of what is inside.

        Sums over the tetrahedra between each face and the origin (Tonon, J. Math. Stat. 1, 2005).
        """
        a, b, c = (self.points[self.faces[:, k]] for k in range(3))
        volumes = np.einsum("ij,ij->i", a, np.cross(b, c)) / 6.0
        volume = float(volumes.sum())
        total = a + b + c
        first = volumes @ total / 4.0
        squares = sum(np.einsum("i,ij,ik->jk", volumes, one, one) for one in (a, b, c, total))
        second: Array = np.asarray(squares) / 20.0
        return Matter(volume * density_kg_m3, first * density_kg_m3, second * density_kg_m3)

    def creased(self, *, crease_rad: float = 0.7) -> Mesh:
        """The same, with corners doubled where faces meet at an angle of more than `crease_rad`.

        Who draws it smooth over what shares corners, draws edges as edges then.
        """
        a, b, c = (self.points[self.faces[:, k]] for k in range(3))
        areas = np.cross(b - a, c - a)
        flat = areas / np.maximum(np.linalg.norm(areas, axis=1, keepdims=True), 1e-18)
        corners = self.faces.ravel()
        order = np.argsort(corners, kind="stable")
        starts = np.searchsorted(corners[order], corners)
        counts = np.bincount(corners, minlength=len(self.points))[corners]
        one = np.repeat(np.arange(len(corners)), counts)  # every pair of corners at one point
        place = np.arange(len(one)) - np.repeat(np.cumsum(counts) - counts, counts)
        other = order[starts[one] + place]
        alike = np.einsum("ij,ij->i", flat[one // 3], flat[other // 3]) > math.cos(crease_rad)
        # Corners at a point that have the same faces beside them stay one: a sum tells sets apart.
        marks = np.random.default_rng(0).integers(2**63, size=len(corners), dtype=np.uint64)
        sums = np.zeros(len(corners), dtype=np.uint64)
        np.add.at(sums, one[alike], marks[other[alike]])
        keys = np.column_stack([corners.astype(np.uint64), sums])
        _, first, same = np.unique(keys, axis=0, return_index=True, return_inverse=True)
        faces = same.reshape(-1, 3).astype(np.int32)
        return replace(self, points=self.points[corners[first]], faces=faces)

    @property
    def volume_m3(self) -> float:
        """Of what is inside."""
        return self.matter(1.0).mass_kg


class Matter(NamedTuple):
    """Moments of a mass about the origin; they add up, and what is hollow is taken away.

    Attributes:
        mass_kg: the zeroth.
        first: the first [kg m], shape (3,).
        second: the second, the integral of p p^T [kg m²], shape (3, 3).
    """

    mass_kg: float
    first: Array
    second: Array

    def with_(self, other: Matter) -> Matter:
        """Both together."""
        return Matter(
            self.mass_kg + other.mass_kg, self.first + other.first, self.second + other.second
        )

    def times(self, share: float) -> Matter:
        """So many times as much of it."""
        return Matter(share * self.mass_kg, share * self.first, share * self.second)

    @property
    def middle(self) -> Array:
        """Centre of mass [m], shape (3,)."""
        return self.first / self.mass_kg

    @property
    def inertia(self) -> Array:
        """About the centre of mass [kg m²], shape (3, 3)."""
        spread = self.second - np.outer(self.middle, self.middle) * self.mass_kg
        return np.trace(spread) * np.eye(3) - spread


NOTHING = Matter(0.0, np.zeros(3), np.zeros((3, 3)))


def joined(meshes: Sequence[Mesh]) -> Mesh:
    """Several, none of which has a picture on it, as one; they may overlap."""
    starts = np.cumsum([0, *(len(mesh.points) for mesh in meshes[:-1])])
    points = np.concatenate([mesh.points for mesh in meshes])
    faces = [mesh.faces + start for mesh, start in zip(meshes, starts, strict=True)]
    return Mesh(points, np.concatenate(faces).astype(np.int32))
