"""What sensors tell, and the oracles that stand in for some."""

from __future__ import annotations

import msgspec
import numpy as np
from numpy.typing import NDArray

from robot.messages.basics import Message, Source
from robot.se3 import SE3, Array


class DepthImage(Message, frozen=True, kw_only=True):
    """Depth along the optical axis [m], float32 row-major bytes, 0 where nothing was hit."""

    width: int
    height: int
    fovy_rad: float
    depth_m: bytes
    source: Source = "emulated"

    def pixels(self) -> NDArray[np.float32]:
        """Depth [m], shape (height, width), not to be written to."""
        return np.frombuffer(self.depth_m, np.float32).reshape(self.height, self.width)


class RgbdImage(Message, frozen=True, kw_only=True):
    """One picture of a camera: colours, and depth where the device has it, pixel for pixel.

    The camera's frame C is the site `frame` of the body at `stamp_s`, as OpenCV has it: x right, y
    down, z forward. A pixel (u, v), whose middle has whole numbers, looks along
    ((u - cx) / fx, (v - cy) / fy, 1) in C.

    Attributes:
        width, height: of both, in pixels.
        focal_px: fx, fy.
        centre_px: cx, cy.
        frame: the site of the body that is C.
        colours: red, green, blue of 0 to 255, row by row.
        depth_m: float32 along z of C [m], row by row; 0: nothing was measured. Empty: no depth.
        exposure_s: how long light was gathered, until `stamp_s`.
    """

    width: int
    height: int
    focal_px: tuple[float, float]
    centre_px: tuple[float, float]
    frame: str
    colours: bytes
    depth_m: bytes = b""
    exposure_s: float = 0.0
    source: Source = "emulated"

    def picture(self) -> NDArray[np.uint8]:
        """Red, green, blue, shape (height, width, 3), not to be written to."""
        return np.frombuffer(self.colours, np.uint8).reshape(self.height, self.width, 3)

    def depth(self) -> NDArray[np.float32] | None:
        """Depth [m], shape (height, width), not to be written to; None: the device has none."""
        if not self.depth_m:
            return None
        return np.frombuffer(self.depth_m, np.float32).reshape(self.height, self.width)

    def matrix(self) -> Array:
        """The camera matrix K [px], shape (3, 3)."""
        (fx, fy), (cx, cy) = self.focal_px, self.centre_px
        return np.array([[fx, 0.0, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]])


class CameraState(Message, frozen=True, kw_only=True):
    """How the camera of `RgbdImage` is: what is wrong with it is a code of `robot.failures`.

    Attributes:
        code: empty while all is well.
        cause: a sentence, for people.
    """

    code: str = ""
    cause: str = ""


class LidarScan(Message, frozen=True, kw_only=True):
    """Ranges [m] of a planar scan in the lidar's frame, counter-clockwise from -pi; inf: no hit."""

    angle_min_rad: float
    angle_step_rad: float
    ranges_m: tuple[float, ...]
    source: Source = "emulated"


class PowerState(Message, frozen=True, kw_only=True):
    """The battery: charge as a part of the whole (0 to 1), and what is drawn [W]."""

    charge: float
    power_w: float
    source: Source


class PoseFix(Message, frozen=True, kw_only=True):
    """Where the base is in the world, absolutely, at the stamp.

    `covariance`, row by row, is of the errors of x, y [m] and heading [rad]; () if it is unknown.
    """

    X_WB: SE3
    source: Source
    covariance: tuple[float, ...] = ()


class Sighting(msgspec.Struct, frozen=True, kw_only=True):
    """One object seen by the head camera."""

    id: str
    X_CO: SE3


class Sightings(Message, frozen=True, kw_only=True):
    """What the head camera sees in one frame; what should be seen and is not is the model's."""

    objects: tuple[Sighting, ...]
    people: tuple[Sighting, ...] = ()
    source: Source = "oracle"
