"""Maps are known by what stands fast in a world, and a robot is led to all of it."""

import os

import msgspec
import pytest

from executive.meaning import request
from executive.runs import lidar_maps
from executive.runs.lidar_maps import led_walk
from executive.runs.lidar_maps.led_walk import goals_of
from robot.errors import ConfigError
from robot.fusion.slam import map_file
from sim import world
from sim.simulation import SimulatedWorld, Simulation
from tests.fakes.bodies import shipped_or_skip

LIDAR = Simulation(localisation="lidar")
REAL = Simulation("real")


def where(name="kitchen", *, vary_seed=None, reality=LIDAR, robot="juno"):
    return request.setting(reality, name, robot=robot, vary_seed=vary_seed)


def furnished(**changes):
    """The kitchen with another first piece of furniture."""
    entries = world.load("kitchen")
    first = msgspec.structs.replace(entries.furniture[0], **changes)
    other = msgspec.structs.replace(entries, furniture=(first, *entries.furniture[1:]))
    return msgspec.structs.replace(where(), world=SimulatedWorld(other, localisation="lidar"))


def test_a_shuffled_world_has_the_same_map_and_another_house_another():
    assert lidar_maps.key_of(where()) == lidar_maps.key_of(where(vary_seed=3))
    assert lidar_maps.key_of(where()) != lidar_maps.key_of(where("bench"))
    assert lidar_maps.key_of(where()) != lidar_maps.key_of(furnished(at_m=(1.4, 0.3)))


def test_a_robot_that_is_told_where_it_is_needs_none():
    assert lidar_maps.needed(where(reality=Simulation())) is None


@pytest.mark.parametrize("robot", ["juno", "t1"])
def test_the_kitchen_comes_with_its_map(robot):
    def never(text):
        pytest.fail(f"it is made anew ({text}): see docs/localisation.md, and ship the new one")

    path = lidar_maps.needed(where(vary_seed=1, robot=shipped_or_skip(robot)), tell=never)
    saved = map_file.load(path)
    assert len(saved.surface) > 300 and 0.55 < saved.height_m < 0.7


@pytest.fixture
def surveyed(tmp_path, monkeypatch):
    """Worlds that were led through, in a cache of their own; each gets the map of the kitchen."""
    kitchen = map_file.load(lidar_maps.needed(where()))
    led: list[str] = []

    def survey(setting, *, tell):
        led.append(setting.world.name)
        return kitchen

    monkeypatch.setattr(led_walk, "survey", survey)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    return led


@pytest.mark.parametrize(
    "broken", [b"", b"PK\x03\x04", lambda whole: whole[: len(whole) // 2], lambda _: b"x" * 5000]
)
def test_a_kept_map_that_cannot_be_read_is_made_again_and_said(surveyed, broken):
    told: list[str] = []
    path = lidar_maps.needed(where("bench"), tell=told.append)
    whole = path.read_bytes()
    assert lidar_maps.needed(where("bench"), tell=pytest.fail) == path
    path.write_bytes(broken(whole) if callable(broken) else broken)
    assert lidar_maps.needed(where("bench"), tell=told.append) == path
    assert path.read_bytes() == whole and len(surveyed) == 2
    assert any("is made again" in text for text in told)


def test_a_kept_map_that_others_could_exchange_says_nobody_where_the_robot_is(surveyed, tmp_path):
    path = lidar_maps.needed(where("bench"), tell=lambda _: None)
    tmp_path.chmod(0o777)
    with pytest.raises(ConfigError, match="every user") as refused:
        lidar_maps.needed(where("bench"))
    assert "XDG_CACHE_HOME" in refused.value.problems[0].suggestion
    tmp_path.chmod(0o700)
    if os.geteuid() == 0:
        os.chown(path, 65534, 65534)
        with pytest.raises(ConfigError, match="another user"):
            lidar_maps.needed(where("bench"))


def settled(asked, name="kitchen", **how):
    """Who tells it where it is, and what was told people."""
    told: list[str] = []
    found = lidar_maps.localised(where(name, reality=REAL), asked, tell=told.append, **how)
    assert found.reality.localisation == found.world.localisation
    assert (found.world.profile, found.world.vary_seed) == ("real", None)
    return found.world.localisation, told


def test_its_own_lidar_tells_it_where_a_map_is_and_an_oracle_elsewhere_which_is_said(surveyed):
    assert settled("auto") == ("lidar", [])
    by, told = settled("auto", "bench")
    assert by == "oracle" and len(told) == 1
    assert "oracle" in told[0] and "bench" in told[0] and "--localisation lidar" in told[0]
    lidar_maps.needed(where("bench"), tell=lambda _: None)
    assert settled("auto", "bench") == ("lidar", [])
    by, told = settled("auto", "bench", shipped_only=True)
    assert by == "oracle" and len(told) == 1


def test_what_is_asked_for_is_done_and_needs_no_words(surveyed):
    assert settled("oracle") == ("oracle", [])
    assert settled("lidar", "bench") == ("lidar", [])
    assert not surveyed, "it is led through when it starts, not before"


def test_nothing_is_found_in_a_map_that_is_broken_or_of_somebody_else(surveyed, tmp_path):
    path = lidar_maps.needed(where("bench"), tell=lambda _: None)
    whole = path.read_bytes()
    path.write_bytes(whole[:100])
    assert settled("auto", "bench")[0] == "oracle"
    path.write_bytes(whole)
    assert settled("auto", "bench")[0] == "lidar"
    tmp_path.chmod(0o777)
    assert settled("auto", "bench")[0] == "oracle"
    assert len(surveyed) == 1


def test_the_robot_is_led_to_every_room_and_comes_back():
    goals = goals_of(where("flat:3").world_map)
    rooms = {place.id for place in where("flat:3").world_map.places if place.id == place.room}
    assert rooms <= set(goals)
    assert goals[0] == goals[-1] and len(set(goals)) == len(goals) - 1
