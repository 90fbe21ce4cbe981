"""A driver of a sensor: a lidar whose turns were recorded, given again when their time has come.

It would be `robot/drivers/lidar/recorded.py`. The recording is `lidar.jsonl` beside the robot's
description, a `LidarScan` a line, stamped by the clock of the process that reads it again.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from pathlib import Path
from typing import Self

import msgspec

from robot.clock import Clock
from robot.closing import Closing
from robot.drivers.sensor_source import SensorSource
from robot.drivers.wiring import Wiring
from robot.errors import DriverError
from robot.messages import LidarScan
from robot.model.description import Lidar


class RecordedLidar(Closing):
    """A `SensorSource` out of a file."""

    def __init__(self, path: Path, lidar: Lidar, clock: Clock) -> None:
        """Know where the recording lies; nothing is opened."""
        self.frame, self.calibration = lidar.site, lidar
        self._path, self._clock = path, clock
        self._ahead: deque[LidarScan] | None = None

    def __enter__(self) -> Self:
        """Read the recording. Raises DriverError if it is not there, or is none."""
        try:
            scans = msgspec.json.Decoder(LidarScan).decode_lines(self._path.read_bytes())
        except (OSError, msgspec.DecodeError) as error:
            raise DriverError(f"{self._path} is no recording of a lidar: {error}") from None
        self._ahead = deque(scans)
        return self

    def read(self) -> Sequence[LidarScan]:
        """The turns whose time has come since the last call, oldest first."""
        if self._ahead is None:
            raise DriverError("the lidar is not open")
        came: list[LidarScan] = []
        while self._ahead and self._ahead[0].stamp_s <= self._clock.now_s():
            came.append(self._ahead.popleft())
        return came

    def close(self) -> None:
        """Forget the recording."""
        self._ahead = None


def make(wiring: Wiring) -> SensorSource[LidarScan, Lidar]:
    """The lidar of the recording beside the description."""
    path = wiring.robot.path().with_name("lidar.jsonl")
    return RecordedLidar(path, wiring.robot.sensors.lidar, wiring.clock)
