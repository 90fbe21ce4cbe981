"""An Intel RealSense (D400 series): colours with depth over them, focal lengths as its maker says.

Which one, and how, stands in `realsense.yaml` beside the robot's description; all of it may be left
out:

    serial: "123456789012"   # default: the only one there is
    width: 640
    height: 480
    rate_hz: 30
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Protocol, Self

import msgspec

from robot.clock import Clock
from robot.closing import Closing
from robot.drivers.camera.librealsense import Frame, Lens, RealSense
from robot.drivers.sensor_source import SensorSource
from robot.drivers.wiring import Wiring
from robot.errors import DriverError
from robot.files import config, users_own
from robot.files import quantities as q
from robot.messages import RgbdImage
from robot.model.description import Camera

SETTINGS = "realsense.yaml"
SILENCE_S = 1.0
"""After so long without a picture it is asked whether the device is there still."""
MOST = 8
"""Pictures of one call."""


class Settings(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The file beside the description."""

    serial: str = ""
    width: q.Pixels = 640
    height: q.Pixels = 480
    rate_hz: q.Quota = 30


class Opened(Protocol):
    """What `RealSense` is."""

    @property
    def serial(self) -> str:
        """Of the device."""
        ...

    @property
    def lens(self) -> Lens:
        """Of the colour camera."""
        ...

    def poll(self) -> Frame | None:
        """The next picture, if there is one; never waits."""
        ...

    def is_there(self) -> bool:
        """Whether it is plugged in."""
        ...

    def close(self) -> None:
        """Stop it."""
        ...


class RealSenseCamera(Closing):
    """A `SensorSource` that asks the library's own queue."""

    def __init__(self, camera: Camera, clock: Clock, *, opens: Callable[[], Opened]) -> None:
        """Know the device; nothing is opened."""
        self.frame, self.calibration = camera.site, camera
        self._clock, self._opens = clock, opens
        self._device: Opened | None = None
        self._heard_s = 0.0

    def __enter__(self) -> Self:
        """Start it. Raises DriverError if it is not there."""
        self._device = self._opens()
        self._heard_s = self._clock.now_s()
        return self

    def read(self) -> Sequence[RgbdImage]:
        """What came since the last call. Raises DriverError if it is not open, or unplugged."""
        device = self._device
        if device is None:
            raise DriverError("the camera is not open")
        now_s = self._clock.now_s()
        frames: list[Frame] = []
        while len(frames) < MOST and (frame := device.poll()) is not None:
            frames.append(frame)
        if frames:
            self._heard_s = now_s
        elif now_s - self._heard_s > SILENCE_S:
            self._heard_s = now_s
            if not device.is_there():
                raise DriverError(f"the RealSense {device.serial} was unplugged")
        return [
            self.image(frame, device.lens, now_s - (frames[-1].taken_s - frame.taken_s))
            for frame in frames
        ]

    def close(self) -> None:
        """Stop it."""
        if self._device is not None:
            self._device.close()
            self._device = None

    def image(self, frame: Frame, lens: Lens, stamp_s: float) -> RgbdImage:
        """A picture as a message; the newest of a call is stamped when it came."""
        height, width = frame.colours.shape[:2]
        return RgbdImage(
            stamp_s=stamp_s,
            width=width,
            height=height,
            focal_px=lens.focal_px,
            centre_px=lens.centre_px,
            frame=self.frame,
            colours=frame.colours.tobytes(),
            depth_m=frame.depth_m.tobytes(),
            exposure_s=frame.exposure_s,
            source="sensor",
        )


def make(wiring: Wiring) -> SensorSource[RgbdImage, Camera]:
    """The camera that the file beside the description names, or the only one there is.

    Raises:
        ConfigError: the file says what cannot be meant.
    """
    path = wiring.robot.path().with_name(SETTINGS)
    settings = config.load(path, Settings) if path.exists() else Settings()

    def opens() -> RealSense:
        users_own.check_device("realsense")
        return RealSense(
            settings.serial,
            width=settings.width,
            height=settings.height,
            rate_hz=settings.rate_hz,
        )

    return RealSenseCamera(wiring.robot.sensors.camera, wiring.clock, opens=opens)
