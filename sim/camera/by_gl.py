"""Pictures through GL, where EGL is installed: the same view as from rays, in less time."""

from __future__ import annotations

import math
from typing import Any, Self

import mujoco
import numpy as np
from numpy.typing import NDArray

from robot.closing import Closing
from robot.se3 import Array
from sim.camera.scene_view import FAR_M, Floats, Pinhole, SceneView
from sim.camera.surfaces import Surfaces
from sim.gl_context import gl_context
from sim.rays import SEEN

NEAR_M = 0.03
MOST_GEOMS = 10_000


class GlViewer(Closing):
    """MuJoCo's own renderer, without shadows: these alone take ten times as long."""

    name = "EGL"

    def __init__(
        self, model: mujoco.MjModel, data: mujoco.MjData, *, site: str, pinhole: Pinhole
    ) -> None:
        """Prepare; nothing is opened before `with`."""
        self._model, self._data, self._pinhole = model, data, pinhole
        self._site = data.site(site)
        self._body = int(model.site_bodyid[model.site(site).id])
        self._scene = mujoco.MjvScene(model, maxgeom=MOST_GEOMS)
        for flag in (mujoco.mjtRndFlag.mjRND_SHADOW, mujoco.mjtRndFlag.mjRND_REFLECTION,
                     mujoco.mjtRndFlag.mjRND_HAZE):  # fmt: skip
            self._scene.flags[flag] = 0
        self._option = mujoco.MjvOption()
        self._option.geomgroup[:] = SEEN
        self._option.sitegroup[:] = 0
        self._view = mujoco.MjvCamera()
        self._rect = mujoco.MjrRect(0, 0, pinhole.width, pinhole.height)
        self._rays_C = pinhole.rays_C()
        self._gloss: Floats = Surfaces(model).gloss
        self._gl: Any = None

    def __enter__(self) -> Self:
        """Open a context. Raises ConfigError where EGL is not installed."""
        self._gl = gl_context(self._pinhole.width, self._pinhole.height)
        self._gl.make_current()
        quality, visual = self._model.vis.quality, self._model.vis.global_
        before = quality.shadowsize, quality.offsamples, visual.offwidth, visual.offheight
        quality.shadowsize = quality.offsamples = 0  # several samples would move depth in a pixel
        visual.offwidth, visual.offheight = self._pinhole.width, self._pinhole.height
        self._context = mujoco.MjrContext(self._model, mujoco.mjtFontScale.mjFONTSCALE_100.value)
        quality.shadowsize, quality.offsamples, visual.offwidth, visual.offheight = before
        self._context.readDepthMap = mujoco.mjtDepthMap.mjDEPTH_ZEROFAR.value
        mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN.value, self._context)
        return self

    def close(self) -> None:
        """Free the context."""
        if self._gl is not None:
            self._context.free()
            self._gl.free()
            self._gl = None

    def look(self) -> SceneView:
        """What is seen now."""
        visible = mujoco.mjtCatBit.mjCAT_ALL.value
        mujoco.mjv_updateScene(
            self._model, self._data, self._option, None, self._view, visible, self._scene
        )
        self._leave_out_itself()
        self._aim()
        pixels, depth = self._draw()
        geoms = self._which()
        depth_m = np.where(geoms >= 0, _metres(depth), np.float32(math.inf))  # the sky has a depth
        light = pixels.astype(np.float32) / 255.0
        gloss = np.where(geoms >= 0, self._gloss[geoms], 0.0).astype(np.float32)
        return SceneView(light, depth_m, self._facing(depth_m), gloss)

    def _leave_out_itself(self) -> None:
        """The camera does not see the body that it sits in."""
        first = int(self._model.body_geomadr[self._body])
        own = range(first, first + int(self._model.body_geomnum[self._body]))
        for geom in self._scene.geoms[: self._scene.ngeom]:
            if geom.objtype == mujoco.mjtObj.mjOBJ_GEOM and geom.objid in own:
                geom.rgba[3] = 0.0

    def _aim(self) -> None:
        """Look from the site, along its z."""
        rotation = self._site.xmat.reshape(3, 3)
        top = NEAR_M * self._pinhole.height / 2 / self._pinhole.focal_px
        for camera in self._scene.camera:
            camera.pos[:] = self._site.xpos
            camera.forward[:], camera.up[:] = rotation[:, 2], -rotation[:, 1]
            camera.frustum_center = camera.frustum_width = 0.0
            camera.frustum_bottom, camera.frustum_top = -top, top
            camera.frustum_near, camera.frustum_far = NEAR_M, FAR_M
        for light in self._scene.lights[: self._scene.nlight]:
            if light.headlight:
                light.pos[:], light.dir[:] = self._site.xpos, rotation[:, 2]

    def _draw(self) -> tuple[NDArray[np.uint8], Floats]:
        """Colours and what the depth buffer holds, the first row on top."""
        shape = self._pinhole.height, self._pinhole.width
        pixels, depth = np.empty((*shape, 3), np.uint8), np.empty(shape, np.float32)
        mujoco.mjr_render(self._rect, self._scene, self._context)
        mujoco.mjr_readPixels(pixels, depth, self._rect, self._context)
        return pixels[::-1], depth[::-1]

    def _which(self) -> NDArray[np.int64]:
        """The geom that each pixel shows; -1: none."""
        for flag in (mujoco.mjtRndFlag.mjRND_SEGMENT, mujoco.mjtRndFlag.mjRND_IDCOLOR):
            self._scene.flags[flag] = 1
        coded = self._draw()[0].astype(np.int64) @ np.array([1, 256, 65536])
        for flag in (mujoco.mjtRndFlag.mjRND_SEGMENT, mujoco.mjtRndFlag.mjRND_IDCOLOR):
            self._scene.flags[flag] = 0
        geom_of = np.full(self._scene.ngeom + 2, -1)
        for geom in self._scene.geoms[: self._scene.ngeom]:
            if geom.objtype == mujoco.mjtObj.mjOBJ_GEOM and geom.segid >= 0:
                geom_of[geom.segid + 1] = geom.objid
        return geom_of[np.minimum(coded, len(geom_of) - 1)]

    def _facing(self, depth_m: Floats) -> Floats:
        """Cosine between normals and the direction to the camera, from how the depth changes."""
        near = np.where(np.isfinite(depth_m), depth_m, FAR_M)
        points: Array = self._rays_C * near[..., None]
        down, across = np.gradient(points, axis=(0, 1))
        normals = np.cross(down, across)
        lengths = np.linalg.norm(normals, axis=-1) * np.linalg.norm(self._rays_C, axis=-1)
        along = np.abs(np.einsum("ijk,ijk->ij", normals, self._rays_C))
        facing = along / np.maximum(lengths, 1e-12)
        return np.where(np.isfinite(depth_m), facing, 1.0).astype(np.float32)


def _metres(depth: Floats) -> Floats:
    """The depth buffer (1 at `NEAR_M`, 0 at `FAR_M`) as metres."""
    return 1.0 / (depth * np.float32(1.0 / NEAR_M - 1.0 / FAR_M) + np.float32(1.0 / FAR_M))
