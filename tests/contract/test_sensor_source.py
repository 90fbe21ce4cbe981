"""What every driver of a sensor promises, tried on each row of the registry.

A new driver is a row of `BENCHES`; all else that is to be known of it says its `Device`.
"""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from robot.bus import topics
from robot.bus.bus import LocalBus
from robot.clock import SimulatedClock
from robot.drivers.camera.librealsense import Frame
from robot.drivers.camera.realsense import RealSenseCamera
from robot.drivers.camera.uvc import Settings, UvcCamera
from robot.drivers.registry import FORCE, IMU, RGBD, SENSES
from robot.drivers.sensor_source import SensorSource
from robot.drivers.simulation.plant_sensors import emulated
from robot.drivers.simulation.shared_plant import SILENCE_S, PlantServer, SharedPlant
from robot.drivers.wiring import Wiring
from robot.errors import DriverError
from robot.messages import DepthImage, LidarScan, PowerState, RgbdImage
from robot.model import description
from robot.model.body import BodyModel
from tests.fakes.cameras import FakeCapture, FakeRealSense
from tests.fakes.motors import FakePlant

ROBOT = description.load("juno")
COUNT = len(ROBOT.motors)
FAMILIES = {family.device: family for family in (IMU, FORCE, RGBD, *SENSES)}
SENSORS = ROBOT.sensors


@dataclass
class Device:
    """A driver, and what its device is.

    Attributes:
        source: the driver.
        measure: makes the device measure at a time [s], and gives the truth.
        calibration: what the driver knows of it.
        frame: the site of the body that it sits at; empty of what has no place.
        period_s: its own pace, if it measures no sooner; a multiple of a millisecond.
    """

    source: SensorSource
    measure: Callable[[float], object]
    calibration: object = None
    frame: str = ""
    period_s: float = 0.1

    @property
    def stamps_s(self) -> list[float]:
        """Of three measurements at its pace."""
        return [round(count * self.period_s, 3) for count in (1, 2, 3)]


def bus_device(name, topic, reading, calibration, frame):
    def bench(tmp_path: Path) -> Device:
        bus = LocalBus()
        wiring = Wiring(robot=ROBOT, clock=SimulatedClock(), bus=bus)

        def measure(stamp_s: float) -> object:
            message = reading(stamp_s)
            bus.publish(emulated(topic), message)
            return message

        return Device(FAMILIES[name].make(wiring), measure, calibration, frame)

    return bench


def inside_here(name, calibration, frame):
    def bench(tmp_path: Path) -> Device:
        plant = FakePlant()
        wiring = Wiring(robot=ROBOT, clock=SimulatedClock(), bus=LocalBus(), plant=plant)

        def measure(stamp_s: float) -> object:
            plant.time_ms = round(1000 * stamp_s)
            return getattr(plant.read(), name)

        return Device(FAMILIES[name].make(wiring), measure, calibration, frame)

    return bench


def inside_elsewhere(name, calibration, frame):
    def bench(tmp_path: Path) -> Device:
        plant, server, clock = FakePlant(COUNT), PlantServer(ROBOT, tmp_path), SimulatedClock()
        there = SharedPlant(ROBOT, tmp_path, clock=clock)
        wiring = Wiring(robot=ROBOT, clock=clock, bus=LocalBus(), plant=there)

        def measure(stamp_s: float) -> object:
            plant.time_ms = round(1000 * stamp_s)
            server.publish(plant.read())
            return getattr(plant.sample, name)

        measure(0.0)  # opening waits for a first one
        return Device(FAMILIES[name].make(wiring), measure, calibration, frame)

    return bench


def webcam(tmp_path: Path) -> Device:
    clock, capture = SimulatedClock(), FakeCapture()
    camera = ROBOT.sensors.camera
    source = UvcCamera(Settings(device="/dev/video9"), camera, clock, opens=capture.open)

    def measure(stamp_s: float) -> object:
        clock.set(stamp_s)
        pixels = np.full((2, 3, 3), round(100 * stamp_s), np.uint8)
        capture.show(pixels)
        return source.image(pixels, stamp_s)

    return Device(source, measure, ROBOT.sensors.camera, ROBOT.sensors.camera.site)


def realsense(tmp_path: Path) -> Device:
    clock, camera = SimulatedClock(), FakeRealSense()
    source = RealSenseCamera(ROBOT.sensors.camera, clock, opens=lambda: camera)

    def measure(stamp_s: float) -> object:
        clock.set(stamp_s)
        value = round(100 * stamp_s)
        colours, depth_m = np.full((2, 3, 3), value, np.uint8), np.ones((2, 3), np.float32)
        frame = Frame(stamp_s, colours, depth_m, 0.01)
        camera.frames.append(frame)
        return source.image(frame, camera.lens, stamp_s)

    return Device(source, measure, ROBOT.sensors.camera, ROBOT.sensors.camera.site)


def picture(stamp_s: float) -> RgbdImage:
    return RgbdImage(
        stamp_s=stamp_s, width=2, height=1, focal_px=(1.0, 1.0), centre_px=(0.5, 0.0),
        frame="head_camera", colours=bytes(6), depth_m=bytes(8),
    )  # fmt: skip


def image(stamp_s: float) -> DepthImage:
    return DepthImage(stamp_s=stamp_s, width=2, height=1, fovy_rad=1.0, depth_m=bytes(8))


def scan(stamp_s: float) -> LidarScan:
    return LidarScan(stamp_s=stamp_s, angle_min_rad=-3.1, angle_step_rad=0.1, ranges_m=(1.0, 2.0))


def power(stamp_s: float) -> PowerState:
    return PowerState(stamp_s=stamp_s, charge=0.5, power_w=90.0, source="emulated")


IMU_IS = "imu", SENSORS.imu, SENSORS.imu.site
FORCE_IS = "force", None, ""
BENCHES = {
    ("imu", "simulated"): (inside_here(*IMU_IS), inside_elsewhere(*IMU_IS)),
    ("force", "simulated"): (inside_here(*FORCE_IS), inside_elsewhere(*FORCE_IS)),
    ("camera", "simulated"): (
        bus_device("camera", topics.DEPTH, image, SENSORS.camera, SENSORS.camera.site),
    ),
    ("rgbd", "simulated"): (
        bus_device("rgbd", topics.RGBD, picture, SENSORS.camera, SENSORS.camera.site),
    ),
    ("rgbd", "uvc"): (webcam,),
    ("rgbd", "realsense"): (realsense,),
    ("lidar", "simulated"): (
        bus_device("lidar", topics.LIDAR, scan, SENSORS.lidar, SENSORS.lidar.site),
    ),
    ("battery", "simulated"): (bus_device("battery", topics.POWER, power, ROBOT.battery, ""),),
}


@pytest.fixture(
    params=[bench for benches in BENCHES.values() for bench in benches],
    ids=[f"{'-'.join(row)}-{k}" for row, benches in BENCHES.items() for k in range(len(benches))],
)
def device(request: pytest.FixtureRequest, tmp_path: Path) -> Device:
    return request.param(tmp_path)


def numbers(reading) -> dict:
    """The fields of a reading, arrays as lists."""
    names = getattr(reading, "__struct_fields__", None) or reading.__dataclass_fields__
    fields = {name: getattr(reading, name) for name in names}
    return {
        name: value.tolist() if isinstance(value, np.ndarray) else value
        for name, value in fields.items()
    }


def test_every_row_is_tried():
    rows = {(name, driver) for name, family in FAMILIES.items() for driver in family.drivers}
    assert set(BENCHES) == rows


def test_a_closed_driver_refuses(device: Device):
    with pytest.raises(DriverError):
        device.source.read()
    with device.source:
        pass
    with pytest.raises(DriverError):
        device.source.read()
    device.source.__exit__(None, None, None)


def test_a_reading_is_what_was_measured_and_comes_once(device: Device):
    with device.source as source:
        source.read()
        for stamp_s in device.stamps_s:
            truth = device.measure(stamp_s)
            (reading,) = source.read()
            assert numbers(reading) == numbers(truth)
            assert reading.stamp_s == stamp_s
            assert not source.read()


def test_who_reads_late_gets_the_newest_last(device: Device):
    with device.source as source:
        for stamp_s in device.stamps_s:
            device.measure(stamp_s)
        stamps_s = [reading.stamp_s for reading in source.read()]
    assert stamps_s == sorted(set(stamps_s))
    assert stamps_s[-1] == device.stamps_s[-1]


def test_its_frame_is_a_site_of_the_body(device: Device):
    assert device.source.frame == device.frame
    if device.frame:
        assert BodyModel(ROBOT).site_id(device.frame) >= 0


def test_it_knows_its_calibration(device: Device):
    assert device.source.calibration == device.calibration


@pytest.mark.parametrize("name", ["imu", "force"])
def test_a_dead_plant_is_an_error_within_a_second(name: str, tmp_path: Path):
    bench = inside_elsewhere(name, None, "")(tmp_path)
    clock = SimulatedClock()
    there = SharedPlant(ROBOT, tmp_path, clock=clock)
    wiring = Wiring(robot=ROBOT, clock=clock, bus=LocalBus(), plant=there)
    with FAMILIES[name].make(wiring) as source:
        bench.measure(0.1)
        assert source.read()
        clock.sleep_until(0.9 * SILENCE_S)
        assert not source.read()
        clock.sleep_until(1.1 * SILENCE_S)
        with pytest.raises(DriverError, match="silent"):
            source.read()


@pytest.mark.parametrize("name", ["imu", "force"])
def test_a_process_without_a_plant_has_no_simulated_sensor_of_the_body(name: str):
    wiring = Wiring(robot=ROBOT, clock=SimulatedClock(), bus=LocalBus())
    with pytest.raises(DriverError, match="simulated plant"):
        FAMILIES[name].make(wiring)
