"""Drivers of servos and a plant's emulated ports in one thread: real bytes, and no wall clock."""

from collections.abc import Callable
from pathlib import Path

from robot.clock import SimulatedClock
from robot.drivers.motor_bus import MotorBus
from robot.drivers.motors.can import driver as can_driver
from robot.drivers.motors.can.driver import CanMotors
from robot.drivers.motors.dynamixel.driver import FAMILY, DynamixelMotors
from robot.drivers.motors.dynamixel.ports import SerialPorts
from robot.drivers.motors.servos_and_others import Maps, ServosAndOthers
from sim.plant import Plant
from sim.plant_buses import PlantBuses
from tests.fakes.can_lockstep import Lockstep, LockstepPorts


class ServoLockstep(Lockstep):
    """The plant's time, which goes on while somebody waits for it."""

    def __init__(self, plant: Plant, maps: Maps, folder: Path) -> None:
        self.plant, self.lines = plant, list[str]()
        self.buses = PlantBuses(
            plant, maps.can, folder, clock=SimulatedClock(), tell=self.lines.append,
            servos=maps.servos,
        )  # fmt: skip
        self.servos = FAMILY.emulated_in(maps.servos, folder)
        self.can = None if maps.can is None else can_driver.FAMILY.emulated_in(maps.can, folder)

    def all_motors(self, tell: Callable[[str], None] = lambda _: None) -> MotorBus:
        """A driver of all of them."""
        moved = DynamixelMotors(
            self.servos, self, ports=lambda: SerialPorts(self.servos.ports), tell=tell,
            waits=self.can is None,
        )  # fmt: skip
        if self.can is None:
            return moved
        there = self.can
        others = CanMotors(there, self, ports=lambda: LockstepPorts(self, there.buses), tell=tell)
        return ServosAndOthers(self.plant.robot.motor_names, moved, others)
