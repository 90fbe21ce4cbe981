"""Keeps what a camera shows, for people who look on: now and then a picture, in a thread.

The camera is never waited for, nor is the disk: there is room for one picture that waits, and a
newer one takes its place.
"""

from __future__ import annotations

import io
import os
import threading
from pathlib import Path
from typing import Self

from PIL import Image

from robot import shots
from robot.closing import Closing
from robot.messages import RgbdImage
from robot.shots import Shot

EVERY_S = 0.5
"""How often a picture is kept: 20 to 30 kB a second at 320 x 240."""
QUALITY = 75
CLOSE_S = 1.0


class Album(Closing):
    """A file that pictures are added to; a context manager.

    Attributes:
        kept: how many were written.
        passed_over: how many were due and had to make way for a newer one.
    """

    def __init__(self, path: Path, *, most_bytes: int = shots.MOST_BYTES) -> None:
        """Open nothing yet.

        Args:
            path: of the file; it is not shortened.
            most_bytes: how long it may get.
        """
        self.kept = self.passed_over = 0
        self._path, self._most = path, most_bytes
        self._due_s = float("-inf")
        self._next: RgbdImage | None = None
        self._news = threading.Condition()
        self._closing = False
        self._thread = threading.Thread(target=self._work, name="album", daemon=True)

    def __enter__(self) -> Self:
        """Begin to write what is shown."""
        self._thread.start()
        return self

    def show(self, image: RgbdImage) -> None:
        """Keep a picture if it is time for one; takes microseconds, whatever the disk does."""
        if image.stamp_s < self._due_s:
            return
        self._due_s = image.stamp_s + EVERY_S - 1e-6
        with self._news:
            self.passed_over += self._next is not None
            self._next = image
            self._news.notify()

    def close(self) -> None:
        """Give the thread `CLOSE_S` for what waits; safe to call twice."""
        with self._news:
            self._closing = True
            self._news.notify()
        if self._thread.ident is not None:
            self._thread.join(CLOSE_S)

    def _work(self) -> None:
        while (image := self._taken()) is not None:
            try:
                self._write(shots.encode(_shot(image)) + b"\n")
            except OSError:  # a full disk stops no camera
                self.passed_over += 1

    def _taken(self) -> RgbdImage | None:
        """The picture that waits, waited for; None when closed."""
        with self._news:
            self._news.wait_for(lambda: self._closing or self._next is not None)
            image, self._next = self._next, None
            return image

    def _write(self, line: bytes) -> None:
        flags = os.O_WRONLY | os.O_CREAT | os.O_APPEND | os.O_NOFOLLOW | os.O_CLOEXEC
        file = os.open(self._path, flags, 0o644)
        try:
            before = os.fstat(file).st_size
            if before + len(line) > self._most:
                return
            if os.write(file, line) < len(line):
                os.ftruncate(file, before)  # half a picture is none
                return
            self.kept += 1
        finally:
            os.close(file)


def _shot(image: RgbdImage) -> Shot:
    data = io.BytesIO()
    Image.fromarray(image.picture()).save(data, "JPEG", quality=QUALITY)
    return Shot(
        t_s=round(image.stamp_s, 3),
        kind="colour",
        type="jpeg",
        data=data.getvalue(),
        width=image.width,
        height=image.height,
        focal_px=image.focal_px,
        centre_px=image.centre_px,
        source=image.source,
    )
