"""Pictures of a robot in its world as somebody says that it stands: nothing moves by itself."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal, Protocol, TypeAlias

import msgspec
import numpy as np
from numpy.typing import NDArray

from robot.closing import Closing
from robot.messages import RgbdImage
from robot.reality.visual_scene import Flat
from robot.se3 import SE3

Image = NDArray[np.uint8]
"""Shape (height, width, 3)."""
Renderer: TypeAlias = Literal["auto", "rays", "egl"]
"""How the robot's camera is imitated: "auto" takes EGL where it is installed, else rays."""


class Standing(msgspec.Struct, frozen=True, kw_only=True):
    """How everything stands: X_WB, joints in the order of the motors, X_WO by id.

    What is not named, or is None, is not there.
    """

    base: Flat
    q: tuple[float, ...]
    objects: Mapping[str, Flat | None]
    people: Mapping[str, Flat | None]


class Studio(Closing, Protocol):
    """A context manager in which pictures are taken."""

    @property
    def by(self) -> str:
        """What renders, for people: EGL or rays."""
        ...

    def shoot(self, standing: Standing, *, at_m: tuple[float, float]) -> Image:
        """One picture, which looks at a point of the floor."""
        ...


class RobotCamera(Closing, Protocol):
    """The robot's own camera in a simulation, with the flaws of its reality; a context manager."""

    @property
    def by(self) -> str:
        """What renders, for people: EGL or rays."""
        ...

    def take(self, stamp_s: float) -> RgbdImage:
        """A picture as everything is now; nothing that is simulated notices."""
        ...

    def X_WC(self) -> SE3:
        """Where it truly is, for who looks at pictures of a robot that does not stand up yet."""
        ...
