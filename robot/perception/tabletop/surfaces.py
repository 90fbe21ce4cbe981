"""Level surfaces in a depth image: table tops, worktops, boards of shelves, the floor."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from robot.perception.tabletop.cloud import Cloud
from robot.perception.tabletop.filters import cross, hull, least_squares, regions, smooth
from robot.se3 import Array

BIN_M = 0.005
"""Of heights; surfaces are looked for where many points have one."""
BLUR_BINS = 2.0
LEAST_PX = 100
"""Fewer points are no surface."""
CLEAR = 1.6
"""By how much a height has to stand out from those 4 cm above and below."""
BAND_M = 0.012
SIGMAS = 3.0
"""Within so much of a height (or so many sigma of the noise) a point may belong to it."""
TRIES = 60
"""Of RANSAC; with half of the points right, three are right in one of eight tries."""
TILT_COS = math.cos(math.radians(4.0))
"""A surface is level; so far the robot's own idea of it may be off."""
INLIERS = 0.6
ENOUGH = 1000
"""Points of a region that RANSAC looks at."""
ALONG_PX, LEVEL_SHARE = 3, 0.5
"""Over so many rows of the picture a level surface changes its height by less than such a share of
what a wall does."""


class Surface(NamedTuple):
    """A level surface.

    Attributes:
        plane: n and d, with n . p + d the height of a point above it [m], shape (4,).
        edge: half planes of its outline in x and y [m], shape (k, 3): a x + b y + c <= 0 inside.
        pixels: which show it, shape (height, width).
    """

    plane: Array
    edge: Array
    pixels: NDArray[np.bool_]

    def above(self, p_W: Array) -> Array:
        """How high points are above it [m]; points of shape (..., 3)."""
        return p_W @ self.plane[:3] + self.plane[3]

    def holds(self, p_W: Array, *, margin_m: float) -> NDArray[np.bool_]:
        """Whether points are over it, or past its edge by less than a margin."""
        outside = p_W[..., :2] @ self.edge[:, :2].T + self.edge[:, 2]
        return np.all(outside <= margin_m, axis=-1)


def surfaces(cloud: Cloud, *, rng: np.random.Generator) -> list[Surface]:
    """Every level surface that is seen from above, the largest in the picture first."""
    found: list[Surface] = []
    free = cloud.is_there.copy()
    below_eye = free & (cloud.p_W[..., 2] < cloud.eye_W[2]) & _level(cloud)
    for height_m in _heights(cloud.p_W[below_eye][:, 2]):
        band_m = np.maximum(BAND_M, SIGMAS * cloud.noise_m)
        near = below_eye & free & (np.abs(cloud.p_W[..., 2] - height_m) < band_m)
        labels, count = regions(near)
        sizes = np.bincount(labels.ravel(), minlength=count + 1)
        for label in np.flatnonzero(sizes[1:] >= LEAST_PX) + 1:
            surface = _fit(cloud, labels == label, rng)
            if surface is not None:
                found.append(surface)
                free &= ~surface.pixels
    return sorted(found, key=lambda one: -int(one.pixels.sum()))


def _level(cloud: Cloud) -> NDArray[np.bool_]:
    """Where the height stays as it is some pixels further up or down the picture.

    On a wall it changes by the size of these pixels; on a level surface only its noise shows.
    """
    height_m, rows = cloud.p_W[..., 2], cloud.p_W.shape[0]
    is_level = np.zeros(height_m.shape, dtype=np.bool_)
    upper, lower = slice(0, rows - ALONG_PX), slice(ALONG_PX, rows)
    both = cloud.is_there[upper] & cloud.is_there[lower]
    on_wall_m = ALONG_PX * cloud.depth_m[lower] / cloud.focal_px
    alike = both & (np.abs(height_m[upper] - height_m[lower]) < LEVEL_SHARE * on_wall_m)
    is_level[upper] |= alike
    is_level[lower] |= alike
    return is_level


def _heights(heights_m: Array) -> list[float]:
    """Heights that many points have, the most frequent first."""
    if len(heights_m) < LEAST_PX:
        return []
    low = float(heights_m.min())
    bins = ((heights_m - low) / BIN_M).astype(np.int64)
    counts = smooth(np.bincount(bins).astype(np.float64), BLUR_BINS)
    padded = np.pad(counts, 8)
    around = np.maximum(padded[:-16], padded[16:])
    peak = (counts >= padded[7:-9]) & (counts > padded[9:-7])
    stands_out = peak & (counts > CLEAR * around) & (counts * 5.0 * BLUR_BINS > LEAST_PX / 2)
    order = np.flatnonzero(stands_out)
    return [low + (float(k) + 0.5) * BIN_M for k in order[np.argsort(-counts[order])]]


def _fit(cloud: Cloud, pixels: NDArray[np.bool_], rng: np.random.Generator) -> Surface | None:
    """The plane through a region, by RANSAC and then least squares; None if it is no level one."""
    points, noise_m = cloud.p_W[pixels], cloud.noise_m[pixels]
    close_m = np.maximum(0.006, 2.0 * noise_m)
    some = rng.choice(len(points), min(ENOUGH, len(points)), replace=False)
    plane, share = _consensus(points[some], close_m[some], rng)
    if share < INLIERS:
        return None
    inliers = np.abs(points @ plane[:3] + plane[3]) < close_m
    if inliers.sum() < LEAST_PX:
        return None
    plane = _least_squares(points[inliers], noise_m[inliers])
    if plane[2] < TILT_COS:
        return None
    kept = np.zeros_like(pixels)
    kept[pixels] = np.abs(points @ plane[:3] + plane[3]) < close_m
    return Surface(plane, hull(points[inliers][:, :2]), kept)


def _consensus(points: Array, close_m: Array, rng: np.random.Generator) -> tuple[Array, float]:
    """The level plane that most points are close to, and how many of them (RANSAC, 1981)."""
    best, most = np.zeros(4), 0.0
    for _ in range(TRIES):
        three = points[rng.choice(len(points), 3, replace=False)]
        normal = cross(three[1] - three[0], three[2] - three[0])
        length = float(np.linalg.norm(normal))
        if length < 1e-6 or abs(normal[2]) < TILT_COS * length:
            continue
        normal *= math.copysign(1.0 / length, normal[2])
        away_m: Array = np.abs((points - three[0]) @ normal)
        share = float(np.mean(away_m < close_m))
        if share > most:
            best, most = np.append(normal, -normal @ three[0]), share
    return best, most


def _least_squares(points: Array, noise_m: Array) -> Array:
    """Z = a x + b y + c, weighted by noise, as a plane whose normal points up."""
    middle = points.mean(axis=0)
    weight = 1.0 / np.maximum(noise_m, 1e-3)
    system = np.column_stack([points[:, :2] - middle[:2], np.ones(len(points))])
    solution = least_squares(system * weight[:, None], (points[:, 2] - middle[2]) * weight)
    normal = np.array([-solution[0], -solution[1], 1.0])
    normal /= np.linalg.norm(normal)
    return np.append(normal, -normal @ (middle + np.array([0.0, 0.0, solution[2]])))
