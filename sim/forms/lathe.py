"""Solids of revolution: a profile turned about the z axis."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from robot.se3 import Array
from sim.forms.mesh import Faces, Mesh, Wrap

ON_AXIS_M = 1e-9
SEGMENTS = 32
"""Around; the chord of a mug of 8 cm is then 0.2 mm off the circle."""

Profile = Sequence[tuple[float, float]]
"""Radius and height of each point [m], upwards along what is outside."""


def lathe(profile: Profile, *, segments: int = SEGMENTS) -> Mesh:
    """A solid with this outline: from the axis to the axis, or a ring that closes in itself."""
    return _turned(np.asarray(profile, dtype=np.float64), segments)


def band(
    outside: Profile, *, low_m: float, high_m: float, thick_m: float, segments: int = SEGMENTS
) -> Mesh:
    """A label around a part of an outline, with a picture wrapped around it once.

    Args:
        outside: what it is around.
        low_m: from where it goes,
        high_m: and to where.
        thick_m: by how much it stands out; it reaches as far into what it is around.
        segments: around.
    """
    outline: Array = np.asarray(outside, dtype=np.float64)
    radii, heights = outline[:, 0], outline[:, 1]
    between = [z for z in heights.tolist() if low_m + 1e-4 < z < high_m - 1e-4]
    levels: Array = np.array([low_m, *between, high_m])
    around: Array = np.interp(levels, heights, radii)
    outer = np.column_stack([around + thick_m, levels])
    inner = np.column_stack([np.maximum(around - thick_m, 1e-4), levels])[::-1]
    mesh = _turned(np.concatenate([outer, inner, outer[:1]]), segments)
    rows = len(outer) + len(inner)
    v = np.concatenate([(high_m - levels) / (high_m - low_m)] * 2)
    v[len(outer) :] = v[len(outer) :][::-1]
    v = np.append(v, v[0])
    u = np.arange(segments + 1) / segments
    uv = np.stack(np.meshgrid(u, v, indexing="xy"), axis=-1).reshape(-1, 2)
    uv_faces = _quads(rows + 1, segments + 1, wrap=False)
    return Mesh(mesh.points, mesh.faces, Wrap(uv, uv_faces))


def _turned(profile: Array, segments: int) -> Mesh:
    """The surface that an outline sweeps."""
    angles = 2.0 * np.pi * np.arange(segments) / segments
    circle = np.column_stack([np.cos(angles), np.sin(angles)])
    closes = bool(np.allclose(profile[0], profile[-1])) and profile[0, 0] > ON_AXIS_M
    rings = profile[:-1] if closes else profile
    at = circle[None] * rings[:, None, :1]
    points = np.concatenate([at, np.broadcast_to(rings[:, None, 1:], (*at.shape[:2], 1))], axis=-1)
    faces = _quads(len(profile), segments, wrap=True) % (len(rings) * segments)
    return _without_doubles(Mesh(points.reshape(-1, 3), faces.astype(np.int32)))


def _quads(rows: int, columns: int, *, wrap: bool) -> Faces:
    """Two triangles for each cell between rows of points, the last column next to the first."""
    row, column = np.meshgrid(
        np.arange(rows - 1), np.arange(columns if wrap else columns - 1), indexing="ij"
    )
    row, column = row.ravel(), column.ravel()
    right = (column + 1) % columns
    a, b = row * columns + column, row * columns + right
    c, d = (row + 1) * columns + right, (row + 1) * columns + column
    both = np.stack([np.column_stack([a, b, c]), np.column_stack([a, c, d])], axis=1)
    return both.reshape(-1, 3).astype(np.int32)


def _without_doubles(mesh: Mesh) -> Mesh:
    """Points on the axis are one each, and faces without an area are none."""
    keys = np.round(mesh.points, 9) + 0.0
    _, first, same = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    faces = same.reshape(-1)[mesh.faces]
    whole = (
        (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])
    )
    return Mesh(mesh.points[first], faces[whole].astype(np.int32))
