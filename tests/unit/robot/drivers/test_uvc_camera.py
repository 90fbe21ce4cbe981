"""A webcam: pictures in order, unplugged ones noticed, films and numbered pictures in its place."""

import shutil
import threading

import numpy as np
import pytest
from PIL import Image

from robot.bus.bus import LocalBus
from robot.clock import SimulatedClock, WallClock
from robot.drivers.camera.uvc import KEPT, Settings, UvcCamera
from robot.drivers.registry import RGBD
from robot.drivers.wiring import Wiring
from robot.errors import ConfigError, DriverError
from robot.model import description
from tests.fakes.cameras import FakeCapture

ROBOT = description.load("juno")


def webcam(capture: FakeCapture) -> UvcCamera:
    settings = Settings(device="/dev/video9")
    return UvcCamera(settings, ROBOT.sensors.camera, SimulatedClock(), opens=capture.open)


def grey(value: int) -> np.ndarray:
    return np.full((24, 32, 3), value, np.uint8)


def wait_for(condition) -> None:
    """As long as it takes: a thread has to get its turn."""
    for _ in range(2000):
        if condition():
            return
        threading.Event().wait(0.01)
    raise AssertionError("it never came")


def test_what_is_not_read_in_time_is_dropped_the_oldest_first():
    capture = FakeCapture()
    with webcam(capture) as camera:
        for value in range(KEPT + 3):
            capture.show(grey(value))
        values = [int(image.picture()[0, 0, 0]) for image in camera.read()]
    assert values == list(range(3, KEPT + 3))


def test_an_unplugged_camera_gives_its_last_picture_and_then_an_error():
    capture = FakeCapture()
    with webcam(capture) as camera:
        capture.show(grey(1))
        capture.unplug()
        wait_for(lambda: capture.closed)
        assert len(camera.read()) == 1
        with pytest.raises(DriverError, match="/dev/video9 was unplugged"):
            camera.read()
    with camera:  # and plugged in again
        capture.show(grey(2))
        assert len(camera.read()) == 1


def test_a_picture_says_where_it_looks_and_that_it_has_no_depth():
    image = webcam(FakeCapture()).image(grey(9), 1.5)
    assert image.depth() is None
    assert (image.source, image.frame, image.stamp_s) == ("sensor", "head_camera", 1.5)
    fovy_rad = 2 * np.arctan(image.height / 2 / image.focal_px[1])
    assert fovy_rad == pytest.approx(ROBOT.sensors.camera.fovy_rad)


@pytest.fixture
def body(tmp_path):
    """A robot of one's own whose camera is a webcam."""
    folder = tmp_path / "juno"
    shutil.copytree(ROBOT.path().parent, folder)
    path = folder / "juno.yaml"
    text = path.read_text()
    path.write_text(text.replace("rgbd: simulated", "rgbd: uvc"))
    return path


def made(path, clock):
    wiring = Wiring(robot=description.load(str(path)), clock=clock, bus=LocalBus())
    return RGBD.make(wiring)


def test_numbered_pictures_stand_in_for_a_device_and_end_as_unplugged(body):
    pytest.importorskip("cv2")
    frames = body.parent / "frames"
    frames.mkdir()
    for number in range(3):
        pixels = grey(0)
        pixels[..., 0] = 100 + number  # red
        Image.fromarray(pixels).save(frames / f"{number:04d}.png")
    body.with_name("uvc.yaml").write_text("device: frames/%04d.png\nrate_hz: 100\n")
    came = []

    def is_over() -> bool:
        try:
            came.extend(camera.read())
        except DriverError:
            return True
        return False

    with made(body, WallClock()) as camera:
        wait_for(is_over)
    assert [image.picture()[5, 5].tolist() for image in came] == [
        [100, 0, 0], [101, 0, 0], [102, 0, 0]
    ]  # fmt: skip


def test_a_camera_that_is_not_there_is_an_error_with_its_place(body):
    pytest.importorskip("cv2")
    body.with_name("uvc.yaml").write_text("device: /dev/video987\n")
    with pytest.raises(DriverError, match="/dev/video987"), made(body, SimulatedClock()):
        pass


def test_settings_that_cannot_be_meant_are_refused(body):
    with pytest.raises(ConfigError, match=r"uvc\.yaml"):
        made(body, SimulatedClock())
    body.with_name("uvc.yaml").write_text("devise: /dev/video0\n")
    with pytest.raises(ConfigError, match="devise"):
        made(body, SimulatedClock())


def test_without_opencv_the_error_says_what_to_install(body, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "cv2", None)
    body.with_name("uvc.yaml").write_text("device: /dev/video0\n")
    with (
        pytest.raises(DriverError, match=r"humanoid-executive\[vision\]"),
        made(body, SimulatedClock()),
    ):
        pass
