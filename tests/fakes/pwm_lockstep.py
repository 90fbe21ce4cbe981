"""Drivers of a robot with hobby servos and a plant's buses in one thread, without a wall clock."""

from collections.abc import Callable
from pathlib import Path

from robot.clock import SimulatedClock
from robot.drivers.motors.can.driver import FAMILY, CanMotors
from robot.drivers.motors.pwm.driver import PwmMotors
from robot.drivers.motors.pwm_and_others import Maps, PwmAndOthers
from sim.devices.pwm_bench import DirectChips
from sim.plant import Plant
from sim.plant_buses import PlantBuses
from tests.fakes.can_lockstep import Lockstep, LockstepPorts


class LockstepChips(DirectChips):
    """Chips of the plant, whose time its buses play; who waits for them plays those."""

    def __init__(self, time: "PwmLockstep", wanted: Maps) -> None:
        super().__init__(wanted.servos, time.buses.pulsed, SimulatedClock())
        self._time = time
        self._clock = time

    def _play(self) -> None:
        """The plant's buses do."""


class PwmLockstep(Lockstep):
    """The plant's time, which goes on while somebody waits for it."""

    def __init__(self, plant: Plant, maps: Maps, folder: Path) -> None:
        assert maps.can is not None
        self.plant, self.lines = plant, list[str]()
        self.maps = maps
        self.buses = PlantBuses(
            plant, maps.can, folder, clock=SimulatedClock(), tell=self.lines.append,
            pulses=maps.servos,
        )  # fmt: skip
        self.joints = FAMILY.emulated_in(maps.can, folder)

    def all_motors(self, tell: Callable[[str], None] = lambda _: None) -> PwmAndOthers:
        """A driver of all of them."""
        servos = PwmMotors(
            self.maps.servos, self, ports=lambda: LockstepChips(self, self.maps), tell=tell,
            waits=False,
        )  # fmt: skip
        others = CanMotors(
            self.joints, self, ports=lambda: LockstepPorts(self, self.joints.buses), tell=tell
        )
        return PwmAndOthers(self.plant.robot.motor_names, servos, others)
