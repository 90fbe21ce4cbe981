"""The camera of a simulated plant: its coarse depth, and its whole pictures."""

from __future__ import annotations

from robot.bus import topics
from robot.drivers.sensor_source import SensorSource
from robot.drivers.simulation.plant_sensors import BusSensor
from robot.drivers.wiring import Wiring
from robot.messages import DepthImage, RgbdImage
from robot.model.description import Camera


def make(wiring: Wiring) -> SensorSource[DepthImage, Camera]:
    """The simulated camera."""
    camera = wiring.robot.sensors.camera
    return BusSensor(wiring.bus, topics.DEPTH, frame=camera.site, calibration=camera)


def make_rgbd(wiring: Wiring) -> SensorSource[RgbdImage, Camera]:
    """The simulated camera's pictures, which a process of their own renders."""
    camera = wiring.robot.sensors.camera
    return BusSensor(wiring.bus, topics.RGBD, frame=camera.site, calibration=camera)
