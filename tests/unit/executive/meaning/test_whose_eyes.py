"""Whose eyes count is settled where robot and world meet: its own where they were tried."""

import pytest

from executive.meaning import own_eyes, request
from sim.simulation import Simulation


def seen_by(asked, world, robot="juno", **how):
    there = Simulation(eyes=asked)
    return request.setting(there, world, robot=robot, **how).world


@pytest.mark.parametrize("world", ["kitchen", "bench"])
def test_its_own_eyes_count_where_they_were_tried_however_it_is_shuffled(world):
    assert seen_by("auto", world).eyes == "camera"
    assert seen_by("auto", world, vary_seed=3).eyes == "camera"


def test_an_oracle_tells_everywhere_else():
    assert seen_by("auto", "empty").eyes == "oracle"
    assert seen_by("auto", "flat:7").eyes == "oracle"
    assert own_eyes.trusted(seen_by("oracle", "kitchen"), "unitree_g1") == "oracle"


def test_who_is_asked_for_by_name_it_is():
    assert seen_by("oracle", "kitchen").eyes == "oracle"
    assert seen_by("camera", "flat:7").eyes == "camera"


def test_with_its_own_eyes_it_is_told_other_masses_than_the_world_has():
    masses = {info.id: info.mass_kg for info in seen_by("oracle", "kitchen").map.objects}
    told = {info.id: info.mass_kg for info in seen_by("auto", "kitchen").map.objects}
    assert told.keys() == masses.keys()
    assert any(told[id] != masses[id] for id in masses)
