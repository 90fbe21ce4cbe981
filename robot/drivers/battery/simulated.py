"""The battery of a simulated plant; says nothing where the robot describes none."""

from __future__ import annotations

from robot.bus import topics
from robot.drivers.sensor_source import SensorSource
from robot.drivers.simulation.plant_sensors import BusSensor
from robot.drivers.wiring import Wiring
from robot.messages import PowerState
from robot.model.description import Battery


def make(wiring: Wiring) -> SensorSource[PowerState, Battery | None]:
    """The simulated battery."""
    return BusSensor(wiring.bus, topics.POWER, frame="", calibration=wiring.robot.battery)
