# pyright: basic
# librealsense is optional (extra: realsense), and all that is asked of it is in this file.
"""An Intel RealSense, as its own library opens it: colours, and depth that is laid over them."""

from __future__ import annotations

from importlib import import_module
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from robot.errors import DriverError

INSTALL = "pip install 'humanoid-executive[realsense]'"


class Frame(NamedTuple):
    """One picture: colours (height, width, 3), depth [m] (height, width), 0 for none.

    `taken_s` is by the device's own clock.
    """

    taken_s: float
    colours: NDArray[np.uint8]
    depth_m: NDArray[np.float32]
    exposure_s: float


class Lens(NamedTuple):
    """What its maker measured of the colour camera [px]."""

    focal_px: tuple[float, float]
    centre_px: tuple[float, float]


class RealSense:
    """One device, streaming."""

    def __init__(self, serial: str, *, width: int, height: int, rate_hz: int) -> None:
        """Start it.

        Args:
            serial: of the device; empty: the only one there is.
            width: of both pictures [px].
            height: of both pictures [px].
            rate_hz: of both; the device knows 6, 15, 30, 60 and 90.

        Raises:
            DriverError: it is not there, cannot stream that, or the library is not installed.
        """
        try:
            rs: Any = import_module("pyrealsense2")
        except ImportError as error:
            raise DriverError(f"a RealSense needs its library: {INSTALL}") from error
        self._rs = rs
        config = rs.config()
        if serial:
            config.enable_device(serial)
        config.enable_stream(rs.stream.depth, width, height, rs.format.z16, rate_hz)
        config.enable_stream(rs.stream.color, width, height, rs.format.rgb8, rate_hz)
        self._pipeline: Any = rs.pipeline()
        try:
            profile = self._pipeline.start(config)
        except RuntimeError as error:
            raise DriverError(f"no RealSense {serial or 'at all'}: {error}") from error
        device = profile.get_device()
        self.serial: str = device.get_info(rs.camera_info.serial_number)
        self._metres: float = device.first_depth_sensor().get_depth_scale()
        self._align: Any = rs.align(rs.stream.color)
        found = profile.get_stream(rs.stream.color).as_video_stream_profile().get_intrinsics()
        self.lens = Lens((found.fx, found.fy), (found.ppx, found.ppy))

    def poll(self) -> Frame | None:
        """The next picture, if there is one; never waits. Raises DriverError if it broke off."""
        try:
            frames = self._pipeline.poll_for_frames()
            if not frames or not frames.size():
                return None
            frames = self._align.process(frames)
        except RuntimeError as error:
            raise DriverError(f"the RealSense {self.serial} broke off: {error}") from error
        colour, depth = frames.get_color_frame(), frames.get_depth_frame()
        if not colour or not depth:
            return None
        colours = np.asanyarray(colour.get_data()).astype(np.uint8)
        metres = np.asanyarray(depth.get_data()).astype(np.float32) * np.float32(self._metres)
        taken_s = 1e-3 * colour.get_timestamp()
        return Frame(taken_s, colours, metres, self._exposure_s(colour))

    def is_there(self) -> bool:
        """Whether it is plugged in; a stream that stops says nothing by itself."""
        info = self._rs.camera_info.serial_number
        return any(one.get_info(info) == self.serial for one in self._rs.context().query_devices())

    def close(self) -> None:
        """Stop it."""
        try:
            self._pipeline.stop()
        except RuntimeError:  # it was not running any more
            return

    def _exposure_s(self, colour: Any) -> float:
        kind = self._rs.frame_metadata_value.actual_exposure
        known = colour.supports_frame_metadata(kind)
        return 1e-6 * colour.get_frame_metadata(kind) if known else 0.0
