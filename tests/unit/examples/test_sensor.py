"""The example of a sensor's driver: every promise of the contract, and the row of the registry."""

from pathlib import Path

import msgspec
import pytest

from examples.sensor_recorded_lidar import make
from robot.bus import topics
from robot.bus.bus import LocalBus
from robot.clock import SimulatedClock
from robot.drivers.published_sensors import PublishedSensors
from robot.drivers.wiring import Wiring
from robot.errors import DriverError
from robot.messages import LidarScan
from tests.contract.test_sensor_source import (  # noqa: F401 - run here on the bench below
    FAMILIES,
    ROBOT,
    Device,
    scan,
    test_a_closed_driver_refuses,
    test_a_reading_is_what_was_measured_and_comes_once,
    test_it_knows_its_calibration,
    test_its_frame_is_a_site_of_the_body,
    test_who_reads_late_gets_the_newest_last,
)

STAMPS_S = (0.1, 0.2, 0.3)


@pytest.fixture
def wiring(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Wiring:
    """A robot whose description names the driver, with a recording beside it."""
    monkeypatch.setitem(FAMILIES["lidar"].drivers, "recorded", make)
    lines = msgspec.json.Encoder().encode_lines([scan(stamp_s) for stamp_s in STAMPS_S])
    (tmp_path / "lidar.jsonl").write_bytes(lines)
    robot = msgspec.structs.replace(ROBOT, drivers={"lidar": "recorded"}, folder=str(tmp_path))
    return Wiring(robot=robot, clock=SimulatedClock(), bus=LocalBus())


@pytest.fixture
def device(wiring: Wiring) -> Device:
    def measure(stamp_s: float) -> LidarScan:
        wiring.clock.sleep_until(stamp_s)
        return scan(stamp_s)

    lidar = ROBOT.sensors.lidar
    return Device(FAMILIES["lidar"].make(wiring), measure, lidar, lidar.site)


def test_perception_publishes_it_like_any_lidar(wiring: Wiring):
    heard = wiring.bus.subscribe(topics.LIDAR)
    with PublishedSensors(wiring, "perception") as senses:
        for stamp_s in STAMPS_S:
            wiring.clock.sleep_until(stamp_s)
            senses.relay()
    assert [message.stamp_s for message in heard.take()] == list(STAMPS_S)


@pytest.mark.parametrize("content", [None, b"not a scan\n"])
def test_what_is_no_recording_is_a_driver_error(wiring: Wiring, tmp_path: Path, content):
    path = tmp_path / "lidar.jsonl"
    path.unlink() if content is None else path.write_bytes(content)
    source = FAMILIES["lidar"].make(wiring)
    with pytest.raises(DriverError, match=r"lidar\.jsonl"), source:
        pass
