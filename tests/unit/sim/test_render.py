"""Pictures: true where EGL is installed, and where it is not."""

import sys
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image

from robot.errors import ConfigError
from sim import render
from sim.gl_context import gl_context
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


@pytest.fixture
def without_egl(monkeypatch):
    def missing(_width: int, _height: int) -> None:
        raise AttributeError("'NoneType' object has no attribute 'eglQueryString'")

    monkeypatch.setitem(sys.modules, "mujoco.egl", SimpleNamespace(GLContext=missing))


def test_without_egl_the_error_names_the_packages(without_egl):
    with pytest.raises(ConfigError, match="libegl1 libgl1-mesa-dri libopengl0"):
        gl_context(16, 16)


def test_without_a_viewer_the_error_says_so(robot, kitchen, monkeypatch):
    monkeypatch.setitem(sys.modules, "mujoco.viewer", None)
    with pytest.raises(ConfigError, match="no viewer"):
        render.show(Plant(kitchen, robot, seed=0))


def shows_the_red_cup(robot, kitchen, path) -> bool:
    plant = Plant(kitchen, robot, seed=0)
    at = plant.oracle.X_WO("red_cup").p
    view = render.View(at=at, distance_m=0.8, heading_deg=90.0, down_deg=30.0)
    render.snapshot(plant, path, view=view, width=160, height=120)
    with Image.open(path) as found:
        red, green, blue = np.asarray(found)[55:65, 75:85].mean(axis=(0, 1))
    return red > 2 * green and red > 2 * blue


def test_a_snapshot_shows_the_red_cup(robot, kitchen, tmp_path):
    assert shows_the_red_cup(robot, kitchen, tmp_path / "x.png")


def test_and_so_it_does_without_egl(robot, kitchen, tmp_path, without_egl):
    assert shows_the_red_cup(robot, kitchen, tmp_path / "x.png")


def test_rays_show_what_egl_shows(robot, kitchen, request):
    """From anywhere: the same things at the same places, but for shadows, and their edges."""
    plant = Plant(kitchen, robot, seed=0)
    views = [render.overview(kitchen), render.View(heading_deg=-40.0, down_deg=70.0)]
    drawn = {}
    for by in ("EGL", "rays"):
        if by == "rays":
            request.getfixturevalue("without_egl")
        with render.Renderer(plant.model, width=160, height=120) as renderer:
            if renderer.by != by:
                pytest.skip("EGL is not here")
            drawn[by] = [renderer.image(plant.data, view).astype(int) for view in views]
    for by_gl, by_rays in zip(drawn["EGL"], drawn["rays"], strict=True):
        apart = np.abs(by_gl - by_rays).max(axis=-1)
        assert np.mean(apart < 30) > 0.85  # elsewhere EGL has shadows
