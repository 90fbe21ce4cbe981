"""Homes as large as somebody wants them: as right as all others."""

import itertools

import pytest

from robot.errors import ConfigError
from sim.homes import catalogue
from sim.homes import home as homes
from sim.homes.choosing import MOST_ROOMS
from sim.homes.home import MOST_THINGS, Size, home
from sim.homes.tasks import tasks
from sim.placing import radius_m
from sim.world_checks import check

LARGE = Size(rooms=12, things=300)


@pytest.fixture
def large(kind):
    return home(kind, 1, LARGE)


def test_a_home_has_as_many_rooms_and_things_as_are_wanted(large):
    assert (len(large.world.rooms), len(large.world.objects)) == (12, 300)
    assert check(large.world) == []


def test_names_are_nobody_elses_in_a_large_home(large):
    world = large.world
    names = [
        name
        for group in (world.rooms, world.spots, world.furniture, world.objects, world.people)
        for entry in group
        for name in (entry.title, *entry.synonyms)
    ]
    assert len(names) == len(set(names))
    assert len({(item.color, item.category) for item in world.objects}) == 300


def test_things_are_apart_in_a_large_home(large):
    on = lambda item: item.on  # noqa: E731
    for _, group in itertools.groupby(sorted(large.world.objects, key=on), key=on):
        for one, other in itertools.combinations(list(group), 2):
            gap = sum((a - b) ** 2 for a, b in zip(one.at_m, other.at_m, strict=True)) ** 0.5
            assert gap - radius_m(one) - radius_m(other) >= 0.05 - 1e-9


def test_there_is_something_to_ask_for_in_a_large_home():
    assert len(tasks(home("clinic", 1, LARGE), 1)) == 10


def test_the_usual_size_draws_as_if_nothing_was_wanted(kind):
    usual = home(kind, 2)
    assert home(kind, 2, Size()).world == usual.world


def test_a_home_may_be_small():
    assert len(home("flat", 1, Size(rooms=2)).world.rooms) == 2


@pytest.mark.parametrize(
    ("kind", "size", "message"),
    [
        ("flat", Size(rooms=1), f"a flat of 1 rooms cannot be made.*from 2 to {MOST_ROOMS}"),
        ("flat", Size(rooms=MOST_ROOMS + 1), "cannot be made"),
        ("flat", Size(rooms=-3), "cannot be made"),
        ("flat", Size(things=MOST_THINGS + 1), "401 things.*from 9 to 400"),
        ("flat", Size(things=0), "0 things"),
    ],
)
def test_a_size_that_cannot_be_is_refused_with_the_range(kind, size, message):
    with pytest.raises(ConfigError, match=message):
        home(kind, 1, size)


def test_every_kind_says_from_how_many_rooms_on_it_can_be_made(kind):
    with pytest.raises(ConfigError, match=r"from \d+ to 16"):
        home(kind, 1, Size(rooms=99))
    assert kind in catalogue.names()


def test_more_things_than_find_room_are_refused_with_what_to_change(monkeypatch):
    monkeypatch.setattr(homes, "TRIES", 1)
    with pytest.raises(ConfigError, match="another seed, more rooms, fewer things"):
        home("flat", 1, Size(rooms=2, things=400))
