"""Pictures: true where EGL is installed, a clear cure where it is not."""

import sys
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image

from robot.errors import ConfigError
from sim import render
from sim.plant import Plant


@pytest.mark.parametrize(
    ("name", "kind", "apart"), [("x.png", "PNG", 0), ("x.jpg", "JPEG", 8), ("X.JPEG", "JPEG", 8)]
)
def test_a_picture_is_what_its_name_says(tmp_path, name, kind, apart):
    ramp = np.linspace(0, 255, 16, dtype=np.uint8)
    image = np.repeat(np.add.outer(ramp // 2, ramp // 2)[:, :, None], 3, axis=2)
    render.save_picture(tmp_path / name, image)
    with Image.open(tmp_path / name) as found:
        assert found.format == kind
        assert np.abs(np.asarray(found).astype(int) - image).max() <= apart


def test_without_egl_the_error_names_the_packages(robot, kitchen, tmp_path, monkeypatch):
    def missing(_width: int, _height: int) -> None:
        raise AttributeError("'NoneType' object has no attribute 'eglQueryString'")

    plant = Plant(kitchen, robot, seed=0)
    monkeypatch.setitem(sys.modules, "mujoco.egl", SimpleNamespace(GLContext=missing))
    with pytest.raises(ConfigError, match="libegl1 libgl1-mesa-dri libopengl0"):
        render.snapshot(plant, tmp_path / "x.png")


def test_without_a_viewer_the_error_says_so(robot, kitchen, monkeypatch):
    monkeypatch.setitem(sys.modules, "mujoco.viewer", None)
    with pytest.raises(ConfigError, match="no viewer"):
        render.show(Plant(kitchen, robot, seed=0))


def test_a_snapshot_shows_the_red_cup(robot, kitchen, tmp_path):
    plant = Plant(kitchen, robot, seed=0)
    at = plant.oracle.X_WO("red_cup").p
    view = render.View(at=at, distance_m=0.8, heading_deg=90.0, down_deg=30.0)
    try:
        render.snapshot(plant, tmp_path / "x.png", view=view, width=160, height=120)
    except ConfigError as error:
        pytest.skip(str(error))
    with Image.open(tmp_path / "x.png") as found:
        red, green, blue = np.asarray(found)[55:65, 75:85].mean(axis=(0, 1))
    assert red > 2 * green
    assert red > 2 * blue
