"""Commands that look at recordings: what they print, what they say where something is missing."""

import json
import sys

import numpy as np
import pytest
from PIL import Image
from typer.testing import CliRunner

from executive.frontends.cli import app
from robot.errors import ConfigError
from tests.fakes.walkers import recorded


@pytest.fixture
def humanoid():
    def run(*words):
        return CliRunner().invoke(app, [str(word) for word in words])

    return run


@pytest.fixture
def without(monkeypatch):
    """Make a library one that is not installed."""

    def forget(name):
        monkeypatch.setitem(sys.modules, name, None)

    return forget


@pytest.fixture(scope="module")
def log(tmp_path_factory):
    scans, _ = recorded([[(3.2, -1.0), (3.2, 1.2)]], seconds=5.0)
    path = tmp_path_factory.mktemp("logs") / "walk.npz"
    np.savez(
        path,
        scan_t=[scan.t_s for scan in scans],
        scan_ranges_mm=np.array([scan.ranges_m * 1000 for scan in scans]).astype(np.uint16),
        scan_angle=[scans[0].angle_min_rad, scans[0].angle_step_rad],
    )
    return path


def test_people_are_a_json_line_a_scan(humanoid, log):
    result = humanoid("people", "--json", "--log", log)
    assert result.exit_code == 0
    lines = [json.loads(line) for line in result.stdout.splitlines()]
    assert len(lines) == 50
    assert lines[7]["t"] == pytest.approx(0.7)
    (person,) = lines[25]["people"]
    assert set(person) == {"id", "x", "y", "vx", "vy", "score"}
    assert person["x"] == pytest.approx(3.2, abs=0.2)
    assert {leg["id"] for leg in lines[25]["legs"]} == {person["id"]}
    assert all(set(leg) == {"id", "x", "y", "score"} for leg in lines[25]["legs"])


def test_people_for_people_are_a_table(humanoid, log):
    result = humanoid("people", "--log", log)
    assert result.exit_code == 0
    assert "50 scans over 4.9 s" in result.stdout
    assert len(result.stdout.splitlines()) == 3  # one person


def test_causal_knows_nobody_in_the_first_scan(humanoid, log):
    whole = humanoid("people", "--json", "--log", log).stdout.splitlines()
    causal = humanoid("people", "--json", "--causal", "--log", log).stdout.splitlines()
    assert json.loads(whole[0])["people"]
    assert not json.loads(causal[0])["people"]
    assert json.loads(causal[-1])["people"]


def test_without_a_model_detect_says_that_there_is_none(humanoid, tmp_path):
    result = humanoid("detect", tmp_path / "a.png")
    assert isinstance(result.exception, ConfigError)
    assert "no model for detection comes along" in str(result.exception)
    assert "--model FILE.onnx" in str(result.exception)
    result = humanoid("detect", tmp_path / "a.png", "--model", tmp_path / "m.onnx")
    assert "--labels" in str(result.exception)


def test_without_opencv_or_onnxruntime_the_cure_is_named(humanoid, without, tmp_path):
    Image.new("L", (64, 48)).save(tmp_path / "a.png")
    (tmp_path / "names.txt").write_text("cup\n")
    without("cv2")
    board = ("--board", "chessboard:9x6:0.025")
    result = humanoid("calibrate", "camera", "--images", tmp_path, *board)
    assert "pip install 'humanoid-executive[vision]'" in str(result.exception)
    without("onnxruntime")
    files = ("--model", tmp_path / "m.onnx", "--labels", tmp_path / "names.txt")
    result = humanoid("detect", tmp_path / "a.png", *files)
    assert "pip install onnxruntime" in str(result.exception)


def test_a_broken_picture_is_a_line_and_the_rest_is_done(humanoid, tmp_path, monkeypatch):
    from robot.perception.detector import detector

    class Blind:
        size = (64, 64)

        def __init__(self, path):
            pass

        def __call__(self, tensor):
            return np.array([[[8, 16, 24, 32, 0.7512345, 0]]], dtype=np.float32)

    monkeypatch.setattr(detector, "Network", Blind)
    Image.new("RGB", (64, 64)).save(tmp_path / "good.png")
    (tmp_path / "bad.png").write_text("no picture")
    (tmp_path / "names.txt").write_text("cup\nbowl\nfork\n")
    files = ("--model", "any.onnx", "--labels", tmp_path / "names.txt")
    result = humanoid("detect", tmp_path / "bad.png", tmp_path / "good.png", *files, "--json")
    assert result.exit_code == 2
    bad, good = (json.loads(line) for line in result.stdout.splitlines())
    assert bad == {"image": str(tmp_path / "bad.png"), "error": "this is no picture"}
    assert good["width"] == good["height"] == 64
    expected = {"name": "cup", "score": 0.7512, "box": [8.0, 16.0, 24.0, 32.0]}
    assert good["detections"] == [expected]


def test_calibration_writes_no_file_twice(humanoid, tmp_path):
    taken = tmp_path / "camera.yaml"
    taken.write_text("mine")
    options = ("--images", tmp_path, "--board", "chessboard:9x6:0.025", "--out", taken)
    result = humanoid("calibrate", "camera", *options)
    assert "there already" in str(result.exception)
    assert taken.read_text() == "mine"
