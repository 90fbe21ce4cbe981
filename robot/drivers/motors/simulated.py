"""The motors of a simulated plant."""

from __future__ import annotations

from typing import Self

from robot.closing import Closing
from robot.drivers.motor_bus import MIT_MODE, MotorBus, MotorCommand, MotorState
from robot.drivers.wiring import SimulatedPlant, Wiring
from robot.errors import DriverError


def make(wiring: Wiring) -> MotorBus:
    """The simulated motors. Raises DriverError if there is no simulated plant."""
    return SimulatedMotors(wiring.simulated_plant())


class SimulatedMotors(Closing):
    """A `MotorBus` onto a plant; the plant's firmware checks every command."""

    capabilities = MIT_MODE

    def __init__(self, plant: SimulatedPlant) -> None:
        self._plant = plant
        self._open = False
        self._last: MotorState | None = None

    def __enter__(self) -> Self:
        """Open, and wait for a first state. Raises DriverError if there is no plant."""
        self._plant.open()
        self._open = True
        self.read()
        return self

    def close(self) -> None:
        """Damp every motor, if it is this driver that commands them, and let go of them."""
        if not self._open:
            return
        try:
            if self._last is not None and self.claim():
                damping = MotorCommand.damping(len(self._last.q), self._last.stamp_s)
                self._plant.write(damping)
        finally:
            self._plant.release(self)
            self._plant.close()
            self._open = False

    def claim(self) -> bool:
        """Become the one that commands the motors; False while another one is."""
        self._check_open()
        return self._plant.claim(self)

    def read(self) -> MotorState:
        """The next state. Raises DriverError if the driver is not open, or the plant went away."""
        self._check_open()
        self._last = self._plant.read().motors
        return self._last

    def write(self, command: MotorCommand) -> MotorCommand:
        """Send a command; returns what the packets carried. Raises DriverError on bad values."""
        if not self.claim():
            raise DriverError("another controller commands the motors")
        return self._plant.write(command)

    def _check_open(self) -> None:
        if not self._open:
            raise DriverError("the motors are not open")
