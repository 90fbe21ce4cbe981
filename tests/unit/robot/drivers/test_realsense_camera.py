"""A RealSense through an emulated library: its pictures in metres, and what goes wrong with it."""

import shutil
import sys

import numpy as np
import pytest

from robot.bus.bus import LocalBus
from robot.clock import SimulatedClock
from robot.drivers.camera.realsense import SILENCE_S
from robot.drivers.registry import RGBD
from robot.drivers.wiring import Wiring
from robot.errors import ConfigError, DriverError
from robot.model import description
from tests.fakes.realsense_module import SERIAL, Device, module

JUNO = description.load("juno").path().parent


@pytest.fixture(autouse=True)
def own(tmp_path, monkeypatch):
    """The user's own file lets robots open one."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    (tmp_path / "humanoid").mkdir()
    (tmp_path / "humanoid" / "config.toml").write_text('devices = ["realsense"]\n')


@pytest.fixture
def device(monkeypatch) -> Device:
    device = Device()
    monkeypatch.setitem(sys.modules, "pyrealsense2", module(device))
    return device


@pytest.fixture
def body(tmp_path):
    folder = tmp_path / "juno"
    shutil.copytree(JUNO, folder)
    path = folder / "juno.yaml"
    path.write_text(path.read_text().replace("rgbd: simulated", "rgbd: realsense"))
    return path


def made(path, clock=None):
    robot = description.load(str(path))
    return RGBD.make(Wiring(robot=robot, clock=clock or SimulatedClock(), bus=LocalBus()))


def test_its_pictures_are_in_metres_with_its_makers_focal_lengths(device, body):
    colours = np.full((4, 6, 3), (200, 100, 50), np.uint8)
    depth_mm = np.full((4, 6), 1500, np.uint16)
    depth_mm[0, 0] = 0
    with made(body, SimulatedClock(3.0)) as camera:
        device.show(colours, depth_mm)
        device.show(colours + 1, depth_mm)
        first, second = camera.read()
        assert not camera.read()
    assert first.picture()[2, 2].tolist() == [200, 100, 50]
    assert second.picture()[2, 2].tolist() == [201, 101, 51]
    assert first.depth()[2, 2] == pytest.approx(1.5)
    assert first.depth()[0, 0] == 0.0
    assert first.matrix()[0].tolist() == [381.0, 0.0, 319.0]
    assert (first.exposure_s, first.source) == (0.008, "sensor")
    assert (first.stamp_s, second.stamp_s) == pytest.approx((2.999, 3.0))  # 1 ms apart, it says
    assert not device.streaming


def test_the_file_beside_the_description_says_which_and_how(device, body):
    body.with_name("realsense.yaml").write_text(f"serial: {SERIAL}\nwidth: 320\nheight: 240\n")
    with made(body):
        pass
    assert ("serial", SERIAL) in device.asked
    assert ("depth", 320, 240, "z16", 30) in device.asked
    assert ("color", 320, 240, "rgb8", 30) in device.asked
    body.with_name("realsense.yaml").write_text("serial: 1\nwitdh: 3\n")
    with pytest.raises(ConfigError, match="did you mean 'width'"):
        made(body)


def test_one_that_is_not_there_or_unplugged_or_breaks_off_is_an_error(device, body):
    clock = SimulatedClock()
    with made(body, clock) as camera:
        clock.set(0.9 * SILENCE_S)
        assert not camera.read()
        clock.set(2.5 * SILENCE_S)
        assert not camera.read()  # silent, and there: health says that it is late
        device.plugged = False
        clock.set(5.0 * SILENCE_S)
        with pytest.raises(DriverError, match=f"{SERIAL} was unplugged"):
            camera.read()
    with pytest.raises(DriverError, match="No device connected"), made(body):
        pass
    device.plugged = device.breaks = True
    with made(body) as camera, pytest.raises(DriverError, match="MIPI error"):
        camera.read()


def test_without_its_library_the_error_says_what_to_install(body, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyrealsense2", None)
    with pytest.raises(DriverError, match=r"humanoid-executive\[realsense\]"), made(body):
        pass
