"""What a perfect camera would see, before anything is wrong with it: rays and GL both make this."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from robot.closing import Closing
from robot.model.description import RobotDescription
from robot.se3 import Array

Floats = NDArray[np.float32]
FAR_M = 60.0
"""Nothing further away is drawn."""


@dataclass(frozen=True)
class Pinhole:
    """A camera without distortion, of square pixels, that looks through its middle."""

    width: int
    height: int
    focal_px: float

    @staticmethod
    def of(robot: RobotDescription, *, width: int = 0, height: int = 0) -> Pinhole:
        """The head's, or one of another size with the same vertical field of view."""
        camera, picture = robot.sensors.camera, robot.sensors.camera.pictures()
        width, height = width or picture.width, height or picture.height
        return Pinhole(width, height, height / 2 / math.tan(camera.fovy_rad / 2))

    @property
    def centre_px(self) -> tuple[float, float]:
        """cx, cy, where the middle of the first pixel is (0, 0)."""
        return (self.width - 1) / 2, (self.height - 1) / 2

    def rays_C(self) -> Array:
        """Through the middle of each pixel, of length 1 along z, shape (height, width, 3)."""
        cx, cy = self.centre_px
        u, v = np.meshgrid(
            (np.arange(self.width) - cx) / self.focal_px,
            (np.arange(self.height) - cy) / self.focal_px,
        )
        return np.stack([u, v, np.ones_like(u)], axis=-1).astype(np.float64)


class SceneView(NamedTuple):
    """A view of a scene, pixel for pixel, shapes (height, width).

    Attributes:
        light: red, green, blue; 1: as bright as the camera can tell. Shape (height, width, 3).
        depth_m: along the optical axis; infinite where nothing is.
        facing: cosine between a surface's normal and the direction to the camera; 1 is face on.
        gloss: how much of a mirror the surface is, from 0 to 1.
    """

    light: Floats
    depth_m: Floats
    facing: Floats
    gloss: Floats


class Viewer(Closing, Protocol):
    """Looks at a scene as it is now; a context manager.

    Attributes:
        name: of how it does that, for people.
    """

    name: str

    def look(self) -> SceneView:
        """What is seen now, from where the camera's site is now."""
        ...
