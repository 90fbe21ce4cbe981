"""The simulated plant behind emulated buses or ports: open for as long as they are; its time."""

from __future__ import annotations

from robot.clock import Clock, WallClock
from robot.drivers.motors.naps import Naps
from robot.drivers.wiring import SimulatedPlant

SAME_S = 1e-6
"""Sums of periods are not exact."""


class PlantBehind:
    """Opens a plant, and lets go of it once."""

    def __init__(self, plant: SimulatedPlant) -> None:
        """Nothing is opened."""
        self._plant = plant
        self._is_open = False

    def open(self) -> None:
        """Reach it. Raises DriverError if it is not there."""
        self._plant.open()
        self._is_open = True

    def close(self) -> None:
        """Let go of it, if it is open. Idempotent."""
        if self._is_open:
            self._is_open = False
            self._plant.close()


class PlantClock:
    """The time of a simulated plant in another process; it goes on in the plant's periods."""

    def __init__(self, plant: SimulatedPlant, *, wall: Clock | None = None) -> None:
        """Of a plant that is open whenever the time is asked for; `wall`: by which waits sleep."""
        self._plant, self._naps = plant, Naps(wall or WallClock())

    def now_s(self) -> float:
        """When its newest period began. Raises DriverError if it went away."""
        return self._plant.sample.motors.stamp_s

    def sleep_until(self, time_s: float) -> None:
        """Wait. Raises DriverError if it went away."""
        if self.now_s() >= time_s - SAME_S:
            return
        self._naps.begin()
        self._naps.nap()
        while self.now_s() < time_s - SAME_S:
            self._naps.nap()
        self._naps.end()
