"""The example of a new kind of sensor, with its row in the registry: contract, and published."""

import ast
import dataclasses
from pathlib import Path

import msgspec
import pytest

from examples import sensor_thermometer as thermometer
from robot.bus.bus import LocalBus
from robot.clock import SimulatedClock
from robot.drivers import published_sensors, registry
from robot.drivers.registry import Sense
from robot.drivers.wiring import Wiring
from robot.errors import DriverError
from robot.model import description
from tests.contract.test_sensor_source import (  # noqa: F401 - run here on the bench below
    Device,
    test_a_closed_driver_refuses,
    test_a_reading_is_what_was_measured_and_comes_once,
    test_it_knows_its_calibration,
    test_its_frame_is_a_site_of_the_body,
    test_who_reads_late_gets_the_newest_last,
)

ABOVE = (
    "executive", "intents", "sim", "robot.bringup", "robot.control", "robot.perception",
    "robot.planning", "robot.link", "robot.fusion", "robot.kinematics", "robot.drivers.registry",
    "robot.drivers.published_sensors", "robot.drivers.body_devices",
)  # fmt: skip
ROBOT = description.load("juno")
ROW = Sense("thermometer", {"linux": thermometer.make}, thermometer.COMPUTER)


@pytest.fixture
def zone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    zone = tmp_path / "temp"
    zone.write_text("41500\n")
    monkeypatch.setattr(thermometer, "ZONE", zone)
    return zone


@pytest.fixture
def wiring(zone: Path, monkeypatch: pytest.MonkeyPatch) -> Wiring:
    monkeypatch.setattr(registry, "SENSES", (*registry.SENSES, ROW))
    monkeypatch.setattr(published_sensors, "SENSES", registry.SENSES)
    monkeypatch.setattr(registry, "FAMILIES", (*registry.FAMILIES, ROW))
    drivers = {**ROBOT.drivers, "thermometer": "linux"}
    robot = msgspec.structs.replace(ROBOT, drivers=drivers)
    return Wiring(robot=robot, clock=SimulatedClock(), bus=LocalBus())


@pytest.fixture
def device(wiring: Wiring, zone: Path) -> Device:
    def measure(stamp_s: float) -> thermometer.ComputerTemperature:
        wiring.clock.sleep_until(stamp_s)
        hot_c = 40.0 + stamp_s
        zone.write_text(f"{1000 * hot_c:.0f}\n")
        return thermometer.ComputerTemperature(stamp_s=stamp_s, temperature_c=hot_c)

    return Device(ROW.make(wiring), measure, period_s=thermometer.PERIOD_S)


def test_perception_publishes_it_once_a_second(wiring: Wiring, zone: Path):
    heard = wiring.bus.subscribe(thermometer.COMPUTER)
    with published_sensors.PublishedSensors(wiring, "perception") as opened:
        for tick in range(21):
            wiring.clock.sleep_until(0.1 * tick)
            if tick == 15:
                zone.write_text("52000\n")
            opened.relay()
    assert [(m.stamp_s, m.temperature_c) for m in heard.take()] == [
        (0.0, 41.5), (1.0, 41.5), (2.0, 52.0)
    ]  # fmt: skip


def test_a_robot_whose_description_does_not_name_it_has_none(wiring: Wiring, zone: Path):
    zone.unlink()
    without = dataclasses.replace(wiring, robot=ROBOT)
    heard = wiring.bus.subscribe(thermometer.COMPUTER)
    registry.check(ROBOT)
    registry.check(wiring.robot)
    with published_sensors.PublishedSensors(without, "perception") as opened:
        opened.relay()
    assert not heard.take()


def test_the_file_can_stand_among_the_drivers_as_it_is():
    """It imports nothing that stands above them, nor their registry, which imports it."""
    tree = ast.parse(Path(thermometer.__file__).read_text())
    names = [node.module or "" for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)]
    assert names
    assert not [name for name in names if name.startswith(ABOVE)]


def test_a_computer_without_one_is_told_when_it_is_opened(wiring: Wiring, zone: Path):
    zone.unlink()
    source = ROW.make(wiring)
    with pytest.raises(DriverError, match="no thermometer"), source:
        pass
