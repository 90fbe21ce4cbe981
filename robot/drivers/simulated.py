"""The motors of a simulated plant in the same process."""

from __future__ import annotations

from typing import Protocol, Self

from robot.closing import Closing
from robot.drivers.motors import MotorCommand, MotorState
from robot.errors import DriverError


class MotorPlant(Protocol):
    """What this driver wants of a plant: the plant's end of the motor bus."""

    def read(self) -> MotorState:
        """Measure now."""
        ...

    def write(self, command: MotorCommand) -> MotorCommand:
        """Command every motor; raises DriverError if that cannot be sent."""
        ...


class SimulatedMotors(Closing):
    """A `MotorBus` straight onto a plant object; the plant's firmware checks every command."""

    def __init__(self, plant: MotorPlant) -> None:
        self._plant = plant
        self._open = False
        self._count = 0

    def __enter__(self) -> Self:
        """Open: count the motors."""
        self._count = len(self._plant.read().q)
        self._open = True
        return self

    def close(self) -> None:
        """Damp every motor."""
        if self._open:
            self._open = False
            stamp_s = self._plant.read().stamp_s
            self._plant.write(MotorCommand.damping(self._count, stamp_s))

    def read(self) -> MotorState:
        """The state now. Raises DriverError if the driver is not open."""
        if not self._open:
            raise DriverError("the motors are not open")
        return self._plant.read()

    def write(self, command: MotorCommand) -> MotorCommand:
        """Send a command; returns what the packets carried. Raises DriverError on bad values."""
        if not self._open:
            raise DriverError("the motors are not open")
        return self._plant.write(command)
