"""What stands on a surface: clusters of points above it, each with place and size and how sure."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from robot.perception.tabletop.cloud import Cloud
from robot.perception.tabletop.filters import linked
from robot.perception.tabletop.surfaces import Surface, surfaces
from robot.se3 import Array

LOWEST_M, HIGHEST_M = 0.008, 0.45
"""A thing's points are between these heights above the surface; noise raises the lower one."""
SIGMAS = 3.0
OVER_EDGE_M = 0.03
"""How far a thing may stick out over the surface's edge."""
STEP_M, STEP_SIGMAS = 0.02, 4.0
"""Neighbours whose depths differ by more belong to two things; noise grows with the square."""
REACH_PX = 2
"""Neighbours are so far apart at most: holes come in patches."""
LEAST_PX = 25
STANDS_M = 0.05
"""What begins higher above a surface does not stand on it."""
WIDEST_M, LEAST_HEIGHT_M = 0.5, 0.012
TRIM, TRIM_SIGMAS = 0.02, 1.6
"""Of the points on each side, when an extent is measured; and by how much noise widens it there."""
CUT_M = 0.03
"""What reaches so near the greatest height goes on above: a leg, a wall, somebody."""
OF_DEPTH = 0.12
"""1 sigma of the half that is not seen, over a thing's depth."""


class Thing(NamedTuple):
    """Something that stands on a surface.

    Attributes:
        p_W: its middle [m], shape (3,).
        covariance_W: of that [m²], shape (3, 3).
        width_m, depth_m, height_m: across the line of sight, along it, and up.
        pixels: which show it, shape (height, width).
    """

    p_W: Array
    covariance_W: Array
    width_m: float
    depth_m: float
    height_m: float
    pixels: NDArray[np.bool_]


def things(cloud: Cloud, *, rng: np.random.Generator) -> list[Thing]:
    """What stands on the level surfaces of one picture, the nearest first."""
    found: list[Thing] = []
    taken = np.zeros(cloud.depth_m.shape, dtype=np.bool_)
    levels = surfaces(cloud, rng=rng)
    flat = np.any([level.pixels for level in levels], axis=0) if levels else taken
    for surface in levels:
        for pixels in _clusters(cloud, surface, cloud.is_there & ~flat & ~taken):
            thing = _measured(cloud, surface, pixels)
            if thing is not None:
                found.append(thing)
                taken |= pixels
    return sorted(found, key=lambda one: float(np.linalg.norm(one.p_W - cloud.eye_W)))


def _clusters(cloud: Cloud, surface: Surface, free: NDArray[np.bool_]) -> list[NDArray[np.bool_]]:
    """Pixels above a surface that hang together."""
    above_m = surface.above(cloud.p_W)
    lowest_m = np.maximum(LOWEST_M, SIGMAS * cloud.noise_m)
    over = free & (above_m > lowest_m) & (above_m < HIGHEST_M)
    over &= surface.holds(cloud.p_W, margin_m=OVER_EDGE_M)
    count = int(over.sum())
    if count < LEAST_PX:
        return []
    number = np.full(over.shape, -1, dtype=np.int64)
    number[over] = np.arange(count)
    labels = linked(count, _pairs(cloud, number))
    picture = np.full(over.shape, -1, dtype=np.int32)
    picture[over] = labels
    large = np.flatnonzero(np.bincount(labels) >= LEAST_PX)
    return [picture == label for label in large]


def _pairs(cloud: Cloud, number: NDArray[np.int64]) -> NDArray[np.int64]:
    """Neighbouring pixels at about one depth, as pairs of their numbers, shape (n, 2)."""
    rows, columns = number.shape
    found: list[NDArray[np.int64]] = []
    for down in range(REACH_PX + 1):
        for right in range(-REACH_PX, REACH_PX + 1):
            if down == 0 and right <= 0:
                continue
            left, end = max(0, -right), columns - max(0, right)
            here = slice(0, rows - down), slice(left, end)
            there = slice(down, rows), slice(left + right, end + right)
            step_m = np.abs(cloud.depth_m[here] - cloud.depth_m[there])
            most_m = STEP_M + STEP_SIGMAS * cloud.noise_m[here]
            alike = (number[here] >= 0) & (number[there] >= 0) & (step_m < most_m)
            found.append(np.column_stack([number[here][alike], number[there][alike]]))
    return np.concatenate(found)


def _measured(cloud: Cloud, surface: Surface, pixels: NDArray[np.bool_]) -> Thing | None:
    """Place and size of a cluster; None if it is none that stands there, or not all of it is seen.

    Only the side towards the camera is seen. Where the top is seen as well its far edge is, and the
    depth is measured; otherwise a thing is taken to be as deep as it is wide.
    """
    if pixels[0].any() or pixels[-1].any() or pixels[:, 0].any() or pixels[:, -1].any():
        return None
    points, noise_m = cloud.p_W[pixels], float(np.median(cloud.noise_m[pixels]))
    above_m = surface.above(points)
    bottom_m, top_m = np.quantile(above_m, (TRIM, 1.0 - TRIM)).tolist()
    middle = points[:, :2].mean(axis=0)
    sight = middle - cloud.eye_W[:2]
    range_m = float(np.linalg.norm(sight))
    sight /= max(range_m, 1e-9)
    across = np.array([-sight[1], sight[0]])
    left, right = np.quantile(points[:, :2] @ across, (TRIM, 1.0 - TRIM)).tolist()
    near, far = np.quantile(points[:, :2] @ sight, (TRIM, 1.0 - TRIM)).tolist()
    near, far = near + TRIM_SIGMAS * noise_m, far - TRIM_SIGMAS * noise_m
    pixel_m = float(np.median(cloud.depth_m[pixels])) / cloud.focal_px
    width_m = right - left + pixel_m
    if not LEAST_HEIGHT_M < top_m < HIGHEST_M - CUT_M:
        return None
    if bottom_m > STANDS_M or max(width_m, far - near) > WIDEST_M:
        return None
    depth_m = max(far - near, width_m)
    along = near + depth_m / 2
    xy = along * sight + (left + right) / 2 * across
    floor_m = float(surface.above(np.array([xy[0], xy[1], 0.0])))
    p_W = np.array([xy[0], xy[1], top_m / 2 - floor_m])
    basis = np.column_stack([np.append(sight, 0.0), np.append(across, 0.0), [0.0, 0.0, 1.0]])
    share = noise_m / np.sqrt(max(1.0, pixels.sum() / 10))
    spread = np.array([OF_DEPTH * depth_m + share, pixel_m / 2 + share, pixel_m / 2 + share])
    covariance = basis @ np.diag(spread**2) @ basis.T
    return Thing(p_W, covariance, width_m, depth_m, top_m, pixels)
