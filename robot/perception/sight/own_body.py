"""Which pixels show the robot itself: it knows its joints, and what it is built of."""

# pyright: basic
# mujoco ships partial stubs.

from __future__ import annotations

import mujoco
import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from robot.messages import RgbdImage
from robot.model.body import BodyModel
from robot.se3 import SE3

STRIDE_PX = 2
"""A ray for each second pixel of each second row."""
GROWN_PX = 2
"""Fingers are a little elsewhere than their joints say, and cameras blur."""
SHOWN = np.array([1, 1, 1, 0, 1, 0], dtype=np.uint8)
"""Groups of geoms that are seen."""
STATIC = True
REACH_M = 1.6
"""No part of itself is further from its eyes."""
BEFORE_M = 0.03
"""What is so much nearer than the robot's own part there is something in front of it."""


class OwnBody:
    """Casts rays at the robot's own geometry."""

    def __init__(self, body: BodyModel, site: int) -> None:
        """Look from a site; the body that it sits in is looked through."""
        self._body, self._site = body, site
        self._through = int(body.model.site_bodyid[site])

    def pixels(self, data: mujoco.MjData, image: RgbdImage) -> NDArray[np.bool_]:
        """Where a picture shows the robot, shape (height, width).

        Args:
            data: of the body, with base and joints as they were at the picture's stamp, and its
                kinematics done.
            image: the picture.
        """
        X_NC: SE3 = self._body.site_pose(data, self._site)
        (fx, fy), (cx, cy) = image.focal_px, image.centre_px
        half = (STRIDE_PX - 1) / 2
        u, v = np.meshgrid(
            (np.arange(0, image.width, STRIDE_PX) + half - cx) / fx,
            (np.arange(0, image.height, STRIDE_PX) + half - cy) / fy,
        )
        rays_C = np.stack([u, v, np.ones_like(u)], axis=-1)
        lengths = np.linalg.norm(rays_C, axis=-1)
        rays = (rays_C / lengths[..., None]) @ X_NC.rotation().T
        count = lengths.size
        geoms, distances = np.empty(count, dtype=np.int32), np.empty(count)
        mujoco.mj_multiRay(
            self._body.model, data, np.array(X_NC.p), np.ascontiguousarray(rays).reshape(-1),
            SHOWN, STATIC, self._through, geoms, distances, None, count, REACH_M,
        )  # fmt: skip
        own_m = np.where(geoms >= 0, distances, np.inf).reshape(lengths.shape) / lengths
        if not np.isfinite(own_m).any():
            return np.zeros((image.height, image.width), dtype=np.bool_)
        large = own_m.repeat(STRIDE_PX, axis=0).repeat(STRIDE_PX, axis=1)
        large = large[: image.height, : image.width]
        depth_m = image.depth()
        shows = np.isfinite(large)
        if depth_m is not None:
            shows &= (depth_m <= 0.0) | (depth_m > large - BEFORE_M)
        return np.asarray(ndimage.binary_dilation(shows, iterations=GROWN_PX), np.bool_)
