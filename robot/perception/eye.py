"""Looks through the camera: publishes its pictures, and says what is wrong with it.

No other part of perception reads them yet.
"""

from __future__ import annotations

from typing import Self

from robot.bus import topics
from robot.closing import Closing
from robot.drivers.registry import RGBD
from robot.drivers.wiring import Wiring
from robot.errors import DriverError
from robot.perception.album import Album
from robot.perception.camera_watch import CameraWatch

SAY_S = 0.5
"""How often it is said how the camera is, besides when that changes."""
AGAIN_S = 2.0
"""How often a camera that is not there is looked for."""


class Eye(Closing):
    """The camera at work; one that is not there ends nothing, and is looked for again."""

    def __init__(self, wiring: Wiring, *, album: Album | None = None) -> None:
        """Make the driver; nothing is opened.

        Args:
            wiring: for the driver.
            album: where pictures are kept for people to look at; None: nowhere.

        Raises:
            ConfigError: if the description names a driver that there is not.
        """
        self._bus, self._clock = wiring.bus, wiring.clock
        self._source = RGBD.make(wiring)
        self._album = album
        self._rate_hz = wiring.robot.sensors.camera.pictures().rate_hz
        self._watch = CameraWatch(rate_hz=self._rate_hz, start_s=self._clock.now_s())
        self._is_open = False
        self._again_s = 0.0
        self._said, self._said_s = "", -SAY_S

    def __enter__(self) -> Self:
        """Open the camera, if it is there."""
        now_s = self._clock.now_s()
        self._watch = CameraWatch(rate_hz=self._rate_hz, start_s=now_s)
        self._open(now_s)
        if self._album is not None:
            self._album.__enter__()
        return self

    def step(self) -> None:
        """Pass on what came, and say how the camera is."""
        now_s = self._clock.now_s()
        if not self._is_open and now_s >= self._again_s:
            self._open(now_s)
        if self._is_open:
            self._relay(now_s)
        state = self._watch.state(now_s)
        if state.code != self._said or now_s - self._said_s >= SAY_S:
            self._said, self._said_s = state.code, now_s
            self._bus.publish(topics.CAMERA_STATE, state)

    def close(self) -> None:
        """Let go of the camera."""
        self._let_go()
        if self._album is not None:
            self._album.close()

    def _let_go(self) -> None:
        if self._is_open:
            self._is_open = False
            self._source.close()

    def _open(self, now_s: float) -> None:
        try:
            self._source.__enter__()
            self._is_open = True
        except DriverError as error:
            self._lose(error, now_s)

    def _relay(self, now_s: float) -> None:
        try:
            came = self._source.read()
        except DriverError as error:
            self._lose(error, now_s)
            return
        for image in came:
            self._watch.see(image, now_s)
            if self._album is not None:
                self._album.show(image)
            self._bus.publish(topics.RGBD, image)

    def _lose(self, error: DriverError, now_s: float) -> None:
        self._let_go()
        self._watch.lose(str(error))
        self._again_s = now_s + AGAIN_S
