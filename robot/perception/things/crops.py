"""A thing cut out of a picture, as the namer takes it: as large as it is, from its foot up.

The window grows with the thing. Depth and height are in metres from its own middle and foot, so
that the namer knows sizes; what it says of places is in the same frame: along the line of sight,
across, and up.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from robot.perception.things.inputs import Floats, Sight, point_W
from robot.se3 import Array

SIDE_PX = 48
CHANNELS, NUMBERS = 7, 9
UNIT_M = 0.1
"""Of depths and heights in a crop."""
DEPTHS, HEIGHTS = (-3.0, 3.0), (-2.0, 4.0)
"""Limits of both there, in that unit."""
WIDER = 1.3
LEAST_WINDOW_M, LEAST_WINDOW_PX = 0.06, 12
NEAR_M = 0.35
"""Depths that differ more from the middle are of something else."""
LEAST_DEPTHS = 3


class Crop(NamedTuple):
    """A thing cut out.

    Attributes:
        planes: colours, mask, depth, height, whether there is depth; shape (SIDE, SIDE, CHANNELS).
        numbers: how large the window is, how far away, how high up, and so on; shape (NUMBERS,).
        p_W: the point that the namer's places are measured from [m], shape (3,).
        R_WS: its axes: along the horizontal sight, to the left, up; shape (3, 3).
        range_m: from the camera.
    """

    planes: Floats
    numbers: Floats
    p_W: Array
    R_WS: Array
    range_m: float


def crop(seen: Sight, pixels: NDArray[np.bool_], score: float) -> Crop | None:
    """Cut a thing out; None if no depth tells how far away it is.

    Args:
        seen: the picture.
        pixels: which show the thing.
        score: how likely it is one.
    """
    rows, columns = np.nonzero(pixels)
    depths = seen.depth_m[rows, columns]
    depths = depths[depths > 0.0]
    if len(depths) < LEAST_DEPTHS:
        return None
    depth_m = float(np.median(depths))
    top, bottom = int(rows.min()), int(rows.max()) + 1
    left, right = int(columns.min()), int(columns.max()) + 1
    px_m = depth_m / seen.focal_px
    side_px = WIDER * max(bottom - top, right - left)
    side_px = max(side_px, LEAST_WINDOW_PX, LEAST_WINDOW_M / px_m)
    u, v = (left + right - 1) / 2, (top + bottom - 1) / 2
    own = pixels & (np.abs(seen.depth_m - np.float32(depth_m)) < NEAR_M)
    heights = seen.height_m[own]
    foot_m = float(np.quantile(heights, 0.03)) if len(heights) else 0.0
    planes = _planes(seen, pixels, (u, v, side_px), depth_m, foot_m)
    p_W = point_W(seen, u, v, depth_m)
    sight = p_W - np.array(seen.X_WC.p)
    flat_m = max(math.hypot(sight[0], sight[1]), 1e-6)
    along = np.array([sight[0] / flat_m, sight[1] / flat_m, 0.0])
    R_WS = np.column_stack([along, [-along[1], along[0], 0.0], [0.0, 0.0, 1.0]])
    is_cut = top == 0 or left == 0 or bottom == pixels.shape[0] or right == pixels.shape[1]
    numbers = np.array([
        math.log(side_px * px_m / 0.2), depth_m - 1.0, foot_m - 0.8,
        (right - left) * px_m / UNIT_M, (bottom - top) * px_m / UNIT_M,
        0.3 * math.log(len(rows) / 100.0), math.atan2(-sight[2], flat_m), score, float(is_cut),
    ], dtype=np.float32)  # fmt: skip
    return Crop(planes, numbers, p_W, R_WS, float(np.linalg.norm(sight)))


def _planes(
    seen: Sight,
    pixels: NDArray[np.bool_],
    window: tuple[float, float, float],
    depth_m: float,
    foot_m: float,
) -> Floats:
    """The window's pixels, at a size that is always the same; grey and no depth past the border."""
    u, v, side_px = window
    height, width = pixels.shape
    step = side_px / SIDE_PX
    at = (np.arange(SIDE_PX) + 0.5) * step - side_px / 2
    column, row = np.rint(u + at).astype(np.intp), np.rint(v + at).astype(np.intp)
    inside = ((row >= 0) & (row < height))[:, None] & ((column >= 0) & (column < width))[None, :]
    grid = np.ix_(np.clip(row, 0, height - 1), np.clip(column, 0, width - 1))
    planes = np.zeros((SIDE_PX, SIDE_PX, CHANNELS), dtype=np.float32)
    if step <= 1.0:
        colours = seen.colours[grid].astype(np.float32)
    else:  # several pixels fall into one: their mean
        x, y = max(0.0, u + 0.5 - side_px / 2), max(0.0, v + 0.5 - side_px / 2)
        box = x, y, min(float(width), x + side_px), min(float(height), y + side_px)
        spans = np.flatnonzero(inside.any(axis=0)), np.flatnonzero(inside.any(axis=1))
        whole = Image.fromarray(seen.colours)
        some = whole.resize((len(spans[0]), len(spans[1])), Image.Resampling.BILINEAR, box=box)
        colours = np.zeros((SIDE_PX, SIDE_PX, 3), dtype=np.float32)
        colours[np.ix_(spans[1], spans[0])] = np.asarray(some)
    planes[..., :3] = np.where(inside[..., None], colours / np.float32(255.0) - 0.5, 0.0)
    planes[..., 3] = pixels[grid] & inside
    depths = seen.depth_m[grid]
    there = inside & (depths > 0.0)
    planes[..., 4] = np.where(there, np.clip((depths - depth_m) / UNIT_M, *DEPTHS), 0.0)
    high = np.clip((seen.height_m[grid] - foot_m) / UNIT_M, *HEIGHTS)
    planes[..., 5] = np.where(there, high, 0.0)
    planes[..., 6] = there
    return planes
