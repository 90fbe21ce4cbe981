"""Homes as untidy as where people live are right worlds, and other ones stay as they were."""

import math

import pytest

from sim import atlas
from sim.homes.home import home
from sim.homes.lived_in import CHAIR_M, FLAT
from sim.homes.surfaces import HIGHEST_GRASP_M
from sim.homes.tasks import tasks
from sim.simulation import Simulation
from sim.world_checks import check

SEEDS = range(4)


@pytest.fixture(scope="module")
def lived_in():
    return [home(kind, seed, is_lived_in=True) for kind in ("flat", "office") for seed in SEEDS]


def test_they_are_right_and_ten_wishes_are_to_be_had(lived_in):
    for seed, made in enumerate(lived_in):
        assert check(made.world) == []
        assert len(tasks(made, seed)) == 10


def test_a_seed_is_always_the_same_and_the_tidy_home_is_another(lived_in):
    text = Simulation().home("flat", seed=0, file="", is_lived_in=True).world
    assert text == Simulation().home("flat", seed=0, file="", is_lived_in=True).world
    assert "--lived-in" in text.splitlines()[0]
    assert home("flat", 0).world != lived_in[0].world


def test_they_have_what_real_homes_have(lived_in):
    worlds = [made.world for made in lived_in]
    things = [item for world in worlds for item in world.objects]
    pieces = [item for world in worlds for item in world.furniture]
    assert any(item.lies for item in things)
    assert any(item.category in FLAT for item in things)
    assert any(item.id.endswith("_chair") and item.size_m == CHAIR_M for item in pieces)
    assert any(item.kind == "table" and item.size_m and item.size_m[0] > 0.75 for item in pieces)
    assert any(
        item.boards_m and item.boards_m[0] < 0.5 < 1.3 < item.boards_m[-1] for item in pieces
    )


def test_all_things_can_be_stood_at_and_none_lies_too_high(lived_in):
    for made in lived_in:
        surfaces = {surface.place.id: surface for surface in made.surfaces}
        places = atlas.places(made.world)
        for item in made.world.objects:
            assert surfaces[item.on].standing(item.at_m or (0.0, 0.0)) is not None
            assert places[item.on].X_WP.p[2] + item.height_m / 2 <= HIGHEST_GRASP_M


def test_now_and_then_somebody_stands_in_a_doorway(lived_in):
    near_m = [
        math.dist(person.at_m, _middle(room, door))
        for made in lived_in
        for person in made.world.people
        for room in made.world.rooms
        for door in room.doors
    ]
    assert min(near_m) < 0.4


def _middle(room, door):
    along = 0 if door.wall in ("north", "south") else 1
    sign = 1.0 if door.wall in ("north", "east") else -1.0
    at = list(room.at_m)
    at[along] += door.at_m
    at[1 - along] += sign * room.size_m[1 - along] / 2
    return at
