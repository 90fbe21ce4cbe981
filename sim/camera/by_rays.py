"""Pictures from rays, without GL: what each pixel's ray meets, coloured by how it is lit."""

from __future__ import annotations

import mujoco
import numpy as np

from robot.closing import Closing
from robot.se3 import Array
from sim.camera.lights import Lights
from sim.camera.scene_view import FAR_M, Floats, Pinhole, SceneView
from sim.camera.surfaces import Surfaces
from sim.rays import SEEN, STATIC


class RayViewer(Closing):
    """Casts one ray through each pixel; the camera's own body is looked through."""

    name = "rays"

    def __init__(
        self, model: mujoco.MjModel, data: mujoco.MjData, *, site: str, pinhole: Pinhole
    ) -> None:
        """Lay out the rays."""
        self._model, self._data = model, data
        self._site = data.site(site)
        self._body = int(model.site_bodyid[model.site(site).id])
        self._shape = pinhole.height, pinhole.width
        rays = pinhole.rays_C().reshape(-1, 3)
        self._lengths: Array = np.linalg.norm(rays, axis=1)
        self._rays_C: Array = rays / self._lengths[:, None]
        self._spread = 1.0 / pinhole.focal_px
        self._surfaces, self._lights = Surfaces(model), Lights(model, data)

    def close(self) -> None:
        """Nothing is held."""

    def look(self) -> SceneView:
        """What is seen now."""
        rotation, eye = self._site.xmat.reshape(3, 3), self._site.xpos.copy()
        rays = self._rays_C @ rotation.T
        count = len(rays)
        geoms, distances = np.empty(count, dtype=np.int32), np.empty(count)
        normals: Array = np.empty(3 * count)
        mujoco.mj_multiRay(
            self._model, self._data, eye, rays.reshape(-1), SEEN, STATIC, self._body,
            geoms, distances, normals, count, FAR_M,
        )  # fmt: skip
        normals = normals.reshape(-1, 3)
        hit = (geoms >= 0) & (distances <= FAR_M)
        towards = -np.einsum("ij,ij->i", normals, rays)
        normals[towards < 0.0] *= -1.0  # of what is seen from within
        facing = np.abs(towards)
        surfaces = self._surfaces
        light: Floats = surfaces.colour[geoms] * self._lights.on(normals, axis_W=rotation[:, 2])
        np.minimum(light, 1.0, out=light)  # as GL does, before it lays a texture over it
        footprint_m = distances * self._spread / np.maximum(facing, 0.05)
        points_W = eye + distances[:, None] * rays
        surfaces.paint(light, geoms, points_W, footprint_m=footprint_m, data=self._data)
        glossy = np.flatnonzero(hit & (surfaces.gloss[geoms] > 0.0))
        which = geoms[glossy]
        light[glossy] += self._lights.highlights(
            normals[glossy],
            rays[glossy],
            axis_W=rotation[:, 2],
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
