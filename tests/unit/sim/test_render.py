"""Pictures: true where EGL is installed, a clear cure where it is not."""

import struct
import sys
import zlib
from types import SimpleNamespace

import numpy as np
import pytest

from robot.errors import ConfigError
from sim import render
from sim.plant import Plant


def read_png(data: bytes) -> np.ndarray:
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    chunks, at = {}, 8
    while at < len(data):
        (length,) = struct.unpack_from(">I", data, at)
        kind, body = data[at + 4 : at + 8], data[at + 8 : at + 8 + length]
        assert struct.unpack_from(">I", data, at + 8 + length)[0] == zlib.crc32(kind + body)
        chunks[kind] = body
        at += 12 + length
    width, height = struct.unpack_from(">II", chunks[b"IHDR"])
    rows = np.frombuffer(zlib.decompress(chunks[b"IDAT"]), np.uint8).reshape(height, -1)
    assert not rows[:, 0].any()
    return rows[:, 1:].reshape(height, width, 3)


def test_a_png_holds_the_image(tmp_path):
    image = np.random.default_rng(0).integers(0, 256, (5, 7, 3), dtype=np.uint8)
    render.save_png(tmp_path / "x.png", image)
    assert np.array_equal(read_png((tmp_path / "x.png").read_bytes()), image)


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
    red, green, blue = read_png((tmp_path / "x.png").read_bytes())[55:65, 75:85].mean(axis=(0, 1))
    assert red > 2 * green
    assert red > 2 * blue
