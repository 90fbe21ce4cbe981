"""A camera that cannot be trusted is noticed: unplugged, late, frozen, black."""

import numpy as np
import pytest

from robot.bus import topics
from robot.bus.bus import LocalBus
from robot.clock import SimulatedClock
from robot.drivers import registry
from robot.drivers.camera.uvc import Settings, UvcCamera
from robot.drivers.registry import Family
from robot.drivers.wiring import Wiring
from robot.errors import DriverError
from robot.messages import RgbdImage
from robot.model import description
from robot.perception import eye as eyes
from robot.perception.camera_watch import CameraWatch
from robot.perception.eye import AGAIN_S, Eye
from tests.fakes.cameras import FakeCapture
from tests.fakes.waiting import eventually

RATE_HZ = 10.0
ROBOT = description.load("juno")


def image(pixels: np.ndarray, *, source="sensor") -> RgbdImage:
    return RgbdImage(
        stamp_s=0.0, width=32, height=24, focal_px=(20.0, 20.0), centre_px=(15.5, 11.5),
        frame="head_camera", colours=pixels.tobytes(), source=source,
    )  # fmt: skip


def scene(seed: int, mean: float = 120.0, spread: float = 40.0) -> np.ndarray:
    """Something to see, with the grain of one picture."""
    rng = np.random.default_rng(seed)
    return np.clip(rng.normal(mean, spread, (24, 32, 3)), 0, 255).astype(np.uint8)


def watch_after(pictures, *, wait_s=0.0, **options) -> str:
    watch = CameraWatch(rate_hz=RATE_HZ, start_s=0.0)
    now_s = 0.0
    for number, pixels in enumerate(pictures):
        now_s = number / RATE_HZ
        watch.see(image(pixels, **options), now_s)
    return watch.state(now_s + wait_s).code


def test_pictures_of_something_that_keep_coming_are_well():
    assert watch_after([scene(k) for k in range(20)]) == ""
    assert watch_after([scene(k) for k in range(20)], wait_s=0.4) == ""


def test_a_picture_that_stays_away_is_late():
    assert watch_after([scene(k) for k in range(5)], wait_s=0.6) == "camera_late"
    assert CameraWatch(rate_hz=RATE_HZ, start_s=0.0).state(0.6).code == "camera_late"


def test_the_same_picture_again_and_again_is_a_frozen_camera():
    assert watch_after([scene(1)] * 4) == ""
    assert watch_after([scene(1)] * 6) == "camera_frozen"
    assert watch_after([scene(1)] * 6 + [scene(2)]) == ""


def test_a_simulated_picture_without_grain_may_be_the_same_twice():
    assert watch_after([scene(1)] * 20, source="emulated") == ""


@pytest.mark.parametrize("mean", [0.0, 4.0])
def test_a_covered_camera_or_a_dark_room_is_black(mean):
    black = [scene(k, mean=mean, spread=2.0) for k in range(6)]
    assert watch_after(black) == "camera_black"
    assert watch_after([*black, scene(7)]) == ""


def test_a_dim_room_and_a_black_cloth_with_a_light_on_it_are_no_black_pictures():
    assert watch_after([scene(k, mean=20.0, spread=4.0) for k in range(6)]) == ""
    lit = scene(0, mean=2.0, spread=1.0)
    lit[:6, :6] = 250
    assert watch_after([lit + k for k in range(6)]) == ""


@pytest.fixture
def rig(monkeypatch):
    """An eye over a webcam that can be unplugged, plugged in, and shown things."""
    capture, clock, bus = FakeCapture(), SimulatedClock(), LocalBus()
    plugged = {"in": True}

    def opens():
        if not plugged["in"]:
            raise DriverError("there is no camera /dev/video9")
        return capture.open()

    camera = UvcCamera(Settings(device="/dev/video9"), ROBOT.sensors.camera, clock, opens=opens)
    monkeypatch.setattr(eyes, "RGBD", Family("rgbd", {registry.SIMULATED: lambda _: camera}))
    states = bus.subscribe(topics.CAMERA_STATE)
    pictures = bus.subscribe(topics.RGBD)
    eye = Eye(Wiring(robot=ROBOT, clock=clock, bus=bus))

    def step(after_s: float) -> str:
        clock.set(clock.now_s() + after_s)
        eye.step()
        return states.latest.code

    with eye:
        yield capture, plugged, step, pictures


def test_the_eye_tells_of_an_unplugged_camera_and_finds_it_again(rig):
    capture, plugged, step, pictures = rig
    capture.show(scene(0))
    assert step(0.1) == ""
    assert len(pictures.take()) == 1
    plugged["in"] = False
    capture.unplug()
    assert eventually(lambda: step(0.0) == "camera_unplugged")  # its thread has to get its turn
    assert step(AGAIN_S + 0.1) == "camera_unplugged"
    plugged["in"] = True
    step(AGAIN_S + 0.1)
    capture.show(scene(1))
    assert step(0.1) == ""


def test_the_eye_tells_of_a_frozen_and_of_a_black_camera(rig):
    capture, _, step, _ = rig
    for _ in range(6):
        capture.show(scene(3))
        code = step(0.1)
    assert code == "camera_frozen"
    for number in range(4):
        capture.show(scene(number, mean=1.0, spread=0.5))
        code = step(0.1)
    assert code == "camera_black"
    assert step(1.0) == "camera_late"
