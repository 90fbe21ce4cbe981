"""Places that were seen before: where a key frame lies with respect to much older ones.

Where to look follows from how unsure the way between two key frames is. A small window is
aligned at once; a large one is searched whole, and what is found there counts only when several
key frames along the way say the same.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from robot.fusion.slam.agreement import contradicted
from robot.fusion.slam.matching import TIGHT_GATES_M, match
from robot.fusion.slam.patch import Patch
from robot.fusion.slam.planar import between, placed
from robot.fusion.slam.pose_graph import PoseGraph
from robot.fusion.slam.raster import Raster, search_points
from robot.fusion.slam.scan import Scan
from robot.se3 import Array

AROUND = 10
AROUND_M = 4.0
"""Key frames before and after an old one that it is matched together with: at most so many, and
along so much of the way."""
NEAR_M = 2.5
NEAR_SHARE = 0.5
FARTHEST_M = 6.0
FACING_RAD = np.radians(75.0)
"""A key frame seen from nearer and less turned than this saw the same walls."""
OLD_M = 6.0
"""Key frames nearer along the way than this are the front end's work."""
TARGETS = 3
APART_M = 5.0
"""Two targets of one key frame are farther from each other than this along the way."""
TURN_M = 0.5
"""A turn of 1 rad blurs as a way of this length."""
HEADING_DRIFT = np.radians(1.0) ** 2 / 10.0
WAY_DRIFT = 0.03**2 / 1.0
LEVER = 0.22
"""Variances of the front end's drift a metre, and the arm of its heading: the mean distance of a
circle's points to one of them, as a part of its length."""
SIGMAS = 2.5
LARGEST_M = 16.0
LARGEST_RAD = np.radians(40.0)
AT_ONCE_M = 0.25
AT_ONCE_RAD = np.radians(6.0)
ALONE_M = 2.0
"""A window larger than this needs confirmation."""
SCORE = 0.5
FIT = 0.45
FAR_FIT = 0.6
CONTRADICTED = 0.15
LENGTH_M = 0.3
"""As how long a way a loop counts."""
STIFFNESS = 300.0
"""Least eigenvalue of a match's information [1/m²]: less leaves a direction open."""
FINE, COARSE = (0.1, 4, 2.2), (0.2, 5, LARGEST_M + 0.2)
"""Side of a cell [m], coarser levels, and largest reach [m] of the rasters of patches."""
KEPT = 32
"""Patches and rasters that are kept at hand."""
STEP_RAD = np.radians(1.5)


@dataclass(frozen=True, eq=False)
class Loop:
    """Key frame `end` found at `measured` in the frame of the older key frame `begin`."""

    begin: int
    end: int
    measured: Array
    information: Array
    fit: float
    window_m: float


class Places:
    """Old key frames as pieces of the map, made when they are asked for."""

    def __init__(self, scans: Sequence[Scan]) -> None:
        self._scans = scans
        self._kept: OrderedDict[tuple[int, float], Patch | Raster] = OrderedDict()

    def patch(self, center: int, poses: Array) -> Patch:
        """The key frames around one, in its frame."""
        kept = self._kept.get((center, 0.0))
        if not isinstance(kept, Patch):
            around = self._around(center, poses)
            kept = Patch.of(
                [self._scans[k] for k in around],
                [between(poses[center], poses[k]) for k in around],
            )
        self._keep((center, 0.0), kept)
        return kept

    def raster(self, center: int, poses: Array, reach_m: float) -> Raster:
        """Their raster, coarser for a large window."""
        cell_m, levels, most_m = FINE if reach_m <= FINE[2] else COARSE
        kept = self._kept.get((center, cell_m))
        if not isinstance(kept, Raster):
            points = self.patch(center, poses).filled(cell_m)
            kept = Raster(points, levels=levels, reach_m=most_m, cell_m=cell_m)
        self._keep((center, cell_m), kept)
        return kept

    def _keep(self, key: tuple[int, float], made: Patch | Raster) -> None:
        self._kept[key] = made
        self._kept.move_to_end(key)
        if len(self._kept) > KEPT:
            self._kept.popitem(last=False)

    def forget(self) -> None:
        """Make them anew: the poses were changed."""
        self._kept.clear()

    def _around(self, center: int, poses: Array) -> range:
        low, high = max(0, center - AROUND), min(len(poses), center + AROUND + 1)
        steps = np.hypot(*np.diff(poses[low:high, :2], axis=0).T)
        way = np.concatenate([[0.0], np.cumsum(steps)])
        near = np.flatnonzero(np.abs(way - way[center - low]) <= AROUND_M)
        return range(low + int(near[0]), low + int(near[-1]) + 1)


def unsureness(graph: PoseGraph, current: int, way_m: Array) -> tuple[Array, Array]:
    """1 sigma of place [m] and heading [rad] of every key frame as seen from one.

    Along the shortest way through the graph: an upper bound, since every other way only adds to
    what is known.

    Args:
        graph: what is known of the key frames.
        current: the one that looks.
        way_m: of every key frame from the first one.
    """
    length = graph.way_from(current, len(way_m))
    heading = HEADING_DRIFT * length
    arm = LEVER * np.minimum(length, np.abs(way_m - way_m[current]))
    return np.sqrt(WAY_DRIFT * length + heading * arm**2), np.sqrt(heading)


def length_of(step: Array, blind: Array) -> float:
    """As how long a way a step between two key frames counts [m].

    Args:
        step: x, y, heading.
        blind: variances of what odometry alone tells of it.
    """
    way = float(np.hypot(step[0], step[1])) + TURN_M * abs(float(step[2])) + 1e-3
    return way + max(float(blind[2]) / HEADING_DRIFT, float(blind[0]) / WAY_DRIFT)


def along(poses: Array) -> Array:
    """The way of every key frame from the first one [m]; a turn counts, too."""
    steps = between(poses[:-1], poses[1:])
    lengths = np.hypot(steps[:, 0], steps[:, 1]) + TURN_M * np.abs(steps[:, 2])
    return np.concatenate([[0.0], np.cumsum(lengths)])


def targets(
    poses: Array, current: int, place_m: Array, *, sight_m: float, way_m: Array
) -> list[int]:
    """Older key frames that may have seen what this one sees, the likeliest first.

    Args:
        poses: of all key frames, as believed.
        current: the key frame.
        place_m: 1 sigma of the place of every key frame with respect to it.
        sight_m: how far the current scan sees, as a rule: two poses from which one sees far have
            much in common even where they are not near each other.
        way_m: of every key frame from the first one.
    """
    old = np.flatnonzero(way_m[: current + 1] < way_m[current] - OLD_M)
    apart = between(poses[current], poses[old])
    distance = np.hypot(apart[:, 0], apart[:, 1])
    near_m = np.clip(NEAR_SHARE * sight_m, NEAR_M, FARTHEST_M)
    reach = near_m + np.minimum(SIGMAS * place_m[old], LARGEST_M)
    possible = np.flatnonzero((distance < reach) & (np.abs(apart[:, 2]) < FACING_RAD))
    cost = distance + 2.0 * np.abs(apart[:, 2])
    chosen: list[int] = []
    for k in old[possible[np.argsort(cost[possible], kind="stable")]]:
        if all(abs(way_m[k] - way_m[other]) > APART_M for other in chosen):
            chosen.append(int(k))
            if len(chosen) == TARGETS:
                break
    return chosen


def close(
    places: Places,
    scan: Scan,
    poses: Array,
    *,
    begin: int,
    end: int,
    place_m: float,
    heading_rad: float,
) -> Loop | None:
    """Find key frame `end`, whose scan this is, around the older `begin`; None if it is not seen.

    Args:
        places: the old key frames.
        scan: of the newer key frame.
        poses: of all key frames, as believed.
        begin: the older key frame.
        end: the newer one.
        place_m: 1 sigma of their relative place.
        heading_rad: 1 sigma of their relative heading.
    """
    expected = between(poses[begin], poses[end])
    patch = places.patch(begin, poses)
    window_m = min(SIGMAS * place_m, LARGEST_M)
    window_rad = min(SIGMAS * heading_rad, LARGEST_RAD)
    start, gates = expected, TIGHT_GATES_M
    if window_m > AT_ONCE_M or window_rad > AT_ONCE_RAD:
        reach_m = window_m + 0.1
        raster = places.raster(begin, poses, reach_m)
        found = raster.search(
            search_points(scan.points),
            expected,
            reach_m=reach_m,
            reach_rad=window_rad + np.radians(2.0),
            step_rad=STEP_RAD if raster.cell_m == FINE[0] else 1.5 * STEP_RAD,
            least=SCORE,
        )
        if found is None or not found.complete:
            return None
        start, gates = found.pose, (0.5, 0.4, 0.25, 0.15)
    matched = match(patch, scan.points, scan.normals, start, gates_m=gates)
    if (
        matched.fit < (FAR_FIT if window_m > ALONE_M else FIT)
        or np.linalg.eigvalsh(matched.information)[0] < STIFFNESS
    ):
        return None
    if contradicted(patch, placed(matched.pose, scan.points)) > CONTRADICTED:
        return None
    return Loop(begin, end, matched.pose, matched.information, matched.fit, window_m)
