"""Figures in a depth image: what the map does not explain and is formed like somebody, or not.

Clusters over the floor are judged by height and by head and shoulders, as Munaro and Menegatti do
(2014, "Fast RGB-D people tracking for service robots"). Sizes are those of adults, 5th percentile
of women to 95th of men (DIN 33402-2: stature 1.54 to 1.86 m, shoulders 0.40 to 0.52 m), with room
for shoes, hair, coats and the pixels' own size.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from robot.perception.company.segments import segments
from robot.perception.company.view import DepthView
from robot.se3 import Array

Posture = Literal["stands", "sits", "lies"]
LEAST_PX = 6
HEAD_M, SHOULDERS_M = 0.24, (0.30, 0.60)
"""Below the top: how far down the head reaches, and between what the shoulders are."""
HEAD_WIDE_M, WIDE_M = 0.34, (0.26, 0.72)
NARROWER_M = 0.10
"""By how much a head is narrower than shoulders; a box, a door, a shelf is not."""
STANDS_M, TALLEST_M, SITS_M, LOW_M = 1.40, 2.10, 0.98, 0.50
TRUNK_M, CHEST_M = 1.15, (0.85, 1.30)
"""Who is seen without a head reaches up to the one at least, and is a trunk between others."""
BROAD_M = 1.0
LIES_LONG_M, LIES_WIDE_M = (1.05, 2.15), (0.2, 0.85)
WITHIN_M = 0.11
"""From the surface that is seen to the middle of a trunk."""
BEHIND_M = 0.12
RAISED_GAP_M = 0.09
"""Between a head and a hand beside it."""
CLEARLY, SITTING, LYING, MAYBE, HARDLY = 2.5, 1.2, 1.5, 0.7, -1.5
"""Evidence of one look [nats]; what stands on a low cabinet is as high as the head of who sits."""
NOISE_PER_M2 = 0.004


class Figure(NamedTuple):
    """A cluster that stands out from the map.

    Attributes:
        p_W: its middle on the floor [m], shape (2,).
        covariance: of that, shape (2, 2).
        top_m: the highest point that is seen of it.
        evidence: log-odds of one look that it is somebody.
        posture: how they are, if it is somebody.
        raises_hand: whether a hand is beside or above the head.
        colour: red, green, blue of the trunk, 0 to 255; None: not seen.
    """

    p_W: Array
    covariance: Array
    top_m: float
    evidence: float
    posture: Posture
    raises_hand: bool
    colour: Array | None = None


def figures(view: DepthView, strange: NDArray[np.bool_]) -> list[Figure]:
    """What there is in a view.

    Args:
        view: of the depth camera.
        strange: the pixels that neither map nor robot explain.
    """
    found: list[Figure] = []
    for pixels in segments(view, strange):
        if len(pixels) >= LEAST_PX:
            found.append(_figure(view, pixels))
    return found


class _Cluster(NamedTuple):
    """Points of a cluster: across the line of sight from its middle, away from it, and up."""

    across: Array
    away: Array
    up: Array
    pitch_m: float
    is_cut_above: bool
    is_cut_aside: bool
    is_cut_below: bool

    def width_m(self, low_m: float, high_m: float) -> float:
        """Across, between two heights; 0 where nothing is seen."""
        inside = self.across[(self.up >= low_m) & (self.up <= high_m)]
        return float(np.ptp(inside)) + self.pitch_m if len(inside) else 0.0


def _figure(view: DepthView, pixels: NDArray[np.intp]) -> Figure:
    rows, columns = pixels.T
    points = view.points_W[rows, columns]
    eye = view.eye_W
    middle = np.median(points[:, :2], axis=0)
    range_m = max(float(np.linalg.norm(middle - eye[:2])), 0.1)
    towards = (middle - eye[:2]) / range_m
    off = points[:, :2] - middle
    pitch_m = range_m / view.focal_px
    cluster = _Cluster(
        across=off @ np.array([-towards[1], towards[0]]),
        away=off @ towards,
        up=points[:, 2],
        pitch_m=pitch_m,
        is_cut_above=_is_cut_above(view, rows, columns),
        is_cut_aside=bool(columns.min() == 0 or columns.max() == view.depth_m.shape[1] - 1),
        is_cut_below=bool(rows.max() == view.depth_m.shape[0] - 1),
    )
    top_m = float(np.percentile(points[:, 2], 99)) + 0.5 * pitch_m
    evidence, posture, raises = _judged(cluster, top_m)
    trunk = (points[:, 2] < top_m - HEAD_M) & (points[:, 2] > top_m - 0.9)
    trunk = trunk if posture != "lies" and trunk.sum() >= LEAST_PX else np.ones(len(points), bool)
    at = np.median(points[trunk, :2], axis=0)
    at = at if posture == "lies" else at + WITHIN_M * towards
    along_m, aside_m = 0.06 + NOISE_PER_M2 * range_m**2, 0.04 + 0.4 * pitch_m
    axes = np.column_stack((towards, (-towards[1], towards[0])))
    covariance = axes @ np.diag([along_m**2, aside_m**2]) @ axes.T
    colour = None
    if view.colours is not None:
        colour = np.median(view.colours[rows, columns][trunk], axis=0)
    return Figure(at, covariance, top_m, evidence, posture, raises, colour)


def _is_cut_above(view: DepthView, rows: NDArray[np.intp], columns: NDArray[np.intp]) -> bool:
    """Whether it may go on above what is seen: its end is seen where what is behind it is."""
    if rows.min() == 0:
        return True
    first = rows == rows.min()
    above = view.depth_m[rows[first] - 1, columns[first]]
    own = view.depth_m[rows[first], columns[first]]
    return bool((above > own + BEHIND_M).mean() < 0.5)


def _judged(cluster: _Cluster, top_m: float) -> tuple[float, Posture, bool]:
    """Evidence of a look, posture, and whether a hand is raised."""
    if cluster.is_cut_above:
        return _judged_by_trunk(cluster, top_m), "stands", False
    if top_m < LOW_M:
        return _judged_lying(cluster), "lies", False
    posture: Posture = "stands" if top_m >= STANDS_M else "sits"
    if not SITS_M <= top_m <= TALLEST_M:
        return HARDLY, posture, False
    spare_m = 1.5 * cluster.pitch_m
    shoulders_m = cluster.width_m(top_m - SHOULDERS_M[1], top_m - SHOULDERS_M[0])
    head_m, raises = _head(cluster, top_m)
    if cluster.is_cut_aside:
        return (MAYBE if shoulders_m < BROAD_M else HARDLY), posture, False
    fits = WIDE_M[0] - spare_m <= shoulders_m <= WIDE_M[1] + spare_m
    if not fits or head_m > HEAD_WIDE_M + spare_m:
        return HARDLY, posture, False
    if shoulders_m - head_m >= NARROWER_M - 0.5 * spare_m:
        return (CLEARLY if posture == "stands" else SITTING), posture, raises
    return 0.0, posture, False


def _head(cluster: _Cluster, top_m: float) -> tuple[float, bool]:
    """How wide the head is, and whether there is a hand beside it, or above."""
    inside = np.sort(cluster.across[cluster.up >= top_m - HEAD_M])
    gaps = np.flatnonzero(np.diff(inside) > max(RAISED_GAP_M, 1.5 * cluster.pitch_m))
    parts: Sequence[Array] = np.split(inside, gaps + 1)
    head = min(parts, key=lambda part: abs(float(part.mean())))
    return float(np.ptp(head)) + cluster.pitch_m, len(parts) == 2


def _judged_by_trunk(cluster: _Cluster, top_m: float) -> float:
    """Of who is seen without a head."""
    broad_m = cluster.width_m(0.0, top_m)
    if broad_m > BROAD_M + 2.0 * cluster.pitch_m:
        return HARDLY
    chest_m = cluster.width_m(*CHEST_M)
    spare_m = 1.5 * cluster.pitch_m
    is_trunk = top_m >= TRUNK_M and WIDE_M[0] - spare_m <= chest_m <= WIDE_M[1] + spare_m
    return MAYBE if is_trunk and not cluster.is_cut_aside else 0.0


def _judged_lying(cluster: _Cluster) -> float:
    """Of what is low: as long and as wide as somebody who lies, and no board."""
    if cluster.is_cut_aside or cluster.is_cut_below:
        return 0.0  # a part of somebody is formed like anything
    flat = np.column_stack((cluster.across, cluster.away))
    flat = flat - flat.mean(axis=0)
    _, _, axes = np.linalg.svd(flat, full_matrices=False)
    long_m, wide_m = (float(np.ptp(flat @ axis)) + cluster.pitch_m for axis in axes)
    is_long = LIES_LONG_M[0] <= long_m <= LIES_LONG_M[1]
    is_wide = LIES_WIDE_M[0] <= wide_m <= LIES_WIDE_M[1]
    return LYING if is_long and is_wide else 0.0
