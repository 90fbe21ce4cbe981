"""The force sensors at ankles and wrists of a simulated plant."""

from __future__ import annotations

from robot.drivers.body_sample import ForceReading
from robot.drivers.sensor_source import SensorSource
from robot.drivers.simulation.plant_sensors import PlantSensor
from robot.drivers.wiring import Wiring


def make(wiring: Wiring) -> SensorSource[ForceReading, None]:
    """All four simulated sensors. Raises DriverError if there is no simulated plant."""
    plant = wiring.simulated_plant()
    return PlantSensor(plant, lambda sample: sample.force, frame="", calibration=None)
