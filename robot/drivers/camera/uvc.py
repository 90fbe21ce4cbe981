"""A webcam (UVC, through V4L2), or a film or numbered pictures in its place: colours, no depth.

Which one stands in `uvc.yaml` beside the robot's description:

    device: /dev/video0      # or film.mp4, or frames/%04d.png, beside this file
    rate_hz: 30              # of a film or of numbered pictures; a device has its own

Focal length and centre are nominal, from the description's field of view.
"""

from __future__ import annotations

import math
import threading
from collections import deque
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Protocol, Self

import msgspec

from robot import config
from robot import quantities as q
from robot.clock import Clock
from robot.closing import Closing
from robot.drivers.camera.capture import Capture, Pixels
from robot.drivers.sensor_source import SensorSource
from robot.drivers.wiring import Wiring
from robot.errors import DriverError
from robot.messages import RgbdImage
from robot.model.description import Camera

SETTINGS = "uvc.yaml"
KEPT = 4
"""Pictures that wait for who reads; older ones are dropped."""
PATIENCE_S = 1.0
"""How long closing waits for a device that does not answer."""


class Settings(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The file beside the description."""

    device: str
    rate_hz: q.Rate = 30.0


class Opened(Protocol):
    """What `Capture` is."""

    is_device: bool

    def read(self) -> Pixels | None:
        """The next picture, waited for; None: the device is gone."""
        ...

    def close(self) -> None:
        """Let go of it."""
        ...


class UvcCamera(Closing):
    """A `SensorSource` whose device is listened to by a thread."""

    def __init__(
        self, settings: Settings, camera: Camera, clock: Clock, *, opens: Callable[[], Opened]
    ) -> None:
        """Know the device; nothing is opened."""
        self.frame, self.calibration = camera.site, camera
        self._settings, self._clock, self._opens = settings, clock, opens
        self._came: deque[RgbdImage] = deque(maxlen=KEPT)
        self._stop = threading.Event()
        self._thread: threading.Thread | None = None
        self._gone = False

    def __enter__(self) -> Self:
        """Open it, and listen. Raises DriverError if it is not there."""
        capture = self._opens()
        self._came.clear()
        self._stop, self._gone = threading.Event(), False
        self._thread = threading.Thread(
            target=self._listen, args=(capture, self._stop), name="uvc", daemon=True
        )
        self._thread.start()
        return self

    def read(self) -> Sequence[RgbdImage]:
        """What came since the last call. Raises DriverError if it is not open, or unplugged."""
        if self._thread is None:
            raise DriverError("the camera is not open")
        gone = self._gone  # before the pictures: the last of them came before that
        came: list[RgbdImage] = []
        while self._came:
            came.append(self._came.popleft())
        if gone and not came:
            raise DriverError(f"the camera {self._settings.device} was unplugged")
        return came

    def close(self) -> None:
        """Listen no more."""
        self._stop.set()
        if self._thread is not None:
            self._thread.join(PATIENCE_S)
            self._thread = None

    def image(self, pixels: Pixels, stamp_s: float) -> RgbdImage:
        """A picture as a message."""
        height, width = pixels.shape[:2]
        focal_px = height / 2 / math.tan(self.calibration.fovy_rad / 2)
        return RgbdImage(
            stamp_s=stamp_s,
            width=width,
            height=height,
            focal_px=(focal_px, focal_px),
            centre_px=((width - 1) / 2, (height - 1) / 2),
            frame=self.frame,
            colours=pixels.tobytes(),
            source="sensor",
        )

    def _listen(self, capture: Opened, stop: threading.Event) -> None:
        """Take pictures until the device is gone or nobody wants them any more."""
        try:
            while not stop.is_set():
                pixels = capture.read()
                if pixels is None:
                    self._gone = True
                    return
                self._came.append(self.image(pixels, self._clock.now_s()))
                if not capture.is_device:
                    stop.wait(1.0 / self._settings.rate_hz)
        finally:
            capture.close()


def make(wiring: Wiring) -> SensorSource[RgbdImage, Camera]:
    """The camera that the file beside the description names.

    Raises:
        ConfigError: the file is not there, or says what cannot be meant.
    """
    path = wiring.robot.path().with_name(SETTINGS)
    settings = config.load(path, Settings)
    camera = wiring.robot.sensors.camera
    picture = camera.pictures()

    def opens() -> Capture:
        device = settings.device
        if not device.startswith("/"):
            device = str(Path(path.parent) / device)
        return Capture(device, width=picture.width, height=picture.height)

    return UvcCamera(settings, camera, wiring.clock, opens=opens)
