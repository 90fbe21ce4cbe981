"""Recordings and maps as files: what is written is read, and what is no such thing is refused."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest

from robot.errors import ConfigError
from robot.fusion.slam import building, map_file, picture, recording
from robot.fusion.slam.relocalising import Relocaliser
from robot.se3 import Array
from tests.fakes import buildings

RECORDINGS = Path(__file__).parents[6] / "shared" / "recordings" / "lidar"


def _way() -> Array:
    x = np.arange(1.2, 5.0, 0.1)
    there = np.column_stack([x, np.full(len(x), 2.5), np.zeros(len(x))])
    turned = np.column_stack([np.full(16, 5.0), np.full(16, 2.5), np.linspace(0, -np.pi, 16)])
    return np.vstack([there, turned, np.column_stack([x[::-1], there[:, 1], there[:, 2] - np.pi])])


@pytest.fixture(scope="module")
def log(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("log") / "room.npz"
    way = _way()
    odometry = buildings.drifting(way, seed=4)
    buildings.write(buildings.recording(buildings.room(), way, odometry), path)
    return path


@pytest.fixture(scope="module")
def saved(log: Path) -> map_file.SavedMap:
    taken = recording.read(log)
    mapper = building.mapped(taken)
    return building.saved_map(building.trajectory(taken, mapper), mapper)


def test_a_map_comes_back_as_it_was_and_always_in_the_same_bytes(
    saved: map_file.SavedMap, tmp_path: Path
):
    for name in ("a.npz", "b.npz"):
        map_file.save(tmp_path / name, saved)
    assert (tmp_path / "a.npz").read_bytes() == (tmp_path / "b.npz").read_bytes()
    back = map_file.load(tmp_path / "a.npz")
    np.testing.assert_array_equal(back.grid.cells, saved.grid.cells)
    np.testing.assert_array_equal(back.trajectory, saved.trajectory)
    np.testing.assert_allclose(back.surface, saved.surface, atol=1e-5)
    assert set(back.places) == {"start", "end"}


def test_the_grid_is_free_where_the_robot_drove_and_full_where_walls_are(
    saved: map_file.SavedMap,
):
    def at(x: float, y: float) -> int:
        start = _way()[0]  # the map begins where the robot did
        place = (np.array([x, y]) - start[:2] - saved.grid.origin_m) / saved.grid.cell_m
        low, high = place.astype(int) - 1, place.astype(int) + 2
        return int(saved.grid.cells[low[0] : high[0], low[1] : high[1]].max())

    assert max(at(x, 2.5) for x in (2.0, 3.0, 4.0)) < 64
    assert min(at(8.0, y) for y in (2.0, 2.5, 3.0)) > 160


def test_no_returns_of_any_lidar_are_none(log: Path, tmp_path: Path):
    with np.load(log) as held:
        arrays = dict(held)
    assert recording.read(log).range_max_m == recording.NO_RETURN_M
    # This one says 5.6 m wherever there is nothing.
    arrays["ranges_cm"] = np.minimum(arrays["ranges_cm"], 560)
    np.savez(tmp_path / "short.npz", **arrays)
    assert recording.read(tmp_path / "short.npz").range_max_m < 5.6


@pytest.mark.parametrize(
    ("name", "value", "says"),
    [
        ("odom", None, "lacks odom"),
        ("odom", np.full((92, 3), np.nan), "row 0 of odom"),
        ("odom", np.zeros((5, 3)), "92 rows"),
        ("ranges_cm", np.zeros(5), r"shape \(n, n\)"),
        ("ranges_cm", np.array([["a"]]), "numbers"),
        ("ranges_cm", np.zeros((0, 180)), "no sweeps"),
        ("angle_inc", np.array(7.0), "degrees"),
        ("angle_min", np.array([0.0, 1.0]), r"shape \(1\)"),
        ("t", np.zeros(3), "92 stamps"),
    ],
)
def test_what_is_no_recording_is_refused(
    log: Path, tmp_path: Path, name: str, value: Array | None, says: str
):
    with np.load(log) as held:
        arrays = dict(held)
    assert len(arrays["odom"]) == 92
    if value is None:
        del arrays[name]
    else:
        arrays[name] = value
        if name == "ranges_cm" and value.size == 0:
            arrays |= {"odom": np.zeros((0, 3)), "t": np.zeros(0)}
    np.savez(tmp_path / "wrong.npz", **arrays)
    with pytest.raises(ConfigError, match=says):
        recording.read(tmp_path / "wrong.npz")


def test_files_that_are_nothing_of_the_kind_are_refused(log: Path, tmp_path: Path):
    os.mkfifo(tmp_path / "fifo.npz")
    (tmp_path / "empty.npz").touch()
    (tmp_path / "text.npz").write_text("t odom")
    whole = log.read_bytes()
    (tmp_path / "torn.npz").write_bytes(whole[: len(whole) // 2])
    (tmp_path / "flipped.npz").write_bytes(whole[:200] + bytes(400) + whole[600:])
    np.savez(tmp_path / "pickle.npz", odom=np.array([{}], dtype=object), ranges_cm=0, angle_min=0,
             angle_inc=0)  # fmt: skip
    for name in ("fifo", "empty", "text", "torn", "flipped", "pickle", "missing"):
        for read in (recording.read, map_file.load):
            with pytest.raises(ConfigError):
                read(tmp_path / f"{name}.npz")
    with pytest.raises(ConfigError, match="map"):
        map_file.load(log)


def test_a_header_that_promises_too_much_is_not_believed(log: Path, tmp_path: Path):
    import io
    import zipfile

    header = io.BytesIO()
    np.lib.format.write_array_header_1_0(
        header, {"descr": "<u2", "fortran_order": False, "shape": (1 << 40, 180)}
    )
    with zipfile.ZipFile(log) as held, zipfile.ZipFile(tmp_path / "huge.npz", "w") as made:
        for name in held.namelist():
            made.writestr(name, header.getvalue() if "ranges" in name else held.read(name))
    with pytest.raises(ConfigError, match="larger than"):
        recording.read(tmp_path / "huge.npz")


def test_a_map_is_drawn(saved: map_file.SavedMap):
    assert picture.drawn(saved).startswith(b"\x89PNG")


def test_a_robot_that_was_carried_away_finds_itself(saved: map_file.SavedMap):
    walls, way = buildings.room(), _way()[20:]
    odometry = buildings.drifting(way, seed=8)
    relocaliser = Relocaliser(saved)
    found = [
        relocaliser.locate(buildings.scan(walls, pose, seed=k), odom)
        for k, (pose, odom) in enumerate(zip(way, odometry, strict=True))
    ]
    assert found[0] is None  # one sweep is not enough
    placed = [(f, w) for f, w in zip(found, way, strict=True) if f is not None]
    assert len(placed) > 20
    for pose, true in placed:  # the map begins where the robot did, with its heading
        assert np.hypot(*(pose[:2] - true[:2] + _way()[0, :2])) < 0.1


def test_a_robot_in_another_building_is_lost(saved: map_file.SavedMap):
    walls, way = buildings.ring(), buildings.rounds(times=0.6)
    relocaliser = Relocaliser(saved)
    for k, pose in enumerate(way):
        assert relocaliser.locate(buildings.scan(walls, pose, seed=k), pose) is None


@pytest.mark.skipif(not RECORDINGS.exists(), reason="the recordings are not here")
def test_the_beginning_of_a_real_recording_is_followed():
    from dataclasses import replace

    path = next(RECORDINGS.glob("*/*_dense_*.npz"))
    whole = recording.read(path)
    some = replace(
        whole, stamps_s=whole.stamps_s[:900], odometry=whole.odometry[:900],
        ranges_cm=whole.ranges_cm[:900],
    )  # fmt: skip
    way = building.trajectory(some, building.mapped(some))
    relations = np.loadtxt(next(path.parent.glob("*.relations")))
    from robot.fusion.slam.planar import between

    errors = []
    for relation in relations[relations[:, :2].max(axis=1) < way[:, 0].max()]:
        near = [int(np.argmin(np.abs(way[:, 0] - stamp))) for stamp in relation[:2]]
        if np.abs(way[near, 0] - relation[:2]).max() <= 0.02:
            said = between(way[near[0], 1:], way[near[1], 1:])
            errors.append(np.hypot(*between(relation[[2, 3, 7]], said)[:2]))
    assert len(errors) > 20
    assert np.mean(errors) < 0.025
