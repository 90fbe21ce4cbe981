"""Depth camera and planar lidar, emulated with rays."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache

import mujoco
import numpy as np
from numpy.typing import NDArray

from robot.messages import DepthImage, LidarScan, Message
from robot.model.description import RobotDescription
from robot.se3 import Array
from sim.rays import Rays
from sim.realities import Camera, Lidar

# Every third pixel of the camera, in both directions: a ray costs about half a microsecond, so
# 53 x 40 take 1.2 ms where 160 x 120 take 10.
DEPTH_STRIDE = 3
LAID_OUT = ("geom_xpos", "geom_xmat", "xipos", "ximat")  # all that a ray asks of where things are


class Exposure(DepthImage, frozen=True, kw_only=True):
    """A depth image whose rays are cast when somebody looks at it, as it was when it was taken.

    Nobody looks at half of them. It stays in its process; what travels is `developed`.
    """

    cast: Callable[[], NDArray[np.float32]]

    def pixels(self) -> NDArray[np.float32]:
        """Depth [m], shape (height, width), not to be written to."""
        return self.cast()


def developed(message: Message) -> Message:
    """A message as it can travel: a depth image has its pixels."""
    if not isinstance(message, Exposure):
        return message
    return DepthImage(
        stamp_s=message.stamp_s,
        width=message.width,
        height=message.height,
        fovy_rad=message.fovy_rad,
        depth_m=message.pixels().tobytes(),
    )


class DepthCamera:
    """The head's depth camera."""

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        robot: RobotDescription,
        *,
        rng: np.random.Generator,
    ) -> None:
        """Lay out the rays, one through each pixel's middle."""
        self.flaws = Camera()
        camera = robot.sensors.camera
        self._rng = rng
        self._site = data.site(camera.site)
        self._range_m, self._fovy_rad = camera.range_m, camera.fovy_rad
        self.width, self.height = camera.width // DEPTH_STRIDE, camera.height // DEPTH_STRIDE
        focal = self.height / 2 / math.tan(camera.fovy_rad / 2)
        u, v = np.meshgrid(
            (np.arange(self.width) + 0.5 - self.width / 2) / focal,
            (np.arange(self.height) + 0.5 - self.height / 2) / focal,
        )
        rays_C = np.stack([u, v, np.ones_like(u)], axis=-1).reshape(-1, 3)
        self._rays_C = rays_C / np.linalg.norm(rays_C, axis=1, keepdims=True)
        most_oblique = float(self._rays_C[:, 2].min())
        self._reach_m, self._half_angle_rad = camera.range_m / most_oblique, math.acos(most_oblique)
        self.body = int(model.site_bodyid[model.site(camera.site).id])
        self._now, self._then = data, mujoco.MjData(model)
        self._rays = Rays(model, self._then, body=self.body)

    def capture(self, stamp_s: float) -> Exposure:
        """One frame, of the positions of now."""
        scene = [getattr(self._now, name).copy() for name in LAID_OUT]
        eye, rotation = self._site.xpos.copy(), self._site.xmat.reshape(3, 3).copy()
        noise = self._rng.standard_normal(len(self._rays_C), dtype=np.float32)
        return Exposure(
            stamp_s=stamp_s,
            width=self.width,
            height=self.height,
            fovy_rad=self._fovy_rad,
            depth_m=b"",
            cast=cache(lambda: self._cast(scene, eye, rotation, noise)),
        )

    def _cast(
        self, scene: list[Array], eye: Array, rotation: Array, noise: NDArray[np.float32]
    ) -> NDArray[np.float32]:
        """Depth [m], shape (height, width), from an eye among what lies as in `scene`."""
        for name, values in zip(LAID_OUT, scene, strict=True):
            getattr(self._then, name)[:] = values
        reach_m = self._reach_m
        with self._rays.only_within(
            eye, rotation[:, 2], half_angle_rad=self._half_angle_rad, range_m=reach_m
        ):
            distances, _ = self._rays.cast(eye, self._rays_C @ rotation.T, range_m=reach_m)
        depth = distances * self._rays_C[:, 2]
        depth += self.flaws.noise_per_m * depth * depth * noise
        depth[(distances < 0.0) | (depth > self._range_m)] = 0.0
        return depth.astype(np.float32).reshape(self.height, self.width)


class PlanarLidar:
    """The planar lidar; what hits the robot itself is filtered out, as a driver does."""

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        robot: RobotDescription,
        *,
        rng: np.random.Generator,
    ) -> None:
        """Lay out the beams, counter-clockwise from -pi in the site's plane."""
        self.flaws = Lidar()
        lidar = robot.sensors.lidar
        self._rng = rng
        self._site = data.site(lidar.site)
        self._range_m = lidar.range_m
        self._step_rad = 2.0 * math.pi / lidar.beams
        angles = -math.pi + self._step_rad * np.arange(lidar.beams)
        self._beams = np.stack([np.cos(angles), np.sin(angles), np.zeros_like(angles)], axis=1)
        self._rays = Rays(model, data, body=int(model.site_bodyid[model.site(lidar.site).id]))
        root = model.body(robot.base_body).id
        self._own: NDArray[np.bool_] = model.body_rootid[model.geom_bodyid] == root
        self._angles = angles
        self._covered = np.zeros(lidar.beams, dtype=bool)

    def cover(self, width_rad: float, towards_rad: float) -> None:
        """Let the beams of a sector about an angle come back empty; of no width: none of them."""
        off = np.mod(self._angles - towards_rad + math.pi, 2.0 * math.pi) - math.pi
        self._covered = np.abs(off) < 0.5 * width_rad + 1e-9 if width_rad else self._covered & False

    def scan(self, stamp_s: float) -> LidarScan:
        """One turn."""
        directions = self._beams @ self._site.xmat.reshape(3, 3).T
        ranges, geoms = self._rays.cast(self._site.xpos, directions, range_m=self._range_m)
        flaws = self.flaws
        missed = (geoms < 0) | self._own[geoms] | (ranges < flaws.least_m) | self._covered
        if flaws.dropouts:
            missed |= self._rng.random(len(ranges)) < flaws.dropouts
        ranges += flaws.noise_m * self._rng.standard_normal(len(ranges))
        ranges[missed] = math.inf
        return LidarScan(
            stamp_s=stamp_s,
            angle_min_rad=-math.pi,
            angle_step_rad=self._step_rad,
            ranges_m=tuple(ranges.tolist()),
        )
