# pyright: basic
# OpenCV is optional (extra: vision), and all that drivers of cameras ask of it is in this file.
"""A camera or a film, as OpenCV opens them. A film may be a stranger's; a device is one's own."""

from __future__ import annotations

import os
import stat
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from robot.errors import DriverError
from robot.files.ordinary_files import open_ordinary

INSTALL = "pip install 'humanoid-executive[vision]'"
Pixels = NDArray[np.uint8]

MOST_FILM_BYTES = 2_000_000_000
MOST_PIXELS = 4_000_000
"""Of one picture: decoding takes ten times as many bytes, and more with each thread."""
HEAD_BYTES = 12


def _is_film(head: bytes) -> bool:
    """Whether a file begins as a film that holds all of itself does (MP4, Matroska, AVI).

    Anything else FFmpeg might take for a play list, which names files and addresses.
    """
    riff = head[:4] == b"RIFF" and head[8:12] == b"AVI "
    return head[4:8] == b"ftyp" or head[:4] == b"\x1aE\xdf\xa3" or riff


class Capture:
    """One device or film, open."""

    def __init__(self, capture: Any) -> None:
        """What OpenCV has opened."""
        self._capture = capture
        self._film: Any = None

    @classmethod
    def device(cls, device: str, *, width: int, height: int) -> Capture:
        """Open a camera, asking it for pictures of a size (it may have others).

        Args:
            device: `/dev/video0`, which the user lets robots open (`robot.files.users_own`).
            width: of the pictures [px].
            height: of the pictures [px].

        Raises:
            DriverError: it cannot be opened, or OpenCV is not installed, with the cure.
        """
        cv2 = _opencv(device)
        try:
            is_camera = stat.S_ISCHR(Path(device).stat().st_mode)
        except (OSError, ValueError):
            is_camera = False
        capture = cv2.VideoCapture(device, cv2.CAP_V4L2) if is_camera else None
        if capture is None or not capture.isOpened():
            raise DriverError(f"there is no camera {device}: is it plugged in?")
        capture.set(cv2.CAP_PROP_FRAME_WIDTH, width)
        capture.set(cv2.CAP_PROP_FRAME_HEIGHT, height)
        capture.set(cv2.CAP_PROP_BUFFERSIZE, 1)
        return cls(capture)

    @classmethod
    def film(cls, path: Path) -> Capture:
        """Open a film.

        Raises:
            DriverError: it is no film, or too large, or OpenCV is not installed, with the cure.
        """
        cv2 = _opencv(str(path))
        try:
            film = open_ordinary(path)
        except (OSError, ValueError) as error:
            raise DriverError(f"the film {path} cannot be read: {_cause(error)}") from None
        try:
            if os.fstat(film.fileno()).st_size > MOST_FILM_BYTES:
                raise DriverError(f"the film {path} is larger than {MOST_FILM_BYTES / 1e9:g} GB")
            if not _is_film(film.read(HEAD_BYTES)):
                raise DriverError(f"{path} is no film: known are MP4, Matroska and AVI")
            # What was looked at, whatever lies at that path by now; FFmpeg reads it from its start.
            place = f"/proc/self/fd/{film.fileno()}"
            one_thread = [cv2.CAP_PROP_N_THREADS, 1]
            opened = cls(cv2.VideoCapture(place, cv2.CAP_FFMPEG, one_thread))
            opened._film = film
            opened._check_size(cv2, path)
        except BaseException:
            film.close()
            raise
        return opened

    def _check_size(self, cv2: Any, path: Path) -> None:
        if not self._capture.isOpened():
            raise DriverError(f"the film {path} is broken")
        width, height = (
            self._capture.get(which)
            for which in (cv2.CAP_PROP_FRAME_WIDTH, cv2.CAP_PROP_FRAME_HEIGHT)
        )
        if not 0 < width * height <= MOST_PIXELS:
            self._capture.release()
            most = f"{MOST_PIXELS / 1e6:g} megapixels"
            raise DriverError(f"the pictures of {path} have {width:g} x {height:g}: at most {most}")

    def read(self) -> Pixels | None:
        """The next picture (red, green, blue), waited for; None: there is none any more."""
        is_there, picture = self._capture.read()
        if not is_there or picture is None or picture.ndim != 3:
            return None
        return np.ascontiguousarray(picture[:, :, ::-1], dtype=np.uint8)

    def close(self) -> None:
        """Let go of it."""
        self._capture.release()
        if self._film is not None:
            self._film.close()


def _opencv(device: str) -> Any:
    try:
        import cv2
    except ImportError as error:
        raise DriverError(f"the camera {device} needs OpenCV: {INSTALL}") from error
    return cv2


def _cause(error: Exception) -> str:
    return (isinstance(error, OSError) and error.strerror) or "this is no path"
