"""`humanoid sensors snap`: a picture of what the robot sees, and clear words where it cannot be."""

import json

import numpy as np
import pytest
from PIL import Image
from typer.testing import CliRunner

from executive.frontends.cli import app
from executive.frontends.depth_picture import in_colours, side_by_side, span_m
from robot.errors import ConfigError
from robot.messages import RgbdImage
from sim.simulation import Simulation


def snap(*words):
    return CliRunner().invoke(app, ["sensors", "snap", *map(str, words)])


def test_colours_and_depth_are_written_side_by_side_and_told_as_json(tmp_path):
    out, data = tmp_path / "seen.png", tmp_path / "seen.npz"
    result = snap("--size", "64x48", "--renderer", "rays", "-o", out, "--data", data, "--json",
                  "--at", "0.75,0.2,20", "--head", "0,40")  # fmt: skip
    assert result.exit_code == 0, result.output
    told = json.loads(result.stdout)
    assert (told["width"], told["height"], told["by"]) == (64, 48, "rays")
    assert told["fovy_deg"] == pytest.approx(60.0, abs=0.1)
    with Image.open(out) as picture:
        assert picture.size[0] == 128
    with np.load(data) as arrays:
        assert arrays["colours"].shape == (48, 64, 3)
        assert arrays["depth_m"].shape == (48, 64)
        assert np.allclose(arrays["matrix"], told["matrix"])


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["-o", "seen.gif"], "call it seen.png"),
        (["-o", "seen.png", "--size", "10"], "is no size of a picture"),
        (["-o", "seen.png", "--size", "9999x9999"], "from 16x16 to 1920x1080"),
        (["-o", "seen.png", "--at", "1,2"], "--at wants 3 numbers"),
        (["-o", "seen.png", "--head", "left"], "--head wants 2 numbers"),
        (["-o", "seen.png", "--head", "0,10", "--robot", "g1"], "no neck"),
        (["-o", "seen.png", "--data", "seen.txt"], "call it seen.npz"),
        (["-o", "nowhere/seen.png", "--size", "16x16"], "No such file"),
    ],
)
def test_what_cannot_be_meant_is_said_with_its_cure(words, said, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result = snap(*words)
    assert isinstance(result.exception, ConfigError)
    assert said in str(result.exception)
    assert not list(tmp_path.glob("*"))


def test_near_is_red_far_is_blue_and_nothing_is_black():
    depth_m = np.array([[0.5, 3.0, 0.0]], np.float32)
    near, far, nothing = in_colours(depth_m, 0.5, 3.0)[0]
    assert near[0] > near[2]
    assert far[2] > far[1]
    assert nothing.tolist() == [0, 0, 0]


def test_a_camera_without_depth_is_shown_as_it_is():
    colours = np.full((24, 32, 3), 77, np.uint8)
    image = RgbdImage(
        stamp_s=0.0, width=32, height=24, focal_px=(20.0, 20.0), centre_px=(15.5, 11.5),
        frame="head_camera", colours=colours.tobytes(),
    )  # fmt: skip
    assert image.depth() is None
    assert np.array_equal(side_by_side(image), colours)
    assert span_m(np.zeros((2, 2), np.float32)) == (0.0, 1.0)


def test_things_are_boxed_and_told_with_place_and_size(tmp_path):
    pytest.importorskip("onnxruntime", reason="the extra `vision` is not installed")
    out = tmp_path / "things.png"
    result = snap("--things", "--renderer", "rays", "-o", out, "--json", "--reality", "real",
                  "--at", "0.75,0.2,20", "--head", "0,40")  # fmt: skip
    assert result.exit_code == 0, result.output
    told = json.loads(result.stdout)["things"]
    with Image.open(out) as picture:
        assert picture.size == (640, 480)
    begins = Simulation("real").world("kitchen").objects()
    for name, colour in (("red_cup", "red"), ("blue_cup", "blue")):
        truth = np.array(begins[name].X_WO.p)
        near = min(told, key=lambda one, p=truth: np.linalg.norm(np.array(one["position"]) - p))
        assert np.linalg.norm(np.array(near["position"]) - truth) < 0.03
        assert colour in near["colours"]
        assert near["size"][2] == pytest.approx(0.10, abs=0.03)
        assert near["box"][0] < near["box"][2]
