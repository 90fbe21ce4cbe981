"""Pictures of a simulation without a display: through EGL where it is installed, else by rays."""

from __future__ import annotations

import io
import math
from pathlib import Path
from typing import Any, Self

import msgspec
import mujoco
import numpy as np
from numpy.typing import NDArray

from robot.closing import Closing
from robot.errors import ConfigError
from robot.files.ordinary_files import write_ordinary
from robot.se3 import Vector3
from sim.camera.by_rays import Tracer
from sim.camera.flaws import to_bytes
from sim.camera.scene_view import Pinhole
from sim.gl_context import gl_context
from sim.plant import Plant
from sim.rays import SEEN, UNSENSED
from sim.world_schema import World

Image = NDArray[np.uint8]
JPEG = (".jpg", ".jpeg")


class View(msgspec.Struct, frozen=True, kw_only=True):
    """From where to look: at a point of the world, from a distance, along a heading (0 is +x).

    With `camera` the view is that of a camera of the model instead.
    """

    at: Vector3 = (0.0, 0.0, 0.7)
    distance_m: float = 4.0
    heading_deg: float = 125.0
    down_deg: float = 22.0
    camera: str = ""


ROOM_M = 9.0
"""Up to this size a world is looked at from the side."""


def overview(world: World) -> View:
    """The whole world, from its south-east: the steeper, the larger, as walls hide what is behind.

    Nobody looks at a bare floor from further than at a large room.
    """
    x_min, y_min, x_max, y_max = world.bounds_m
    furnished = any(room.walls for room in world.rooms) or world.furniture
    size = max(x_max - x_min, y_max - y_min) if furnished else ROOM_M
    steeper = min(1.0, max(0.0, size - ROOM_M) / 4.0)
    at = ((x_min + x_max) / 2, (y_min + y_max) / 2, 0.55)
    return View(
        at=at, distance_m=(1.12 + 0.38 * steeper) * size, heading_deg=118.0 - 28.0 * steeper,
        down_deg=30.0 + 45.0 * steeper,
    )  # fmt: skip


class Renderer(Closing):
    """Draws one model. A context manager: a GL context lives inside the `with`.

    Rays show the same, without shadows and with ragged edges.
    """

    def __init__(self, model: mujoco.MjModel, *, width: int = 1280, height: int = 720) -> None:
        """Prepare; nothing is opened before `with`."""
        self._model, self._width, self._height = model, width, height
        self._gl: Any = None
        self._groups = SEEN.copy()
        self._tracer: Tracer | None = None
        self._traced_by = (0, 0.0)
        self._scene = mujoco.MjvScene(model, maxgeom=2000)
        self._option = mujoco.MjvOption()
        self._option.geomgroup[UNSENSED] = 1
        self._camera = mujoco.MjvCamera()
        self._rect = mujoco.MjrRect(0, 0, width, height)

    def __enter__(self) -> Self:
        """Open an EGL context; where there can be none, rays need nothing."""
        try:
            self._gl = gl_context(self._width, self._height)
        except ConfigError:
            return self
        self._gl.make_current()
        self._context = mujoco.MjrContext(self._model, mujoco.mjtFontScale.mjFONTSCALE_150.value)
        mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN.value, self._context)
        return self

    @property
    def by(self) -> str:
        """What draws, for people."""
        return "rays" if self._gl is None else "EGL"

    def leave_out(self, group: int) -> None:
        """Draw no geoms of a group."""
        self._option.geomgroup[group] = self._groups[group] = 0

    def close(self) -> None:
        """Free the context."""
        if self._gl is not None:
            self._context.free()
            self._gl.free()
            self._gl = None

    def image(self, data: mujoco.MjData, view: View) -> Image:
        """One picture, shape (height, width, 3)."""
        if self._gl is None:
            return self._traced(data, view)
        self._aim(view)
        visible = mujoco.mjtCatBit.mjCAT_ALL.value
        mujoco.mjv_updateScene(
            self._model, data, self._option, None, self._camera, visible, self._scene
        )
        self._scene.flags[mujoco.mjtRndFlag.mjRND_HAZE] = 0
        self._scene.flags[mujoco.mjtRndFlag.mjRND_REFLECTION] = 0
        mujoco.mjr_render(self._rect, self._scene, self._context)
        pixels = np.empty((self._height, self._width, 3), dtype=np.uint8)
        mujoco.mjr_readPixels(pixels, None, self._rect, self._context)
        return np.flipud(pixels)

    def _traced(self, data: mujoco.MjData, view: View) -> Image:
        """One picture by rays."""
        fovy_deg = float(self._model.vis.global_.fovy)
        if view.camera:
            camera = self._model.camera(view.camera).id
            fovy_deg = float(self._model.cam_fovy[camera])
            eye_W = data.cam_xpos[camera].copy()
            right, above, back = data.cam_xmat[camera].reshape(3, 3).T
            axes = right, -above, -back
        else:
            heading, down = math.radians(view.heading_deg), math.radians(view.down_deg)
            level = np.array([math.cos(heading), math.sin(heading), 0.0])
            forward = math.cos(down) * level - np.array([0.0, 0.0, math.sin(down)])
            right = np.array([level[1], -level[0], 0.0])
            below = -math.sin(down) * level - np.array([0.0, 0.0, math.cos(down)])
            eye_W = np.array(view.at) - view.distance_m * forward
            axes = right, below, forward
        tracer = self._tracer_of(data, fovy_deg)
        return to_bytes(tracer.look(eye_W, np.column_stack(axes)).light)

    def _tracer_of(self, data: mujoco.MjData, fovy_deg: float) -> Tracer:
        """Of the last picture, if that was of the same scene through the same lens."""
        if self._tracer is None or self._traced_by != (id(data), fovy_deg):
            focal_px = self._height / 2 / math.tan(math.radians(fovy_deg) / 2)
            pinhole = Pinhole(self._width, self._height, focal_px)
            self._tracer = Tracer(self._model, data, pinhole, groups=self._groups)
            self._traced_by = id(data), fovy_deg
        return self._tracer

    def _aim(self, view: View) -> None:
        camera = self._camera
        if view.camera:
            camera.type = mujoco.mjtCamera.mjCAMERA_FIXED.value
            camera.fixedcamid = int(self._model.camera(view.camera).id)
            return
        camera.type = mujoco.mjtCamera.mjCAMERA_FREE.value
        camera.lookat[:] = view.at
        camera.distance = view.distance_m
        camera.azimuth, camera.elevation = view.heading_deg, -view.down_deg


def snapshot(
    plant: Plant,
    path: Path | str,
    *,
    view: View | None = None,
    width: int = 1280,
    height: int = 720,
) -> None:
    """Save a picture of the plant as it is now (by default the whole world): PNG or JPEG."""
    with Renderer(plant.model, width=width, height=height) as renderer:
        save_picture(path, renderer.image(plant.data, view or overview(plant.world)))


def show(plant: Plant) -> None:
    """Open MuJoCo's own viewer, until it is closed.

    Raises:
        ConfigError: if a library that it needs is not installed.
    """
    try:
        from mujoco.viewer import launch  # pyright: ignore[reportMissingTypeStubs]
    except ImportError as error:
        raise ConfigError(f"there is no viewer: {error}") from error
    launch(plant.model, plant.data)


def save_picture(path: Path | str, image: Image) -> None:
    """Write an image, shape (height, width, 3), as PNG, or as JPEG where its name says so."""
    from PIL import Image as Picture

    kind = "JPEG" if Path(path).suffix.lower() in JPEG else "PNG"
    data = io.BytesIO()
    Picture.fromarray(image).save(data, kind)
    write_ordinary(path, data.getvalue())
