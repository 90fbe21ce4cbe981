"""Sweeps laid on a map: the pose is found, the search is exact, contradictions are seen."""

from __future__ import annotations

import numpy as np
import pytest

from robot.fusion.slam.agreement import contradicted
from robot.fusion.slam.matching import match
from robot.fusion.slam.patch import Patch
from robot.fusion.slam.planar import between, compose, inverse, placed, wrapped
from robot.fusion.slam.raster import Raster
from robot.fusion.slam.scan import scan_of
from tests.fakes import buildings

POSES = np.array([[1.5, 1.0, 0.3], [1.8, 2.5, 0.0], [4.0, 2.8, 3.0]])


def _patch() -> Patch:
    walls = buildings.room()
    return Patch.of([buildings.scan(walls, pose, seed=k) for k, pose in enumerate(POSES)], POSES)


def test_poses_form_a_group():
    rng = np.random.default_rng(0)
    a, b = rng.uniform(-3, 3, (2, 50, 3))
    np.testing.assert_allclose(between(a, compose(a, b))[:, :2], b[:, :2], atol=1e-12)
    np.testing.assert_allclose(wrapped(between(a, compose(a, b))[:, 2] - b[:, 2]), 0, atol=1e-12)
    there = compose(a[0], inverse(a[0]))
    np.testing.assert_allclose(there, 0.0, atol=1e-12)


@pytest.mark.parametrize("seed", range(6))
def test_a_known_pose_is_found_from_odometrys_guess(seed: int):
    rng = np.random.default_rng(seed)
    true = np.array([*rng.uniform([1.2, 1.0], [5.0, 3.0]), rng.uniform(-0.6, 0.6)])
    seen = buildings.scan(buildings.room(), true, seed=seed + 10)
    start = true + rng.uniform(-1, 1, 3) * [0.2, 0.2, 0.1]
    found = match(_patch(), seen.points, seen.normals, start)
    assert np.hypot(*(found.pose - true)[:2]) < 0.015
    assert abs(found.pose[2] - true[2]) < np.radians(0.3)
    assert found.fit > 0.8


def test_what_walls_leave_open_odometry_decides():
    walls = np.array([(-50, 0, 50, 0), (-50, 2, 50, 2)], dtype=float)
    patch = Patch.of(
        [buildings.scan(walls, np.array([0.0, 1.0, 0.0]))], [np.array([0.0, 1.0, 0.0])]
    )
    seen = buildings.scan(walls, np.array([0.4, 1.1, 0.02]), seed=1)
    prior = np.diag([1 / 0.05**2, 1 / 0.05**2, 1 / 0.05**2])
    found = match(patch, seen.points, seen.normals, np.array([0.37, 1.0, 0.0]), prior=prior)
    assert abs(found.pose[1] - 1.1) < 0.01
    assert abs(found.pose[0] - 0.37) < 0.05
    weakest = np.linalg.eigvalsh(found.information)
    assert weakest[0] < 0.02 * weakest[1]


def test_the_search_finds_the_best_of_all_poses_of_its_window():
    patch = _patch()
    raster = Raster(patch.points, levels=4, reach_m=1.0)
    seen = buildings.scan(buildings.room(), np.array([2.2, 1.9, 0.5]), seed=5)
    points = seen.points[::6]
    center = np.array([2.0, 2.0, 0.4])
    found = raster.search(points, center, reach_m=0.5, reach_rad=0.2, step_rad=0.1, least=0.0)
    assert found is not None
    grid = raster._levels[0]
    best = 0.0
    for heading in center[2] + 0.1 * np.arange(-2, 3):
        local = placed(np.array([*center[:2], heading]), points)
        cells = np.floor(local / raster.cell_m).astype(int) - raster._low
        for dx in range(-5, 6):
            for dy in range(-5, 6):
                x, y = np.add(cells, [dx, dy]).T
                inside = (x >= 0) & (y >= 0) & (x < grid.shape[0]) & (y < grid.shape[1])
                values = grid[np.where(inside, x, 0), np.where(inside, y, 0)] * inside
                best = max(best, values.mean() / 255.0)
    assert found.score == pytest.approx(best)


def test_a_search_from_afar_finds_the_pose():
    true = np.array([3.6, 2.4, 1.2])
    seen = buildings.scan(buildings.room(), true, seed=5)
    raster = Raster(_patch().filled(0.1), levels=6, reach_m=4.0)
    found = raster.search(
        seen.points, np.array([2.0, 1.5, 0.4]), reach_m=3.0, reach_rad=1.0, step_rad=0.03, least=0.5
    )
    assert found is not None
    assert np.hypot(*(found.pose - true)[:2]) < 0.15
    assert abs(found.pose[2] - true[2]) < 0.05


def test_points_in_the_open_contradict_and_points_on_walls_do_not():
    patch = _patch()
    on_walls = buildings.scan(buildings.room(), np.array([2.0, 2.0, 0.2]), seed=9)
    assert contradicted(patch, placed(np.array([2.0, 2.0, 0.2]), on_walls.points)) < 0.05
    in_the_open = np.random.default_rng(0).uniform([2.0, 2.2], [4.0, 3.8], (100, 2))
    assert contradicted(patch, in_the_open) > 0.8


def test_a_person_in_front_of_a_wall_is_left_out():
    walls = buildings.room()
    pose = np.array([4.0, 2.0, 0.0])
    alone = buildings.ranges_m(walls, pose)
    with_person = buildings.ranges_m(np.vstack([walls, buildings.box(5.5, 1.9, 0.3, 0.3)]), pose)
    assert (alone != with_person).any()
    lidar = buildings.Lidar()
    kept = [
        scan_of(ranges, lidar.first_rad, lidar.step_rad, range_max_m=30.0).points
        for ranges in (alone, with_person)
    ]
    distances = np.hypot(*(kept[1][:, None] - [1.5, 0.0]).reshape(-1, 2).T)
    assert distances.min() > 0.6
    assert len(kept[1]) >= len(kept[0]) - 14


def test_beams_without_a_return_are_no_points():
    ranges = np.array([1.0, np.nan, np.inf, 0.0, -1.0, 30.0, 81.83, 1.1, 1.2, 1.3])
    assert len(scan_of(ranges, 0.0, 0.01, range_max_m=30.0).points) == 4


def test_points_in_two_heaps_far_apart_are_a_map_of_one_of_them_and_none_of_nothing():
    heaps = np.array([[0.0, 0.0], [1.0, 0.0], [1e6, 0.0], [1e6 + 1.0, 0.0]])
    here = np.array([0.0, 0.0, 0.0])
    for points, least in ((heaps, 0.9), (np.zeros((0, 2)), 0.0)):
        raster = Raster(points, levels=2, reach_m=1.0)
        found = raster.search(heaps[:2], here, reach_m=0.5, reach_rad=0.1, step_rad=0.05, least=0.5)
        assert (found.score if found is not None else 0.0) >= least
        assert found is not None or not len(points)
