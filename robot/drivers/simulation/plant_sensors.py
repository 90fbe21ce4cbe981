"""Sensors of a simulated plant.

What the controller needs in every period comes with the motors' states, the rest as messages; both
in the same way in `fast` and `live`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Generic, Self, TypeVar

from robot.bus.bus import Bus, Subscription
from robot.bus.topics import Topic
from robot.closing import Closing
from robot.drivers.body_sample import BodySample
from robot.drivers.wiring import SimulatedPlant
from robot.errors import DriverError

R = TypeVar("R")
C = TypeVar("C")
CLOSED = "the sensor is not open"


def emulated(topic: Topic[R]) -> Topic[R]:
    """Where a plant sends what a sensor's driver is to publish on `topic`."""
    return replace(topic, name=f"sim/{topic.name}", source="plant", silence=None)


class BusSensor(Closing, Generic[R, C]):
    """A sensor whose readings the plant sends as messages."""

    def __init__(self, bus: Bus, topic: Topic[R], *, frame: str, calibration: C) -> None:
        self.frame = frame
        self.calibration = calibration
        self._bus, self._topic = bus, emulated(topic)
        self._messages: Subscription[R] | None = None

    def __enter__(self) -> Self:
        """Listen."""
        self._messages = self._bus.subscribe(self._topic)
        return self

    def read(self) -> Sequence[R]:
        """What came since the last call."""
        if self._messages is None:
            raise DriverError(CLOSED)
        return self._messages.take()

    def close(self) -> None:
        """Listen no more."""
        self._messages = None


class PlantSensor(Closing, Generic[R, C]):
    """A sensor inside the body, measured together with the motors; only the newest is there."""

    def __init__(
        self, plant: SimulatedPlant, of: Callable[[BodySample], R], *, frame: str, calibration: C
    ) -> None:
        self.frame = frame
        self.calibration = calibration
        self._plant, self._of = plant, of
        self._open = False
        self._last: R | None = None

    def __enter__(self) -> Self:
        """Reach the plant. Raises DriverError if it is not there."""
        self._plant.open()
        self._open = True
        return self

    def read(self) -> Sequence[R]:
        """The newest reading, once."""
        if not self._open:
            raise DriverError(CLOSED)
        reading = self._of(self._plant.sample)
        if reading is self._last:
            return ()
        self._last = reading
        return (reading,)

    def close(self) -> None:
        """Let go of the plant."""
        if self._open:
            self._open, self._last = False, None
            self._plant.close()
