"""The planar lidar of a simulated plant."""

from __future__ import annotations

from robot.bus import topics
from robot.drivers.sensor_source import SensorSource
from robot.drivers.simulation.plant_sensors import BusSensor
from robot.drivers.wiring import Wiring
from robot.messages import LidarScan
from robot.model.description import Lidar


def make(wiring: Wiring) -> SensorSource[LidarScan, Lidar]:
    """The simulated lidar."""
    lidar = wiring.robot.sensors.lidar
    return BusSensor(wiring.bus, topics.LIDAR, frame=lidar.site, calibration=lidar)
