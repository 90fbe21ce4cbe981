"""`humanoid sensors record`: what it writes the commands for recordings can read, and is true."""

import json
import math

import numpy as np
import pytest

from executive.frontends.recordings import estimate, maps, record
from robot.errors import ConfigError
from robot.fusion.slam import recording


def asked(folder, **changes):
    options = {
        "world": "kitchen", "robot": "juno", "seed": 0, "reality": "real", "out": folder,
        "longest_s": 1.0, "as_json": True,
    }  # fmt: skip
    return record.Asked(**options | changes)


@pytest.fixture(scope="module")
def walk(tmp_path_factory):
    folder = tmp_path_factory.mktemp("recorded") / "walk"
    assert record.record(asked(folder)) == 0
    return folder


def test_legs_and_imu_tell_where_the_base_truly_went(walk):
    out = walk / "poses.txt"
    estimate.estimate(
        walk / record.LEGS, walk / record.URDF, out, causal=True, feet="", imu="", as_json=True
    )
    true, poses = np.loadtxt(walk / record.TRUTH), np.loadtxt(out)
    assert np.array_equal(true[:, 0].round(6), poses[:, 0].round(6))
    way_m = math.dist(true[0, 1:3], true[-1, 1:3])
    assert way_m > 0.5
    assert np.linalg.norm(true[:, 1:4] - poses[:, 1:4], axis=1).max() < 0.03 + 0.01 * way_m


def test_the_lidars_scans_make_a_map_along_the_same_way(walk, capsys):
    out = walk / "way.txt"
    assert maps.build(walk / record.LIDAR, out, out=walk / "map.npz", as_json=True) == 0
    told = json.loads(capsys.readouterr().out)
    true = np.loadtxt(walk / record.TRUTH)
    assert told["sweeps"] == len(recording.read(walk / record.LIDAR))
    assert told["way_m"] == pytest.approx(_length_m(true[::50, 1:3]), abs=0.5)


def test_a_folder_that_cannot_be_is_said_before_it_walks(tmp_path, monkeypatch):
    monkeypatch.setattr(record.recorded_walk, "record", lambda *_, **__: pytest.fail("it walked"))
    (tmp_path / "file").write_text("")
    with pytest.raises(ConfigError, match="cannot be written"):
        record.record(asked(tmp_path / "file" / "walk"))


def test_a_recording_that_is_there_stays(tmp_path, monkeypatch):
    monkeypatch.setattr(record.recorded_walk, "record", lambda *_, **__: pytest.fail("it walked"))
    (tmp_path / record.LEGS).write_text("somebody's own")
    with pytest.raises(ConfigError, match="there already"):
        record.record(asked(tmp_path))
    assert [path.name for path in tmp_path.iterdir()] == [record.LEGS]


def test_a_walk_that_is_cut_off_leaves_nothing(tmp_path, monkeypatch):
    def cut_off(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(record.recorded_walk, "record", cut_off)
    with pytest.raises(KeyboardInterrupt):
        record.record(asked(tmp_path))
    assert not list(tmp_path.iterdir())


def _length_m(points):
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())
