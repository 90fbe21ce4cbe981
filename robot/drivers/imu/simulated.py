"""The IMU of a simulated plant."""

from __future__ import annotations

from robot.drivers.body_sample import ImuReading
from robot.drivers.sensor_source import SensorSource
from robot.drivers.simulation.plant_sensors import PlantSensor
from robot.drivers.wiring import Wiring
from robot.model.description import Imu


def make(wiring: Wiring) -> SensorSource[ImuReading, Imu]:
    """The simulated IMU. Raises DriverError if there is no simulated plant."""
    plant, imu = wiring.simulated_plant(), wiring.robot.sensors.imu
    return PlantSensor(plant, lambda sample: sample.imu, frame=imu.site, calibration=imu)
