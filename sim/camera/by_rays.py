"""Pictures from rays, without GL: what each pixel's ray meets, coloured by how it is lit."""

from __future__ import annotations

import mujoco
import numpy as np
from numpy.typing import NDArray

from robot.closing import Closing
from robot.se3 import Array
from sim.camera.lights import Lights
from sim.camera.scene_view import FAR_M, Floats, Pinhole, SceneView
from sim.camera.surfaces import Surfaces
from sim.rays import SEEN, STATIC


class Tracer:
    """Casts one ray through each pixel of a camera that may be anywhere.

    Attributes:
        met: the geom that each pixel of the last view shows, -1 for none, shape (height, width).
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        pinhole: Pinhole,
        *,
        through: int = -1,
        groups: NDArray[np.uint8] = SEEN,
    ) -> None:
        """Lay out the rays.

        Args:
            model: of the scene.
            data: of the scene; its positions as they are.
            pinhole: of the camera.
            through: a body that is looked through; -1: none.
            groups: which groups of geoms are seen, shape (6,).
        """
        self._model, self._data, self._through, self._groups = model, data, through, groups
        self._shape = pinhole.height, pinhole.width
        self.met: NDArray[np.int32] = np.full(self._shape, -1, dtype=np.int32)
        rays = pinhole.rays_C().reshape(-1, 3)
        self._lengths: Array = np.linalg.norm(rays, axis=1)
        self._rays_C: Array = rays / self._lengths[:, None]
        self._spread = 1.0 / pinhole.focal_px
        self._surfaces, self._lights = Surfaces(model), Lights(model, data)

    def look(self, eye_W: Array, R_WC: Array) -> SceneView:
        """What is seen from a place, along the z of a frame C whose y points down."""
        rays = self._rays_C @ R_WC.T
        count = len(rays)
        geoms, distances = np.empty(count, dtype=np.int32), np.empty(count)
        normals: Array = np.empty(3 * count)
        mujoco.mj_multiRay(
            self._model, self._data, eye_W, rays.reshape(-1), self._groups, STATIC, self._through,
            geoms, distances, normals, count, FAR_M,
        )  # fmt: skip
        normals = normals.reshape(-1, 3)
        hit = (geoms >= 0) & (distances <= FAR_M)
        self.met = geoms.reshape(self._shape)
        towards = -np.einsum("ij,ij->i", normals, rays)
        normals[towards < 0.0] *= -1.0  # of what is seen from within
        facing = np.abs(towards)
        surfaces = self._surfaces
        light: Floats = surfaces.colour[geoms] * self._lights.on(normals, axis_W=R_WC[:, 2])
        np.minimum(light, 1.0, out=light)  # as GL does, before it lays a texture over it
        footprint_m = distances * self._spread / np.maximum(facing, 0.05)
        points_W = eye_W + distances[:, None] * rays
        surfaces.paint(light, geoms, points_W, footprint_m=footprint_m, data=self._data)
        glossy = np.flatnonzero(hit & (surfaces.gloss[geoms] > 0.0))
        which = geoms[glossy]
        light[glossy] += self._lights.highlights(
            normals[glossy],
            rays[glossy],
            axis_W=R_WC[:, 2],
            gloss=surfaces.gloss[which],
            shininess=surfaces.shininess[which],
        )
        light[~hit] = self._lights.sky(rays[~hit])
        depth_m = np.where(hit, distances / self._lengths, np.inf)
        gloss = np.where(hit, surfaces.gloss[geoms], 0.0)
        return SceneView(
            light.reshape(*self._shape, 3),
            depth_m.astype(np.float32).reshape(self._shape),
            np.where(hit, facing, 1.0).astype(np.float32).reshape(self._shape),
            gloss.astype(np.float32).reshape(self._shape),
        )


class RayViewer(Closing):
    """The robot's camera by rays; the body that it sits in is looked through."""

    name = "rays"

    def __init__(
        self, model: mujoco.MjModel, data: mujoco.MjData, *, site: str, pinhole: Pinhole
    ) -> None:
        """Lay out the rays."""
        self._site = data.site(site)
        own = int(model.site_bodyid[model.site(site).id])
        self._tracer = Tracer(model, data, pinhole, through=own)

    def close(self) -> None:
        """Nothing is held."""

    def look(self) -> SceneView:
        """What is seen now."""
        return self._tracer.look(self._site.xpos.copy(), self._site.xmat.reshape(3, 3))
