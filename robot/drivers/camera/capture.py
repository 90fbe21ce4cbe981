# pyright: basic
# OpenCV is optional (extra: vision), and all that drivers of cameras ask of it is in this file.
"""A camera, a film, or numbered pictures, as OpenCV opens them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from robot.errors import DriverError

INSTALL = "pip install 'humanoid-executive[vision]'"
Pixels = NDArray[np.uint8]


class Capture:
    """One device or file, open."""

    def __init__(self, device: str, *, width: int, height: int) -> None:
        """Open it, asking a device for pictures of that size (it may have others).

        Args:
            device: `/dev/video0`, a film, or numbered pictures (`frames/%04d.png`).
            width: of the pictures [px].
            height: of the pictures [px].

        Raises:
            DriverError: it cannot be opened, or OpenCV is not installed, with the cure.
        """
        try:
            import cv2
        except ImportError as error:
            raise DriverError(f"the camera {device} needs OpenCV: {INSTALL}") from error
        self.is_device = device.startswith("/dev/")
        backend = cv2.CAP_V4L2 if self.is_device else cv2.CAP_ANY
        self._capture: Any = cv2.VideoCapture(device, backend)
        if not self._capture.isOpened():
            raise DriverError(f"there is no camera {device}: is it plugged in?")
        if self.is_device:
            self._capture.set(cv2.CAP_PROP_FRAME_WIDTH, width)
            self._capture.set(cv2.CAP_PROP_FRAME_HEIGHT, height)
            self._capture.set(cv2.CAP_PROP_BUFFERSIZE, 1)

    def read(self) -> Pixels | None:
        """The next picture (red, green, blue), waited for; None: there is no device any more."""
        is_there, picture = self._capture.read()
        if not is_there or picture is None or picture.ndim != 3:
            return None
        return np.ascontiguousarray(picture[:, :, ::-1], dtype=np.uint8)

    def close(self) -> None:
        """Let go of it."""
        self._capture.release()
