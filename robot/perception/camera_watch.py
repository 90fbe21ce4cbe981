"""Whether pictures can be trusted: a camera that is unplugged, late, frozen, or sees nothing."""

from __future__ import annotations

import zlib

from robot.messages import CameraState, RgbdImage

LATE_PERIODS, LATE_S = 3.0, 0.5
"""A picture is late after so many periods, and seconds at least."""
SAME_PICTURES, SAME_S = 5, 0.4
"""A camera is frozen after so many equal pictures over such a time: grain makes each one new."""
BLACK_MEAN, BLACK_SPREAD = 10.0, 6.0
"""Of 255: a picture that is darker than this, and as even, shows nothing."""
BLACK_PICTURES = 3


class CameraWatch:
    """Told of every picture, and that there are none; time is when they came."""

    def __init__(self, *, rate_hz: float, start_s: float) -> None:
        """Expect pictures at a rate from now on."""
        self._late_s = max(LATE_PERIODS / rate_hz, LATE_S)
        self._came_s = start_s
        self._print: int | None = None
        self._same, self._same_since_s = 0, start_s
        self._black = 0
        self._lost = ""

    def see(self, image: RgbdImage, now_s: float) -> None:
        """A picture came."""
        self._lost = ""
        self._came_s = now_s
        picture = image.picture()
        is_black = float(picture.mean()) < BLACK_MEAN and float(picture.std()) < BLACK_SPREAD
        self._black = self._black + 1 if is_black else 0
        # A simulated picture without grain may well be the same twice.
        fingerprint = zlib.crc32(image.colours) if image.source == "sensor" else None
        if fingerprint is None or fingerprint != self._print:
            self._same, self._same_since_s = 0, now_s
        self._same += 1
        self._print = fingerprint

    def lose(self, cause: str) -> None:
        """The device is not there."""
        self._lost = cause

    def state(self, now_s: float) -> CameraState:
        """How the camera is."""
        code, cause = self._trouble(now_s)
        return CameraState(stamp_s=now_s, code=code, cause=cause)

    def _trouble(self, now_s: float) -> tuple[str, str]:
        if self._lost:
            return "camera_unplugged", self._lost
        if now_s - self._came_s > self._late_s:
            return "camera_late", f"no picture for {now_s - self._came_s:.1f} s"
        if self._black >= BLACK_PICTURES:
            return "camera_black", "the pictures are black: covered, or no light"
        same_s = self._came_s - self._same_since_s
        if self._same >= SAME_PICTURES and same_s >= SAME_S:
            return "camera_frozen", f"the same picture for {same_s:.1f} s"
        return "", ""
