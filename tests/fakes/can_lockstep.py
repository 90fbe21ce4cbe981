"""A driver and a plant's emulated buses in one thread: real frames, and no wall clock."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from robot.clock import Clock, SimulatedClock
from robot.drivers.motors.can.driver import FAMILY, CanMotors
from robot.drivers.motors.can.joint_map import Bus, JointMap
from robot.drivers.motors.can.ports import Heard, PythonCan
from sim.plant import Plant
from sim.plant_buses import PlantBuses


class Lockstep:
    """The plant's time, which goes on while somebody waits for it."""

    def __init__(self, plant: Plant, joints: JointMap, folder: Path) -> None:
        self.plant, self.lines = plant, list[str]()
        self.buses = PlantBuses(
            plant, joints, folder, clock=SimulatedClock(), tell=self.lines.append
        )
        self.joints = FAMILY.emulated_in(joints, folder)

    def now_s(self) -> float:
        """The time of the plant."""
        return self.plant.time_s

    def sleep_until(self, time_s: float) -> None:
        """Play whole periods."""
        while self.plant.time_s < time_s - 1e-6:
            self.buses.period(self.plant.read(), patience_s=0.0)

    def driver(self, tell: Callable[[str], None] = lambda _: None) -> CanMotors:
        """A driver on these buses."""
        return CanMotors(
            self.joints, self, ports=lambda: LockstepPorts(self, self.joints.buses), tell=tell
        )


class LockstepPorts(PythonCan):
    """Buses of the plant; who waits for them plays it."""

    def __init__(self, time: Clock, buses: Mapping[str, Bus]) -> None:
        super().__init__(buses, time)
        self._time = time

    def receive(self, until_s: float) -> Sequence[Heard]:
        """What came in, after a period if that is not yet over."""
        if self._time.now_s() < until_s:
            self._time.sleep_until(self._time.now_s() + 0.001)
        return super().receive(self._time.now_s())
