"""A webcam (UVC, through V4L2), or a film or numbered pictures in its place: colours, no depth.

Which one stands in `uvc.yaml` beside the robot's description:

    device: /dev/video0      # or film.mp4, or frames/%04d.png, beside this file
    rate_hz: 30              # of a film or of numbered pictures; a device has its own

That file may be a stranger's. What it names under `/dev` is opened where the user's own file lets
robots open it (`robot.files.users_own`); all else is an ordinary file inside the robot's folder.

Focal length and centre are nominal, from the description's field of view.
"""

from __future__ import annotations

import math
import threading
from collections import deque
from collections.abc import Callable, Sequence
from typing import Protocol, Self

import msgspec

from robot.clock import Clock
from robot.closing import Closing
from robot.drivers.camera.capture import Capture, Pixels
from robot.drivers.camera.numbered import NumberedPictures
from robot.drivers.sensor_source import SensorSource
from robot.drivers.wiring import Wiring
from robot.errors import DriverError
from robot.files import config, users_own
from robot.files import quantities as q
from robot.files.ordinary_files import is_within
from robot.messages import RgbdImage
from robot.model.description import Camera

SETTINGS = "uvc.yaml"
KEPT = 4
"""Pictures that wait for who reads; older ones are dropped."""
PATIENCE_S = 1.0
"""How long closing waits for a device that does not answer."""
OPENING_S = 10.0
"""How long a device may take until it is open."""


class Settings(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The file beside the description."""

    device: str
    rate_hz: q.Rate = 30.0


class Opened(Protocol):
    """What `Capture` is."""

    def read(self) -> Pixels | None:
        """The next picture, waited for; None: the device is gone. Raises DriverError."""
        ...

    def close(self) -> None:
        """Let go of it."""
        ...


class UvcCamera(Closing):
    """A `SensorSource` whose device is opened and listened to by a thread."""

    def __init__(
        self, settings: Settings, camera: Camera, clock: Clock, *, opens: Callable[[], Opened]
    ) -> None:
        """Know the device; nothing is opened."""
        self.frame, self.calibration = camera.site, camera
        self._settings, self._clock, self._opens = settings, clock, opens
        self._listening: _Listening | None = None
        self._began_s, self._is_closed = 0.0, True

    def __enter__(self) -> Self:
        """Begin to open it, and listen: `read` tells of one that is not there.

        Raises:
            DriverError: it hangs since it was opened last.
        """
        if self._listening is not None and self._listening.hangs:
            raise self._silent()
        self._listening = _Listening(
            self._settings.device, opens=self._opens, heard=self._heard, pause_s=self._pause_s
        )
        self._began_s = self._clock.now_s()
        self._is_closed = False
        return self

    def read(self) -> Sequence[RgbdImage]:
        """What came since the last call.

        Raises:
            DriverError: it is not open, is not there, does not answer, or was unplugged.
        """
        listening = self._listening
        if listening is None or self._is_closed:
            raise DriverError("the camera is not open")
        failure = listening.failure  # before the pictures: the last of them came before that
        came: list[RgbdImage] = []
        while listening.came:
            came.append(listening.came.popleft())
        if failure is not None and not came:
            raise failure
        if listening.is_opening and self._clock.now_s() - self._began_s > OPENING_S:
            listening.give_up()
            raise self._silent()
        return came

    def close(self) -> None:
        """Listen no more."""
        self._is_closed = True
        if self._listening is not None:
            self._listening.end()

    @property
    def _pause_s(self) -> float:
        """Between two pictures: a device has a pace of its own."""
        return 0.0 if _is_device(self._settings) else 1.0 / self._settings.rate_hz

    def _heard(self, pixels: Pixels) -> RgbdImage:
        return self.image(pixels, self._clock.now_s())

    def _silent(self) -> DriverError:
        return DriverError(f"the camera {self._settings.device} does not answer")

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


class _Listening:
    """A thread that opens the device and takes pictures, until it is gone or nobody wants them.

    Attributes:
        came: pictures that wait for who reads.
        failure: why no more will come.
        is_opening: whether the device is not open yet.
    """

    def __init__(
        self,
        device: str,
        *,
        opens: Callable[[], Opened],
        heard: Callable[[Pixels], RgbdImage],
        pause_s: float,
    ) -> None:
        """Start it."""
        self.came: deque[RgbdImage] = deque(maxlen=KEPT)
        self.failure: DriverError | None = None
        self.is_opening = True
        self._device, self._opens = device, opens
        self._heard, self._pause_s = heard, pause_s
        self._stop = threading.Event()
        self._given_up = False
        self._thread = threading.Thread(target=self._listen, name="uvc", daemon=True)
        self._thread.start()

    @property
    def hangs(self) -> bool:
        """Whether it goes on, though nobody waits for it any more."""
        return self._given_up and self._thread.is_alive()

    def give_up(self) -> None:
        """Wait for it no more."""
        self._given_up = True

    def end(self) -> None:
        """Want no more pictures."""
        self._stop.set()
        if not self._given_up:
            self._thread.join(PATIENCE_S)
            self._given_up = True

    def _listen(self) -> None:
        try:
            capture = self._opens()
            try:
                self.is_opening = False
                while not self._stop.is_set():
                    pixels = capture.read()
                    if pixels is None:
                        self.failure = DriverError(f"the camera {self._device} was unplugged")
                        return
                    self.came.append(self._heard(pixels))
                    self._stop.wait(self._pause_s)
            finally:
                capture.close()
        except DriverError as error:
            self.failure = error
        except Exception as error:  # of a broken film OpenCV raises what it happens to
            self.failure = DriverError(f"the camera {self._device} cannot be read: {error}")
        finally:
            self.is_opening = False


def _is_device(settings: Settings) -> bool:
    return settings.device.startswith("/dev/")


def make(wiring: Wiring) -> SensorSource[RgbdImage, Camera]:
    """The camera that the file beside the description names.

    Raises:
        ConfigError: the file is not there, or says what cannot be meant.
    """
    path = wiring.robot.path().with_name(SETTINGS)
    settings = config.load(path, Settings)
    camera = wiring.robot.sensors.camera
    picture = camera.pictures()

    def opens() -> Opened:
        if _is_device(settings):
            users_own.check_device(settings.device)
            return Capture.device(settings.device, width=picture.width, height=picture.height)
        place = path.parent / settings.device
        if "\0" in settings.device or not is_within(path.parent, place):
            raise DriverError(f"the camera {settings.device!r} is outside the robot's folder")
        if "%" in place.name:
            return NumberedPictures(place, folder=path.parent)
        return Capture.film(place)

    return UvcCamera(settings, camera, wiring.clock, opens=opens)
