"""The simulated plant behind emulated buses or ports: open for as long as they are."""

from __future__ import annotations

from robot.drivers.wiring import SimulatedPlant


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
