"""A new kind of sensor: the temperature of the computer's processor, once a second.

It would stand as it is in robot/drivers/thermometer.py. Its row, in robot/drivers/registry.py, and
in the description of a robot that has one `drivers: {thermometer: linux}`:

    SENSES = (..., Sense("thermometer", {"linux": thermometer.make}, thermometer.COMPUTER))
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Self

from robot.bus.topics import Topic
from robot.clock import Clock
from robot.closing import Closing
from robot.drivers.sensor_source import SensorSource
from robot.drivers.wiring import Wiring
from robot.errors import DriverError
from robot.messages import Message


class ComputerTemperature(Message, frozen=True, kw_only=True):
    """How hot the computer's processor is."""

    temperature_c: float


COMPUTER: Topic[ComputerTemperature] = Topic(
    "computer/temperature", ComputerTemperature, 1.0, "perception"
)
"""Perception opens the sensor, and publishes it here."""

ZONE = Path("/sys/class/thermal/thermal_zone0/temp")
PERIOD_S = 1.0


class Thermometer(Closing):
    """A `SensorSource` of Linux's thermal zone: a file that holds thousandths of a degree."""

    frame = ""
    calibration = None

    def __init__(self, zone: Path, clock: Clock) -> None:
        """Know the file; nothing is opened."""
        self._zone, self._clock = zone, clock
        self._due_s: float | None = None

    def __enter__(self) -> Self:
        """Look whether it is there. Raises DriverError if not."""
        self._measured_c()
        self._due_s = self._clock.now_s()
        return self

    def read(self) -> Sequence[ComputerTemperature]:
        """The temperature, if a second has passed since the last."""
        if self._due_s is None:
            raise DriverError("the thermometer is not open")
        now_s = self._clock.now_s()
        if now_s < self._due_s:
            return ()
        self._due_s = now_s + PERIOD_S
        return (ComputerTemperature(stamp_s=now_s, temperature_c=self._measured_c()),)

    def close(self) -> None:
        """Read no more."""
        self._due_s = None

    def _measured_c(self) -> float:
        try:
            return int(self._zone.read_text()) / 1000.0
        except (OSError, ValueError) as error:
            raise DriverError(f"no thermometer at {self._zone}: {error}") from None


def make(wiring: Wiring) -> SensorSource[ComputerTemperature, None]:
    """The thermometer of this computer."""
    return Thermometer(ZONE, wiring.clock)
