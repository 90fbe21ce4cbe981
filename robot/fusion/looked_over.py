"""What of the surfaces has been seen well, and when: the other half of not having seen a thing.

A surface that nobody has looked over says nothing about what stands on it. So a point of it counts
as seen only where a small thing there would have been plain to see: in the picture, near enough,
not at a grazing angle, with nothing before it. Walls, racks, people and the robot's own arms need
no model of their own for that: the depth image has them.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from robot.messages import DepthImage, Looked, Place
from robot.se3 import SE3, Array, Vector3

WELL_M = 2.2
"""From further away things are noticed, but that there is nothing is not said [m]."""
GRAZING_RAD = 0.04
"""Least angle at which eyes look down on a surface, unless they are level with what is on it."""
ABOVE_M = 0.04
"""Half the height of a small thing: that far above the surface it must be in plain view [m]."""
STANDING_M = 0.07
"""What is nearer than the point by less stands on it: radius of a mug, noise and all [m]."""
DOUBT_M = 0.2
"""Around what nobody has made out, a surface is not seen: samples are 0.25 m apart, so that it
stands by one at least [m]."""
DOUBT_ABOVE_M = 0.3
"""Middles of things are no higher above what they stand on [m]."""
SURELY_M, ENOUGH, TOGETHER_S = 1.2, 1.9, 10.0
"""Eyes that find things themselves find 99 % of what has 300 pixels in a look, 72 % of what has 40
(docs/perception.md): a look from so near counts fully, from further away as its pixels are fewer,
and so many are enough that are no further apart in time. A box on a table that a walking robot
passed in 1.9 m was in one picture, was not found in it, and not looked for there again."""
EDGE_PX = 1
"""The head still moves when a picture is taken: the outermost pixels are not believed."""


class LookedOver:
    """The surfaces of the map, with the time at which every sample of them was last seen well."""

    def __init__(self, *, several: bool = False) -> None:
        """Know no surface.

        Args:
            several: whether a thing may be missed in one look, so that it takes some.
        """
        self._several = several
        self._map: tuple[Place, ...] = ()
        self._places: list[tuple[str, slice]] = []
        self._points_W: Array = np.zeros((0, 3))
        self._seen_s: Array = np.zeros(0)
        self._looks, self._last_s = np.zeros(0), np.zeros(0)

    def know(self, places: tuple[Place, ...]) -> None:
        """Take the surfaces of a map; what was seen of those known by the same id is kept."""
        if places == self._map:
            return
        self._map = places
        before = {looked.place_id: looked.seen_s for looked in self.looked()}
        self._places, points, seen = [], [np.zeros((0, 3))], [np.zeros(0)]
        count = 0
        for place in places:
            if place.floor:
                continue
            samples = place.samples()
            known = before.get(place.id, ())
            kept = known if len(known) == len(samples) else (-math.inf,) * len(samples)
            self._places.append((place.id, slice(count, count + len(samples))))
            points.append(samples)
            seen.append(np.array(kept))
            count += len(samples)
        self._points_W, self._seen_s = np.concatenate(points), np.concatenate(seen)
        self._looks, self._last_s = np.zeros(count), np.full(count, -math.inf)

    def see(self, image: DepthImage, X_WC: SE3, *, doubts_W: Sequence[Vector3] = ()) -> None:
        """Take one depth image.

        Args:
            image: the image.
            X_WC: where the camera was.
            doubts_W: where something stands that may be anything still [m].
        """
        for doubt in doubts_W:
            self._seen_s[_by(self._points_W, doubt)] = -math.inf
        eye = np.array(X_WC.p)
        near = np.flatnonzero(np.linalg.norm(self._points_W - eye, axis=1) < WELL_M)
        if not len(near):
            return
        points_W = self._points_W[near]
        off = eye - points_W
        slope = np.arcsin(np.clip(off[:, 2] / np.linalg.norm(off, axis=1), -1.0, 1.0))
        well = (off[:, 2] < ABOVE_M) | (slope > GRAZING_RAD)
        well &= _in_plain_view(image, X_WC, points_W + np.array([0.0, 0.0, ABOVE_M]))
        for doubt in doubts_W:
            well &= ~_by(points_W, doubt)
        seen = near[well]
        if self._several:
            seen = seen[self._enough(seen, np.linalg.norm(off[well], axis=1), image.stamp_s)]
        self._seen_s[seen] = image.stamp_s

    def _enough(self, rows: NDArray[np.intp], ranges_m: Array, now_s: float) -> NDArray[np.bool_]:
        """Which points have been looked at enough, with one more look from so far away."""
        self._looks[rows[now_s - self._last_s[rows] > TOGETHER_S]] = 0.0
        self._looks[rows] += np.minimum(1.0, (SURELY_M / ranges_m) ** 2)
        self._last_s[rows] = now_s
        return self._looks[rows] >= ENOUGH

    def looked(self) -> tuple[Looked, ...]:
        """Every surface, in the order of the map."""
        return tuple(
            Looked(place_id=place_id, seen_s=tuple(self._seen_s[rows].tolist()))
            for place_id, rows in self._places
        )


def _by(points_W: Array, p_W: Vector3) -> NDArray[np.bool_]:
    """Which points of surfaces, shape (n, 3), are where a thing stands, shape (n,)."""
    off = np.array(p_W) - points_W
    beside = np.hypot(off[:, 0], off[:, 1]) < DOUBT_M
    return beside & (off[:, 2] > 0.0) & (off[:, 2] < DOUBT_ABOVE_M)


def _in_plain_view(image: DepthImage, X_WC: SE3, points_W: Array) -> Array:
    """Which points, shape (n, 3), are in the picture with nothing before them, shape (n,)."""
    X_CW = X_WC.inverse()
    x, y, z = (points_W @ X_CW.rotation().T + np.array(X_CW.p)).T
    ahead = z > 1e-3
    focal_px = 0.5 * image.height / math.tan(0.5 * image.fovy_rad)
    scale = focal_px / np.where(ahead, z, 1.0)
    column = np.floor(0.5 * image.width + scale * x).astype(int)
    row = np.floor(0.5 * image.height + scale * y).astype(int)
    inside = ahead & (column >= EDGE_PX) & (column < image.width - EDGE_PX)
    inside &= (row >= EDGE_PX) & (row < image.height - EDGE_PX)
    view = np.zeros(len(points_W), dtype=bool)
    depth = image.pixels()[row[inside], column[inside]]
    view[inside] = (depth <= 0.0) | (depth > z[inside] - STANDING_M)
    return view
