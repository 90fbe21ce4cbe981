"""Surfaces through rings of points: lofts, tubes along a way, extruded outlines."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from robot.se3 import Array
from sim.forms.mesh import Faces, Mesh, Wrap

ROUND = 10
"""Corners of a tube."""


def loft(rings: Sequence[Array]) -> Mesh:
    """A solid through rings of as many points each, shape (k, 3), counter-clockwise from its end.

    The ends are closed; their rings must be seen whole from their middles (convex ones are).
    """
    count, width = len(rings), len(rings[0])
    points = np.concatenate([*rings, [rings[0].mean(axis=0)], [rings[-1].mean(axis=0)]])
    faces: list[tuple[int, int, int]] = []
    for k in range(width):
        after = (k + 1) % width
        for row in range(count - 1):
            a, b = row * width + k, row * width + after
            c, d = a + width, b + width
            faces += [(a, b, d), (a, d, c)]
        faces.append((count * width, after, k))
        faces.append((count * width + 1, (count - 1) * width + k, (count - 1) * width + after))
    return Mesh(points, np.array(faces, dtype=np.int32))


def tube(
    way: Sequence[Sequence[float]] | Array, radii: Sequence[float], *, corners: int = ROUND
) -> Mesh:
    """A round rod along a way of points [m], shape (n, 3), of these radii there."""
    points = np.asarray(way, dtype=np.float64)
    ahead = np.gradient(points, axis=0)
    ahead /= np.linalg.norm(ahead, axis=1, keepdims=True)
    side = np.cross(ahead[0], np.eye(3)[int(np.argmin(np.abs(ahead[0])))])
    angles = 2.0 * np.pi * np.arange(corners) / corners
    rings: list[Array] = []
    for p, t, radius in zip(points, ahead, radii, strict=True):
        side = side - (side @ t) * t  # carried along without a twist
        side /= np.linalg.norm(side)
        across = np.cross(t, side)
        rings.append(
            p + radius * (np.outer(np.cos(angles), side) + np.outer(np.sin(angles), across))
        )
    return loft(rings)


def prism(
    outline: Sequence[Sequence[float]] | Array,
    low_m: float,
    high_m: float,
    *,
    narrowed: float = 1.0,
) -> Mesh:
    """An upright prism over a counter-clockwise outline, shape (k, 2), which may have bays.

    `narrowed` is the size of the upper end in that of the lower.
    """
    flat = np.asarray(outline, dtype=np.float64)
    count = len(flat)
    lower = np.column_stack([flat, np.full(count, low_m)])
    upper = np.column_stack([narrowed * flat, np.full(count, high_m)])
    caps = triangles(flat)
    k = np.arange(count)
    after = (k + 1) % count
    sides = np.concatenate(
        [
            np.column_stack([k, after, after + count]),
            np.column_stack([k, after + count, k + count]),
        ]
    )
    faces = np.concatenate([sides, caps[:, ::-1], caps + count])
    return Mesh(np.concatenate([lower, upper]), faces.astype(np.int32))


def wrapped(outline: Sequence[Sequence[float]] | Array, low_m: float, high_m: float) -> Mesh:
    """A prism over a convex outline with a picture wrapped around it once; its ends show a corner.

    The picture begins at the first point of the outline, and goes from the upper end to the lower.
    """
    flat = np.asarray(outline, dtype=np.float64)
    mesh, count = prism(flat, low_m, high_m), len(flat)
    lengths = np.linalg.norm(np.roll(flat, -1, axis=0) - flat, axis=1)
    along = np.concatenate([[0.0], np.cumsum(lengths)]) / lengths.sum()
    below, above = (
        np.column_stack([along, np.ones(count + 1)]),
        np.column_stack([along, np.zeros(count + 1)]),
    )
    uv = np.concatenate([below, above, [[0.002, 0.002]]])
    k = np.arange(count)
    top = count + 1
    sides = np.concatenate(
        [np.column_stack([k, k + 1, k + 1 + top]), np.column_stack([k, k + 1 + top, k + top])]
    )
    ends = np.full((len(mesh.faces) - len(sides), 3), 2 * top)
    uv_faces = np.concatenate([sides, ends]).astype(np.int32)
    return Mesh(mesh.points, mesh.faces, Wrap(uv, uv_faces))


def rounded(depth_m: float, width_m: float, radius_m: float, *, corners: int = 4) -> Array:
    """A rectangle about the origin with round corners, counter-clockwise, shape (k, 2)."""
    radius = min(radius_m, 0.499 * depth_m, 0.499 * width_m)
    middle = np.array([0.5 * depth_m - radius, 0.5 * width_m - radius])
    found: list[Array] = []
    for quarter, sign in enumerate(([1, 1], [-1, 1], [-1, -1], [1, -1])):
        turn = 0.5 * np.pi * (quarter + np.linspace(0.0, 1.0, corners))
        found.append(middle * sign + radius * np.column_stack([np.cos(turn), np.sin(turn)]))
    return np.concatenate(found)


def triangles(outline: Array) -> Faces:
    """Triangles that fill a counter-clockwise outline without holes: one ear after another."""
    left = list(range(len(outline)))
    found: list[tuple[int, int, int]] = []
    while len(left) > 3:
        at = next((k for k in range(len(left)) if _is_ear(outline, left, k)), 0)
        found.append((left[at - 1], left[at], left[(at + 1) % len(left)]))
        del left[at]
    return np.array([*found, left], dtype=np.int32)


def _is_ear(outline: Array, left: list[int], at: int) -> bool:
    """Whether the corner can be cut off: it sticks out, and no other corner is in it."""
    a, b, c = left[at - 1], left[at], left[(at + 1) % len(left)]
    if _turn(outline[a], outline[b], outline[c]) <= 1e-15:
        return False
    return not any(
        _turn(outline[a], outline[b], outline[p]) >= 0.0
        and _turn(outline[b], outline[c], outline[p]) >= 0.0
        and _turn(outline[c], outline[a], outline[p]) >= 0.0
        for p in left
        if p not in (a, b, c)
    )


def _turn(a: Array, b: Array, c: Array) -> float:
    """Twice the area of a triangle, positive if it runs counter-clockwise."""
    return float((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
