"""The robot's camera: a view of the scene, with the flaws of its reality, as a driver gives it."""

from __future__ import annotations

from contextlib import ExitStack, suppress
from typing import Self

import mujoco
import numpy as np

from robot.closing import Closing
from robot.errors import ConfigError
from robot.messages import RgbdImage
from robot.model.description import RobotDescription
from robot.reality.studio import Renderer
from robot.se3 import SE3, Array
from sim.camera.by_gl import GlViewer
from sim.camera.by_rays import RayViewer
from sim.camera.flaws import CameraFlaws, Shot, to_bytes
from sim.camera.scene_view import Pinhole, SceneView, Viewer
from sim.realities import Camera


class RgbdCamera(Closing):
    """Takes pictures of a simulation when asked to. A context manager.

    Attributes:
        flaws: what is wrong with it; None: nothing.
        pinhole: its size and focal length.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        now: mujoco.MjData,
        robot: RobotDescription,
        *,
        seed: int,
        reality: Camera | None = None,
        renderer: Renderer = "auto",
        size: tuple[int, int] | None = None,
    ) -> None:
        """Prepare; nothing is opened before `with`.

        Args:
            model: of the scene.
            now: of the scene, as it is when a picture is taken; only read.
            robot: whose camera it is.
            seed: of the run.
            reality: what cameras are like there; None: perfect.
            renderer: "auto" takes EGL where it is installed, else rays.
            size: width and height [px] in place of the description's.
        """
        self._model, self._now, self._data = model, now, mujoco.MjData(model)
        width, height = size or (0, 0)
        self.pinhole = Pinhole.of(robot, width=width, height=height)
        self.flaws = None if reality is None else CameraFlaws(reality, self.pinhole, seed=seed)
        self._site = robot.sensors.camera.site
        self._range_m = robot.sensors.camera.pictures().depth_range_m
        self._renderer = renderer
        self._viewer: Viewer | None = None
        self._opened = ExitStack()

    def __enter__(self) -> Self:
        """Open the renderer. Raises ConfigError if EGL is asked for and not installed."""
        if self._renderer != "rays":
            with suppress(*() if self._renderer == "egl" else (ConfigError,)):
                self._viewer = self._opened.enter_context(self._make(GlViewer))
        if self._viewer is None:
            self._viewer = self._opened.enter_context(self._make(RayViewer))
        return self

    def close(self) -> None:
        """Close the renderer."""
        self._opened.close()
        self._viewer = None

    @property
    def by(self) -> str:
        """What renders: EGL or rays."""
        return self._open().name

    def late_s(self, stamp_s: float) -> float | None:
        """How long a picture of that time takes to come; None: it never does."""
        return 0.0 if self.flaws is None else self.flaws.late_s(stamp_s)

    def take(self, stamp_s: float) -> RgbdImage:
        """A picture of the scene as it is now; the physics does not notice."""
        viewer, pinhole = self._open(), self.pinhole
        self._look_up()
        view = viewer.look()
        shot = self._shoot(view, stamp_s)
        depth_m = np.where(shot.depth_m > self._range_m, np.float32(0.0), shot.depth_m)
        return RgbdImage(
            stamp_s=stamp_s,
            width=pinhole.width,
            height=pinhole.height,
            focal_px=(pinhole.focal_px, pinhole.focal_px),
            centre_px=pinhole.centre_px,
            frame=self._site,
            colours=shot.colours.tobytes(),
            depth_m=depth_m.tobytes(),
            exposure_s=shot.exposure_s,
        )

    def X_WC(self) -> SE3:
        """Where it truly is, x to the right, y down, z forward."""
        self._look_up()
        site = self._data.site(self._site)
        return SE3.from_rotation(site.xmat.reshape(3, 3), site.xpos)

    def _shoot(self, view: SceneView, stamp_s: float) -> Shot:
        if self.flaws is None:
            depth_m = np.where(np.isfinite(view.depth_m), view.depth_m, np.float32(0.0))
            return Shot(to_bytes(view.light), depth_m, 0.0)
        return self.flaws.shoot(view, stamp_s=stamp_s, turning_C=self._turning_C())

    def _look_up(self) -> None:
        """Bring the camera's own copy of the scene up to date."""
        data, now = self._data, self._now
        data.qpos[:], data.qvel[:] = now.qpos, now.qvel
        data.mocap_pos[:], data.mocap_quat[:] = now.mocap_pos, now.mocap_quat
        mujoco.mj_kinematics(self._model, data)
        mujoco.mj_comPos(self._model, data)
        mujoco.mj_camlight(self._model, data)
        mujoco.mj_comVel(self._model, data)

    def _turning_C(self) -> Array:
        """How fast the camera turns, in its own frame [rad/s]."""
        velocity: Array = np.empty(6)
        site = int(self._model.site(self._site).id)
        mujoco.mj_objectVelocity(
            self._model, self._data, mujoco.mjtObj.mjOBJ_SITE.value, site, velocity, 1
        )
        return velocity[:3]

    def _open(self) -> Viewer:
        if self._viewer is None:
            raise ConfigError("the camera is not open")
        return self._viewer

    def _make(self, kind: type[GlViewer] | type[RayViewer]) -> Viewer:
        return kind(self._model, self._data, site=self._site, pinhole=self.pinhole)
