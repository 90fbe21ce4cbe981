"""A depth image as points of the world."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from robot.messages import RgbdImage
from robot.se3 import SE3, Array


class Cloud(NamedTuple):
    """Points by pixel, shapes (height, width, ...).

    Attributes:
        p_W: where each pixel's point is [m], shape (height, width, 3).
        depth_m: along the optical axis, 0 where none was measured.
        noise_m: 1 sigma of the depth.
        eye_W: where the camera is [m], shape (3,).
        focal_px: of the camera.
    """

    p_W: Array
    depth_m: Array
    noise_m: Array
    eye_W: Array
    focal_px: float

    @property
    def is_there(self) -> NDArray[np.bool_]:
        """Where something was measured."""
        return self.depth_m > 0.0


def cloud(image: RgbdImage, X_WC: SE3, *, noise_per_m: float) -> Cloud | None:
    """The points of a picture; None if its camera measures no depth.

    Args:
        image: the picture.
        X_WC: where its camera was.
        noise_per_m: 1 sigma of depth at a metre; it grows with the square of the depth.
    """
    found = image.depth()
    if found is None:
        return None
    depth_m = found.astype(np.float64)
    (fx, fy), (cx, cy) = image.focal_px, image.centre_px
    u, v = np.meshgrid((np.arange(image.width) - cx) / fx, (np.arange(image.height) - cy) / fy)
    p_C = np.stack([u * depth_m, v * depth_m, depth_m], axis=-1)
    eye_W = np.array(X_WC.p)
    p_W: Array = p_C @ X_WC.rotation().T + eye_W
    return Cloud(p_W, depth_m, noise_per_m * depth_m * depth_m, eye_W, float(fx))
