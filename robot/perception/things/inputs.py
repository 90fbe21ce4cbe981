"""A picture with depth as the finder takes it, and its points in the world."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from robot.messages import RgbdImage
from robot.se3 import SE3, Array

Floats = NDArray[np.float32]
CHANNELS = 6


class Sight(NamedTuple):
    """A picture, where it was taken from, and what follows from both; shapes (height, width, ...).

    Attributes:
        colours: red, green, blue of 0 to 255.
        depth_m: along the optical axis; 0 where none was measured.
        height_m: above the floor, 0 where there is no depth.
        X_WC: where the camera was.
        focal_px, centre_px: of the camera, fx alone, and cx, cy.
    """

    colours: NDArray[np.uint8]
    depth_m: Floats
    height_m: Floats
    X_WC: SE3
    focal_px: float
    centre_px: tuple[float, float]


def sight(image: RgbdImage, X_WC: SE3) -> Sight | None:
    """A picture with its heights; None if its camera measures no depth."""
    depth_m = image.depth()
    if depth_m is None:
        return None
    (fx, fy), (cx, cy) = image.focal_px, image.centre_px
    up = X_WC.rotation()[2]
    across = ((np.arange(image.width) - cx) / fx * up[0]).astype(np.float32)
    down = ((np.arange(image.height) - cy) / fy * up[1] + up[2]).astype(np.float32)
    height_m = depth_m * (across[None, :] + down[:, None]) + np.float32(X_WC.p[2])
    height_m[depth_m <= 0.0] = 0.0
    return Sight(image.picture(), depth_m, height_m, X_WC, fx, (cx, cy))


def tensor(seen: Sight) -> Floats:
    """Colours, nearness, height and whether there is depth, shape (height, width, CHANNELS)."""
    found = np.empty((*seen.depth_m.shape, CHANNELS), dtype=np.float32)
    found[..., :3] = seen.colours
    found[..., :3] /= np.float32(255.0)
    found[..., :3] -= np.float32(0.5)
    there = seen.depth_m > 0.0
    found[..., 3] = np.where(there, 1.0 / np.maximum(seen.depth_m, np.float32(0.2)), 0.0)
    found[..., 4] = seen.height_m
    found[..., 5] = there
    return found


def point_W(seen: Sight, u: float, v: float, depth_m: float) -> Array:
    """Where a pixel at a depth is [m], shape (3,)."""
    cx, cy = seen.centre_px
    x, y = (u - cx) / seen.focal_px * depth_m, (v - cy) / seen.focal_px * depth_m
    return seen.X_WC.apply((x, y, depth_m))
