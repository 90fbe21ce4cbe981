"""A driver and a plant's emulated boards in one thread: real datagrams, and no wall clock."""

from collections.abc import Callable
from pathlib import Path

from robot.clock import SimulatedClock
from robot.drivers.motors.ethernet.driver import FAMILY, EthernetMotors
from robot.drivers.motors.ethernet.joint_map import DriveMap
from robot.drivers.motors.ethernet.ports import UdpPorts
from sim.plant import Plant
from sim.plant_buses import PlantBuses
from tests.fakes.can_lockstep import Lockstep


class EthernetLockstep(Lockstep):
    """The plant's time, which goes on while somebody waits for it."""

    def __init__(self, plant: Plant, boards: DriveMap, folder: Path) -> None:
        self.plant, self.lines = plant, list[str]()
        self.buses = PlantBuses(
            plant, None, folder, clock=SimulatedClock(), tell=self.lines.append, boards=boards
        )
        self.boards = FAMILY.emulated_in(boards, folder)

    def motors(self, tell: Callable[[str], None] = lambda _: None) -> EthernetMotors:
        """A driver of all of them."""
        return EthernetMotors(
            self.boards, self, ports=lambda: UdpPorts(self.boards.boards), tell=tell
        )
