"""What drivers may be plugged into, and the plant of a simulation as they see it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from robot.bus.bus import Bus
from robot.clock import Clock
from robot.drivers.body_sample import BodySample
from robot.drivers.motor_bus import MotorCommand
from robot.errors import DriverError
from robot.model.description import RobotDescription


class SimulatedPlant(Protocol):
    """The body of a simulation: in this process, or in another one over shared memory.

    All its drivers share it: what they read in one period is of one instant.
    """

    def open(self) -> None:
        """Reach it; once more for every driver. Raises DriverError if it is not there."""
        ...

    def close(self) -> None:
        """Let go of it, as often as it was opened."""
        ...

    def claim(self, driver: object) -> bool:
        """Let this driver alone command the motors; False while another one does."""
        ...

    def release(self, driver: object) -> None:
        """Let another driver command, if this one did."""
        ...

    @property
    def sample(self) -> BodySample:
        """The newest there is. Raises DriverError if the plant went away."""
        ...

    def read(self) -> BodySample:
        """The next one, waited for at most one period; else the last again, its motors aged.

        Raises:
            DriverError: if the plant went away.
        """
        ...

    def write(self, command: MotorCommand) -> MotorCommand:
        """Command every motor; raises DriverError if that cannot be sent."""
        ...


@dataclass(frozen=True, kw_only=True)
class Wiring:
    """Where a process's drivers find what they need; a driver takes its part and no more.

    Attributes:
        robot: the description, which says what is built in, where, and how it is connected.
        clock: of the process, for stamps and timeouts.
        bus: of the process; a simulated plant sends over it what is not urgent.
        plant: the simulated plant, where this process may reach one.
        emulated: folder of the sockets by which that plant emulates buses, where it does.
        owner: folder of the memory of the process that owns the motors' buses, where one does.
    """

    robot: RobotDescription
    clock: Clock
    bus: Bus
    plant: SimulatedPlant | None = None
    emulated: Path | None = None
    owner: Path | None = None

    def simulated_plant(self) -> SimulatedPlant:
        """The simulated plant. Raises DriverError if there is none."""
        if self.plant is None:
            raise DriverError("a simulated driver wants a simulated plant, and there is none")
        return self.plant
