"""`humanoid sensors estimate`: a file of poses, or the cure."""

import json

import numpy as np
import pytest

from executive.frontends.recordings.estimate import estimate
from robot.errors import ConfigError
from tests.fakes import legged_logs


@pytest.fixture
def files(tmp_path):
    log = legged_logs.write(tmp_path, legged_logs.standing(samples=80))
    return log, legged_logs.urdf_file(tmp_path), tmp_path / "poses.txt"


def run(files, **options):
    options = {"causal": False, "feet": "", "imu": "", "as_json": False} | options
    return estimate(*files, **options)


@pytest.mark.parametrize("causal", [False, True])
def test_a_pose_a_sample_is_written(files, capsys, causal):
    assert run(files, causal=causal) == 0
    poses = np.loadtxt(files[2])
    assert poses.shape == (80, 8)
    assert poses[:, 0] == pytest.approx(0.01 * np.arange(80))
    assert poses[0, 1:4] == pytest.approx([1.0, 2.0, 0.59])
    assert np.linalg.norm(poses[:, 4:], axis=1) == pytest.approx(1.0)
    assert "Done" in capsys.readouterr().out


def test_json_says_what_was_found(files, capsys):
    run(files, as_json=True)
    told = json.loads(capsys.readouterr().out)
    assert told["samples"] == 80
    assert told["soles"] == ["left_sole_frame", "right_sole_frame"]
    assert told["out"] == str(files[2])


def test_it_may_be_written_again(files):
    run(files)
    assert run(files) == 0


@pytest.mark.parametrize(
    ("changed", "says"),
    [
        ({"log": "gone.npz"}, "gone.npz"),
        ({"log": "robot.urdf"}, "no NumPy archive"),
        ({"urdf": "gone.urdf"}, "gone.urdf"),
        ({"urdf": "log.npz"}, "no UTF-8 text"),
        ({"out": "no/such/folder.txt"}, "cannot be written"),
        ({"out": ""}, "cannot be written"),
    ],
)
def test_a_file_that_will_not_do_is_named(files, tmp_path, changed, says):
    log, urdf, out = files
    named = {"log": log, "urdf": urdf, "out": out}
    named |= {key: tmp_path / name for key, name in changed.items()}
    with pytest.raises(ConfigError, match=says):
        run((named["log"], named["urdf"], named["out"]))


@pytest.mark.parametrize("feet", ["left", "left,", ",right", "a,b,c", "nowhere,right_sole_frame"])
def test_feet_are_two_links(files, feet):
    with pytest.raises(ConfigError):
        run(files, feet=feet)
