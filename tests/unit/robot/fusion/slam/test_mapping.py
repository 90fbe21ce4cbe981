"""Whole recordings of synthetic buildings become trajectories and maps."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from robot.fusion.slam import building
from robot.fusion.slam.mapper import Mapper
from robot.fusion.slam.recording import Recording
from robot.se3 import Array
from tests.fakes import buildings
from tests.fakes.buildings import Lidar

LIDARS = {
    "half circle": Lidar(),
    "twice as fine": Lidar(beams=361, step_rad=np.pi / 360),
    "all around": Lidar(beams=360, first_rad=-np.pi),
}


def _driven(lidar: Lidar = LIDARS["half circle"]) -> tuple[Recording, Array]:
    true = buildings.rounds()
    odometry = buildings.drifting(true, seed=1)
    return buildings.recording(buildings.ring(), true, odometry, lidar), true


@pytest.fixture(scope="module")
def driven() -> tuple[Recording, Array, Mapper]:
    taken, true = _driven()
    return taken, true, building.mapped(taken)


def _mean_m(found: Array, true: Array, apart: int) -> float:
    return float(np.mean(np.hypot(*buildings.errors(found, true, apart=apart)[:, :2].T)))


def test_odometry_alone_is_far_off(driven: tuple[Recording, Array, Mapper]):
    taken, true, _ = driven
    assert _mean_m(taken.odometry, true, apart=200) > 2.0


def test_the_loop_closes(driven: tuple[Recording, Array, Mapper]):
    _, true, mapper = driven
    found = mapper.trajectory()
    assert mapper.graph.loops > 10
    assert _mean_m(found, true, apart=1) < 0.01
    assert _mean_m(found, true, apart=279) < 0.03  # once round and back at the same place


@pytest.mark.parametrize("name", [name for name in LIDARS if name != "half circle"])
def test_other_lidars_are_as_good(name: str):
    taken, true = _driven(LIDARS[name])
    found = building.mapped(taken).trajectory()
    assert _mean_m(found, true, apart=1) < 0.01
    assert _mean_m(found, true, apart=279) < 0.03


def test_the_same_recording_gives_the_same_trajectory(
    driven: tuple[Recording, Array, Mapper],
):
    taken, _, mapper = driven
    np.testing.assert_array_equal(building.mapped(taken).trajectory(), mapper.trajectory())


def test_a_lidar_that_turns_the_other_way_sees_the_same(
    driven: tuple[Recording, Array, Mapper],
):
    taken, true, _ = driven
    found = building.mapped(buildings.clockwise(taken)).trajectory()
    assert _mean_m(found, true, apart=279) < 0.03


def test_stamps_do_not_matter(driven: tuple[Recording, Array, Mapper]):
    taken, _, mapper = driven
    shuffled = replace(taken, stamps_s=np.where(np.arange(len(taken)) % 3, np.nan, 7.0))
    np.testing.assert_array_equal(building.mapped(shuffled).trajectory(), mapper.trajectory())


def test_places_that_look_alike_are_not_taken_for_one():
    # Two equal rooms, one after the other along a way, joined by a corridor that is unlike them.
    walls = [*buildings.room(), *np.add(buildings.room(), [20.0, 0.0, 20.0, 0.0])]
    opened = [w for w in walls if not (w[0] == w[2] and w[0] in (8.0, 20.0))]
    doors = [
        (8.0, 0.0, 8.0, 1.5), (8.0, 3.3, 8.0, 5.0), (20.0, 0.0, 20.0, 1.5), (20.0, 3.3, 20.0, 5.0),
        (8.0, 1.5, 20.0, 1.5), (8.0, 3.3, 20.0, 3.3),
        *buildings.box(10.0, 1.5, 0.5, 0.4), *buildings.box(13.1, 2.9, 0.3, 0.4),
        *buildings.box(17.0, 1.5, 0.2, 0.3),
    ]  # fmt: skip
    building_walls = np.array([*opened, *doors])
    x = np.arange(1.0, 26.0, 0.15)
    true = np.column_stack([x, np.full(len(x), 2.4), np.zeros(len(x))])
    taken = buildings.recording(building_walls, true, buildings.drifting(true, seed=2))
    mapper = building.mapped(taken)
    found = mapper.trajectory()
    assert abs(found[-1, 0] - 25.0) < 0.5


def test_a_robot_that_was_turned_by_hand_knows_where_it_looks():
    walls = buildings.room()
    x = np.arange(1.2, 5.0, 0.1)
    before = np.column_stack([x, np.full(len(x), 2.5), np.zeros(len(x))])
    after = np.column_stack([x[::-1], np.full(len(x), 2.5), np.full(len(x), -np.pi)])
    true = np.vstack([before, after])
    # The wheels feel nothing of being lifted and put down the other way round.
    odometry = np.vstack([before, np.add(before, [before[-1, 0] - before[0, 0], 0.0, 0.0])])
    lidar = LIDARS["all around"]
    found = building.mapped(buildings.recording(walls, true, odometry, lidar)).trajectory()
    error = buildings.errors(found, true, apart=len(before))
    assert np.hypot(*error[-20:, :2].T).max() < 0.05
    assert np.abs(error[-20:, 2]).max() < np.radians(1.0)
