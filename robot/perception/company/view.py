"""A depth image as points of the world, of each pixel that measured something."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from robot.messages import DepthImage, RgbdImage
from robot.se3 import SE3, Array

COLUMNS = 110
"""A finer image is looked at coarser: at 5 m a column of so many is 7 cm, a head two."""


class DepthView(NamedTuple):
    """Depth with where it is.

    Attributes:
        stamp_s: of the image.
        depth_m: along the optical axis, 0 where nothing was measured, shape (rows, columns).
        points_W: of each pixel [m], shape (rows, columns, 3); of no meaning where depth is 0.
        focal_px: of the image as it is here.
        X_WC: where the camera was, z forward.
        colours: red, green, blue of each pixel where the camera has them, shape (rows, columns, 3).
    """

    stamp_s: float
    depth_m: NDArray[np.float32]
    points_W: Array
    focal_px: float
    X_WC: SE3
    colours: NDArray[np.uint8] | None = None

    @property
    def eye_W(self) -> Array:
        """Where the camera is [m], shape (3,)."""
        return np.array(self.X_WC.p)


def of_depth(image: DepthImage, X_WC: SE3) -> DepthView:
    """Of a plain depth image."""
    focal_px = 0.5 * image.height / math.tan(0.5 * image.fovy_rad)
    centre_px = (0.5 * image.width - 0.5, 0.5 * image.height - 0.5)
    return _view(image.stamp_s, image.pixels(), (focal_px, focal_px), centre_px, X_WC)


def of_picture(image: RgbdImage, X_WC: SE3) -> DepthView | None:
    """Of a picture with depth; None where it has none."""
    depth_m = image.depth()
    if depth_m is None:
        return None
    view = _view(image.stamp_s, depth_m, image.focal_px, image.centre_px, X_WC)
    step = _step(image.width)
    return view._replace(colours=image.picture()[::step, ::step])


def _step(width: int) -> int:
    return max(1, round(width / COLUMNS))


def _view(
    stamp_s: float,
    depth_m: NDArray[np.float32],
    focal_px: tuple[float, float],
    centre_px: tuple[float, float],
    X_WC: SE3,
) -> DepthView:
    step = _step(depth_m.shape[1])
    coarse = depth_m[::step, ::step]
    rows: Array = step * np.arange(coarse.shape[0], dtype=np.float64)
    columns: Array = step * np.arange(coarse.shape[1], dtype=np.float64)
    z: Array = coarse.astype(np.float64)
    x: Array = z * ((columns - centre_px[0]) / focal_px[0])[None, :]
    y: Array = z * ((rows - centre_px[1]) / focal_px[1])[:, None]
    points_W = np.stack([x, y, z], axis=-1) @ X_WC.rotation().T + np.array(X_WC.p)
    return DepthView(stamp_s, coarse, points_W, focal_px[0] / step, X_WC)
