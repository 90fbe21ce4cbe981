"""Emulated cameras: `Capture` and `RealSense` without a device behind them."""

import queue
import threading
from collections import deque

import numpy as np

from robot.drivers.camera.librealsense import Frame, Lens
from tests.fakes.waiting import HANG_S


class FakeCapture:
    """Gives the pictures that it is shown, each once it is asked for; then it may be unplugged."""

    def __init__(self) -> None:
        self._pictures: queue.Queue[np.ndarray | None] = queue.Queue()
        self._asked = threading.Semaphore(0)
        self.closed = False

    def open(self) -> "FakeCapture":
        self._pictures, self._asked = queue.Queue(), threading.Semaphore(0)
        self.closed = False
        return self

    def show(self, pixels: np.ndarray) -> None:
        """Put a picture before it, and wait until the driver has taken it and asks for the next."""
        assert self._asked.acquire(timeout=HANG_S)
        self._pictures.put(pixels)
        assert self._asked.acquire(timeout=HANG_S)
        self._asked.release()

    def unplug(self) -> None:
        self._pictures.put(None)

    def read(self) -> np.ndarray | None:
        self._asked.release()
        while True:
            try:
                return self._pictures.get(timeout=0.05)
            except queue.Empty:
                if self.closed:
                    return None

    def close(self) -> None:
        self.closed = True


class FakeRealSense:
    """Has a queue of pictures, as the library has."""

    serial = "f0"
    lens = Lens((381.0, 382.0), (319.0, 241.0))

    def __init__(self) -> None:
        self.frames: deque[Frame] = deque()

    def poll(self) -> Frame | None:
        return self.frames.popleft() if self.frames else None

    def is_there(self) -> bool:
        return True

    def close(self) -> None:
        pass
