"""Where a thing in a picture is, and how large: from its points, and from what the namer says.

Near by the points are the better witness, from afar the namer. What stands on no surface that is
known is nothing that a robot could take: walls, chair legs, people.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from robot.messages import Place
from robot.perception.sight.form import roundness
from robot.perception.things.eyes import SeenThing
from robot.perception.things.inputs import Sight
from robot.se3 import Array

NOISE_PER_M = 0.002
"""1 sigma of depth at a metre; it grows with the square."""
LIKE_MIDDLE_M = 0.25
"""Depths further from the middle one are of something else."""
OVER_EDGE_M = 0.04
SUNK_M, HIDDEN_M = 0.03, 0.12
"""How far the lowest point of a thing may be below, and above, what it stands on: noise, and
something before it."""
TILT_RAD = 0.015
"""So far wrong a robot that sways may hold its camera's tilt to be: what is further away is sunk by
more. A cup at 1.5 m was 3.2 cm below the top of its table, and was nothing."""
CLEAR_M, CLEAR_SIGMAS = 0.008, 2.0
"""What is lower above the surface is the surface."""
TRIM, TRIM_SIGMAS = 0.02, 1.6
"""Of the points on each side, when an extent is measured; and by how much noise widens it there."""
LEAST_PX = 20
OF_DEPTH = 0.12
"""1 sigma of the half that is not seen, over a thing's depth."""
AGREE_SIGMAS = 3.5
"""Points and namer that are further apart: the one is taken that is surer at that range."""
NEAR_M = 1.3
ONE_FACE = 0.35
"""So thin a rectangle is one face of a thing, of which neither top nor another face is seen."""
TURNS = np.radians(np.arange(0.0, 90.0, 3.0))
ABOVE_PX, GOES_ON, SAME_DEPTH_M, STEEP = 3, 0.5, 0.006, 2.0
"""So far above the top of what was found nothing of the thing is left, where it was found whole: in
most columns depth steps back there, by more than noise and than it did in the rows below."""
PIECE_M = 0.08
"""1 sigma of what is left of a thing of which a piece was found."""
PARTLY = 0.12
"""Of the outline of what is seen: where so much borders on what is nearer, the rest is hidden."""


class Measured(NamedTuple):
    """A thing of one picture in the world.

    Attributes:
        seen: as it was seen.
        p_W, covariance_W: of its middle [m], [m²].
        size_m: its sides as it is turned (`yaw_rad`), and its height.
        width_m: across the line of sight: of what is round the best known size.
        size_sigma_m: of each of them.
        yaw_rad: about the vertical, of the smallest rectangle around it.
        foot_m: height of what it stands on.
        is_whole: whether nothing hides a part of it, and it was found whole.
        roundness: how much likelier it is round than a box, in logarithms.
        is_at_hand: whether it may be a piece of what a hand holds.
    """

    seen: SeenThing
    p_W: Array
    covariance_W: Array
    size_m: tuple[float, float, float]
    width_m: float
    size_sigma_m: float
    yaw_rad: float
    foot_m: float
    is_whole: bool
    roundness: float = 0.0
    is_at_hand: bool = False


def measured(
    view: Sight, thing: SeenThing, places: Sequence[Place], *, hidden: NDArray[np.bool_]
) -> Measured | None:
    """Place and size of a thing; None if it stands on nothing that is known, or is cut off.

    Args:
        view: the picture.
        thing: in it.
        places: surfaces of the map; the floor is one besides.
        hidden: pixels of the robot itself.
    """
    pixels = thing.pixels
    if is_cut_off(pixels):
        return None
    points, depths = _points_W(view, pixels)
    if len(points) < LEAST_PX:
        return None
    depth_m = float(np.median(depths))
    foot_m = _foot_m(points, places, sunk_m=SUNK_M + TILT_RAD * depth_m)
    if foot_m is None:
        return None
    noise_m = NOISE_PER_M * depth_m * depth_m
    above = points[points[:, 2] - foot_m > max(CLEAR_M, CLEAR_SIGMAS * noise_m)]
    if len(above) < LEAST_PX:
        return None
    goes_on = _goes_on(view, pixels, noise_m) > GOES_ON
    is_whole = not goes_on and _outline_hidden(view, pixels, hidden, depth_m) < PARTLY
    pixel_m = depth_m / view.focal_px
    top_m = float(np.quantile(above[:, 2], 1.0 - TRIM)) - foot_m
    p_W, covariance_W, width_m, deep_m = _from_points(
        above, view, noise_m=noise_m, pixel_m=pixel_m, foot_m=foot_m, top_m=top_m
    )
    p_W, covariance_W, counts = _with_namer(p_W, covariance_W, thing)
    along_m, across_m, high_m = width_m, deep_m, top_m
    yaw_rad = 0.0
    if depth_m < NEAR_M:
        yaw_rad, along_m, across_m = _rectangle(above, width_m, deep_m, noise_m)
    long_m, short_m, tall_m = thing.size_m
    share = counts if depth_m > NEAR_M else 0.5 * counts
    middle_m = (long_m + short_m) / 2
    along_m += share * (middle_m - along_m)
    across_m += share * (middle_m - across_m)
    high_m += share * (tall_m - high_m)
    width_m += share * (middle_m - width_m)
    if not is_whole:
        covariance_W = covariance_W + np.eye(3) * 0.02**2
    sigma_m = pixel_m + noise_m + (0.0 if is_whole else 0.02)
    if goes_on:
        covariance_W = covariance_W + np.diag([0.0, 0.0, PIECE_M**2])
        sigma_m += PIECE_M
    form = roundness(above, np.array(view.X_WC.p[:2]), noise_m=noise_m) if is_whole else 0.0
    return Measured(
        thing, p_W, covariance_W, (along_m, across_m, high_m), width_m, sigma_m, yaw_rad, foot_m,
        is_whole, form,
    )  # fmt: skip


def is_cut_off(pixels: NDArray[np.bool_]) -> bool:
    """Whether something goes on beyond the border of the picture."""
    ends = (pixels[0], pixels[-1], pixels[:, 0], pixels[:, -1])
    return any(bool(end.any()) for end in ends)


def _points_W(view: Sight, pixels: NDArray[np.bool_]) -> tuple[Array, Array]:
    """Points of a thing in the world, shape (n, 3), and their depths."""
    rows, columns = np.nonzero(pixels & (view.depth_m > 0.0))
    depths = view.depth_m[rows, columns].astype(np.float64)
    if not len(depths):
        return np.zeros((0, 3)), depths
    near = np.abs(depths - np.median(depths)) < LIKE_MIDDLE_M
    rows, columns, depths = rows[near], columns[near], depths[near]
    cx, cy = view.centre_px
    p_C = np.column_stack(
        [(columns - cx) / view.focal_px * depths, (rows - cy) / view.focal_px * depths, depths]
    )
    points: Array = p_C @ view.X_WC.rotation().T + np.array(view.X_WC.p)
    return points, depths


def _foot_m(points: Array, places: Sequence[Place], *, sunk_m: float) -> float | None:
    """The height of the highest surface that points stand on; None if they stand on none.

    Args:
        points: in W [m], shape (n, 3).
        places: surfaces of the map.
        sunk_m: how far the lowest of them may be below it.
    """
    low_m = float(np.quantile(points[:, 2], 0.04))
    middle = (float(np.median(points[:, 0])), float(np.median(points[:, 1])), 0.0)
    heights = [0.0]
    for place in places:
        if place.floor:
            continue
        x, y, _ = place.X_WP.inverse().apply(middle)
        half_x, half_y = 0.5 * place.size_m[0], 0.5 * place.size_m[1]
        if abs(x) <= half_x + OVER_EDGE_M and abs(y) <= half_y + OVER_EDGE_M:
            heights.append(place.X_WP.p[2])
    fits = [height for height in heights if -sunk_m < low_m - height < HIDDEN_M]
    return max(fits, default=None)


def _from_points(
    points: Array, view: Sight, *, noise_m: float, pixel_m: float, foot_m: float, top_m: float
) -> tuple[Array, Array, float, float]:
    """Middle, its covariance, width across the line of sight and depth along it."""
    middle, eye = points[:, :2].mean(axis=0), np.array(view.X_WC.p[:2])
    sight = middle - eye
    sight /= max(float(np.linalg.norm(sight)), 1e-9)
    across = np.array([-sight[1], sight[0]])
    left, right = np.quantile(points[:, :2] @ across, (TRIM, 1.0 - TRIM)).tolist()
    near, far = np.quantile(points[:, :2] @ sight, (TRIM, 1.0 - TRIM)).tolist()
    near, far = near + TRIM_SIGMAS * noise_m, far - TRIM_SIGMAS * noise_m
    width_m = (right - left) / (1.0 - 2.0 * TRIM) + pixel_m / 2
    deep_m = max(far - near, width_m)
    xy = (near + deep_m / 2) * sight + (left + right) / 2 * across
    p_W = np.array([xy[0], xy[1], foot_m + top_m / 2])
    basis = np.column_stack([np.append(sight, 0.0), np.append(across, 0.0), [0.0, 0.0, 1.0]])
    share = noise_m / math.sqrt(max(1.0, len(points) / 10)) + 0.001
    spread = np.array([OF_DEPTH * deep_m + share, pixel_m / 2 + share, pixel_m / 2 + share])
    return p_W, basis @ np.diag(spread**2) @ basis.T, width_m, deep_m


def _with_namer(p_W: Array, covariance_W: Array, thing: SeenThing) -> tuple[Array, Array, float]:
    """Both witnesses of a place together, and how much the namer counted, 0 to 1."""
    off = thing.p_W - p_W
    both = covariance_W + thing.covariance_W
    sigmas = math.sqrt(max(0.0, float(off @ np.linalg.solve(both, off))))
    trace, other = float(np.trace(covariance_W)), float(np.trace(thing.covariance_W))
    if sigmas > AGREE_SIGMAS:
        if thing.range_m < NEAR_M or trace < other:
            return p_W, covariance_W * 4.0, 0.0
        return thing.p_W, thing.covariance_W * 4.0, 1.0
    gain = covariance_W @ np.linalg.inv(both)
    return p_W + gain @ off, (np.eye(3) - gain) @ covariance_W, trace / (trace + other)


def _rectangle(
    points: Array, width_m: float, deep_m: float, noise_m: float
) -> tuple[float, float, float]:
    """The smallest rectangle around points from above: its turn, and its two sides.

    Where the far side is not seen the sides are those that the line of sight gives.
    """
    xy = points[:, :2] - points[:, :2].mean(axis=0)
    u = xy[:, :1] * np.cos(TURNS) + xy[:, 1:] * np.sin(TURNS)
    v = -xy[:, :1] * np.sin(TURNS) + xy[:, 1:] * np.cos(TURNS)
    span_u = np.diff(np.quantile(u, (TRIM, 1.0 - TRIM), axis=0), axis=0)[0] - TRIM_SIGMAS * noise_m
    span_v = np.diff(np.quantile(v, (TRIM, 1.0 - TRIM), axis=0), axis=0)[0] - TRIM_SIGMAS * noise_m
    best = int(np.argmin(span_u * span_v))
    along_m, across_m = (float(span[best]) / (1.0 - 2.0 * TRIM) for span in (span_u, span_v))
    if min(along_m, across_m) < ONE_FACE * min(width_m, deep_m):
        return float(TURNS[best]), width_m, deep_m
    return float(TURNS[best]), along_m, across_m


def _outline_hidden(
    view: Sight, pixels: NDArray[np.bool_], hidden: NDArray[np.bool_], depth_m: float
) -> float:
    """Share of a thing's outline at which something nearer begins, the robot itself among it."""
    grown = pixels.copy()
    grown[1:] |= pixels[:-1]
    grown[:-1] |= pixels[1:]
    grown[:, 1:] |= pixels[:, :-1]
    grown[:, :-1] |= pixels[:, 1:]
    rim = grown & ~pixels
    nearer = (view.depth_m > 0.0) & (view.depth_m < depth_m - 0.06)
    return float((hidden | nearer)[rim].mean()) if rim.any() else 0.0


def _goes_on(view: Sight, pixels: NDArray[np.bool_], noise_m: float) -> float:
    """Share of the columns of a thing in which it goes on above what was found of it.

    From very near only a piece of a large thing may be found, which is no smaller thing.
    """
    columns = np.flatnonzero(pixels.any(axis=0))
    tops = pixels[:, columns].argmax(axis=0)
    fits = (tops >= ABOVE_PX) & (tops + ABOVE_PX < pixels.shape[0])
    columns, tops = columns[fits], tops[fits]
    if not len(columns):
        return 0.0
    above = view.depth_m[tops - ABOVE_PX, columns]
    there = view.depth_m[tops, columns]
    below = view.depth_m[tops + ABOVE_PX, columns]
    known = (above > 0.0) & (there > 0.0) & (below > 0.0)
    step_m = STEEP * np.abs(there - below) + SAME_DEPTH_M + STEEP * noise_m
    return float((known & (np.abs(above - there) < step_m)).mean())
