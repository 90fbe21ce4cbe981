"""One sweep of a planar lidar as points with the directions of the surfaces they lie on."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from robot.fusion.slam.numerics import Mask
from robot.se3 import Array

NEAREST_M = 0.05
"""Closer returns are the housing of the lidar or the value zero, which means none."""
GAP_M = 0.3
GAP_SHARE = 0.12
"""Neighbouring beams lie on one surface if their ranges differ by less than this: at 1 degree a
wall under 8 degrees makes 12 % of the range."""
NARROW_M = 0.6
"""What stands alone and is narrower than this may be a person: two legs are 0.5 m wide."""


@dataclass(frozen=True, eq=False)
class Scan:
    """Points in the lidar's frame.

    Attributes:
        points: (n, 2) [m], in the order of the beams.
        normals: (n, 2), unit vectors across the surface; zero where there is none.
        spans_m: (n,), how much of the surface a point stands for, to either side: half of what lies
            between its neighbours' middles.
        beams: the angle of the first beam and the step to the next [rad].
        seen_m: (beams,) how far each beam went without hitting anything; 0 where that is unknown.
    """

    points: Array
    normals: Array
    spans_m: Array
    beams: tuple[float, float]
    seen_m: Array


def scan_of(
    ranges_m: Array, angle_min_rad: float, angle_step_rad: float, *, range_max_m: float
) -> Scan:
    """A scan of ranges; what is no number, too near or beyond `range_max_m` is no return.

    Small clusters in front of everything around them are left out (people, legs of chairs that
    are moved): SLAM does without them at no cost, and is led astray by those that walk along.
    """
    returned = np.isfinite(ranges_m) & (ranges_m > NEAREST_M) & (ranges_m < range_max_m)
    ranges = np.where(returned, ranges_m, 0.0)
    angles = angle_min_rad + angle_step_rad * np.arange(len(ranges_m))
    points = ranges[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])
    joined = _joined(ranges, returned)
    kept = returned & ~_standing_alone(points, ranges, returned, joined)
    if np.count_nonzero(kept) < 0.5 * np.count_nonzero(returned):
        kept = returned
    normals, spans_m = _surfaces(points, joined)
    return Scan(
        points=points[kept],
        normals=normals[kept],
        spans_m=spans_m[kept],
        beams=(angle_min_rad, angle_step_rad),
        seen_m=ranges,
    )


def _joined(ranges: Array, returned: Mask) -> Mask:
    """Whether a beam and the next lie on one surface, (beams - 1,)."""
    near = np.minimum(ranges[:-1], ranges[1:])
    step = np.abs(np.diff(ranges))
    return returned[:-1] & returned[1:] & (step < np.maximum(GAP_M, GAP_SHARE * near))


def _surfaces(points: Array, joined: Mask) -> tuple[Array, Array]:
    """Normals, across the line through both neighbours or the one there is, and spans."""
    size = len(points)
    index = np.arange(size)
    before = np.concatenate([[False], joined])
    after = np.concatenate([joined, [False]])
    along = points[np.where(after, index + 1, index)] - points[np.where(before, index - 1, index)]
    sides = before.astype(float) + after
    spans_m = np.hypot(along[:, 0], along[:, 1]) / np.maximum(2.0 * sides, 1.0)
    # A line through points 3 cm apart is noise: take the next but one where there are such.
    wide_before = before & np.concatenate([[False], before[:-1]])
    wide_after = after & np.concatenate([after[1:], [False]])
    wide = wide_before & wide_after & (np.hypot(along[:, 0], along[:, 1]) < 0.15)
    wider = points[np.minimum(index + 2, size - 1)] - points[np.maximum(index - 2, 0)]
    along = np.where(wide[:, None], wider, along)
    length = np.hypot(along[:, 0], along[:, 1])
    across = np.column_stack([-along[:, 1], along[:, 0]])
    normals = np.where(length[:, None] > 1e-6, across / np.maximum(length, 1e-6)[:, None], 0.0)
    return normals, spans_m


def _standing_alone(points: Array, ranges: Array, returned: Mask, joined: Mask) -> Mask:
    """Which points belong to a narrow cluster with what lies farther on both sides of it."""
    size = len(ranges)
    begins = np.flatnonzero(np.concatenate([[True], ~joined]))
    ends = np.concatenate([begins[1:], [size]]) - 1
    width = np.hypot(*(points[ends] - points[begins]).T)
    far = np.where(returned, ranges, np.inf)
    left = np.where(begins > 0, far[begins - 1], 0.0)
    right = np.where(ends < size - 1, far[np.minimum(ends + 1, size - 1)], 0.0)
    alone = (width < NARROW_M) & (left > far[begins] + GAP_M) & (right > far[ends] + GAP_M)
    return np.repeat(alone, ends - begins + 1)
