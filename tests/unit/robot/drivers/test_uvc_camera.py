"""A webcam: pictures in order, unplugged ones noticed, films and numbered pictures in its place."""

import os
import shutil
import threading

import numpy as np
import pytest
from PIL import Image

from robot.bus.bus import LocalBus
from robot.clock import SimulatedClock, WallClock
from robot.drivers.camera.uvc import KEPT, OPENING_S, Settings, UvcCamera
from robot.drivers.registry import RGBD
from robot.drivers.wiring import Wiring
from robot.errors import ConfigError, DriverError
from robot.model import description
from tests.fakes.cameras import FakeCapture
from tests.fakes.waiting import eventually

ROBOT = description.load("juno")


def webcam(capture: FakeCapture) -> UvcCamera:
    settings = Settings(device="/dev/video9")
    return UvcCamera(settings, ROBOT.sensors.camera, SimulatedClock(), opens=capture.open)


def grey(value: int) -> np.ndarray:
    return np.full((24, 32, 3), value, np.uint8)


def wait_for(condition) -> None:
    """As long as it takes: a thread has to get its turn."""
    assert eventually(condition)


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


def failure_of(camera) -> str:
    """What a camera says that gives no picture."""
    said: list[str] = []

    def is_over() -> bool:
        try:
            assert not camera.read()
        except DriverError as error:
            said.append(str(error))
        return bool(said)

    with camera:
        wait_for(is_over)
    return said[0]


@pytest.fixture
def own(tmp_path, monkeypatch):
    """The user's own file, which lets robots open a device."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    file = tmp_path / "humanoid" / "config.toml"
    file.parent.mkdir()
    file.write_text('devices = ["/dev/video987", "/dev/null"]\n')
    return file


def test_a_camera_that_is_not_there_is_an_error_with_its_place(body, own):
    pytest.importorskip("cv2")
    body.with_name("uvc.yaml").write_text("device: /dev/video987\n")
    assert "there is no camera /dev/video987" in failure_of(made(body, SimulatedClock()))


@pytest.mark.parametrize(
    "device", ["/dev/video0", "/dev/../dev/video987", "/dev/null/../video987", "/dev/tty"]
)
def test_no_device_is_opened_that_the_users_own_file_does_not_name(body, own, device):
    body.with_name("uvc.yaml").write_text(f"device: {device}\n")
    said = failure_of(made(body, SimulatedClock()))
    assert "config.toml" in said and device in said


def test_a_file_that_everybody_may_write_lets_nothing_be_opened(body, own):
    body.with_name("uvc.yaml").write_text("device: /dev/video987\n")
    own.chmod(0o666)
    assert "config.toml" in failure_of(made(body, SimulatedClock()))


def test_a_realsense_is_not_opened_unasked(body, own):
    body.write_text(body.read_text().replace("rgbd: uvc", "rgbd: realsense"))
    with pytest.raises(DriverError, match="realsense is not opened"), made(body, SimulatedClock()):
        pass


@pytest.mark.parametrize(
    "device",
    [
        "http://127.0.0.1:9/film.mp4",
        "tcp:/127.0.0.1:9?listen=1",
        "pipe",
        "list.mp4",
        "link.mkv",
        "../outside.mkv",
        "/etc/hostname",
        "folder",
        "frames/%0999999999d.png",
        "frames/%04d%04d.png",
        "frames/%s.png",
        "out/%d.png",
        "one/%d.png",
    ],
)
def test_what_a_strangers_file_names_is_an_ordinary_film_or_picture_in_its_folder(body, device):
    pytest.importorskip("cv2")
    folder = body.parent
    os.mkfifo(folder / "pipe")
    (folder / "folder").mkdir()
    (folder / "list.mp4").write_text("#EXTM3U\n#EXTINF:1,\nfile:///dev/zero\n")
    outside = folder.parent / "outside.mkv"
    outside.write_bytes(b"\x1aE\xdf\xa3")
    (folder / "link.mkv").symlink_to(outside)
    (folder / "out").symlink_to(folder.parent)
    Image.fromarray(grey(0)).save(folder.parent / "0.png")
    (folder / "one").mkdir()
    (folder / "one" / "0.png").symlink_to(folder.parent / "0.png")
    body.with_name("uvc.yaml").write_text(f'device: "{device}"\n')
    assert failure_of(made(body, SimulatedClock()))


def film(path, width, height) -> None:
    cv2 = pytest.importorskip("cv2")
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter_fourcc(*"MJPG"), 10, (width, height))
    for _ in range(2):
        writer.write(np.zeros((height, width, 3), np.uint8))
    writer.release()


def test_a_film_is_shown(body):
    film(body.with_name("film.avi"), 64, 48)
    body.with_name("uvc.yaml").write_text("device: film.avi\n")
    came = []
    with made(body, WallClock()) as camera:
        wait_for(lambda: came.extend(camera.read()) or came)
    assert (came[0].width, came[0].height) == (64, 48)


def test_a_film_of_huge_pictures_is_refused_before_one_is_decoded(body):
    film(body.with_name("film.avi"), 4096, 2048)
    body.with_name("uvc.yaml").write_text("device: film.avi\n")
    assert "megapixels" in failure_of(made(body, SimulatedClock()))


def test_a_device_that_hangs_holds_nobody_up_and_is_opened_no_second_time():
    answers, opened, clock = threading.Event(), [], SimulatedClock()

    def opens():
        opened.append(1)
        answers.wait()
        raise DriverError("it was never there")

    settings = Settings(device="/dev/video9")
    camera = UvcCamera(settings, ROBOT.sensors.camera, clock, opens=opens)
    try:
        with camera:
            assert not camera.read()
            clock.set(OPENING_S + 0.1)
            with pytest.raises(DriverError, match="does not answer"):
                camera.read()
        with pytest.raises(DriverError, match="does not answer"):
            camera.__enter__()
        assert opened == [1]
    finally:
        answers.set()


def test_settings_that_cannot_be_meant_are_refused(body):
    with pytest.raises(ConfigError, match=r"uvc\.yaml"):
        made(body, SimulatedClock())
    body.with_name("uvc.yaml").write_text("devise: /dev/video0\n")
    with pytest.raises(ConfigError, match="devise"):
        made(body, SimulatedClock())


def test_without_opencv_the_error_says_what_to_install(body, own, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "cv2", None)
    body.with_name("uvc.yaml").write_text("device: /dev/video987\n")
    assert "humanoid-executive[vision]" in failure_of(made(body, SimulatedClock()))
