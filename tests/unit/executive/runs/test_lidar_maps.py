"""Maps are known by what stands fast in a world, and a robot is led to all of it."""

import msgspec
import pytest

from executive.meaning import request
from executive.runs import lidar_maps
from executive.runs.lidar_maps.led_walk import goals_of
from robot.fusion.slam import map_file
from sim import world
from sim.simulation import SimulatedWorld, Simulation

LIDAR = Simulation(localisation="lidar")


def where(name="kitchen", *, vary_seed=None, reality=LIDAR):
    return request.setting(reality, name, robot="juno", vary_seed=vary_seed)


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


def test_the_kitchen_comes_with_its_map():
    def never(text):
        pytest.fail(f"it is made anew ({text}): see docs/localisation.md, and ship the new one")

    path = lidar_maps.needed(where(vary_seed=1), tell=never)
    saved = map_file.load(path)
    assert len(saved.surface) > 300 and 0.6 < saved.height_m < 0.7


def test_the_robot_is_led_to_every_room_and_comes_back():
    goals = goals_of(where("flat:3").world_map)
    rooms = {place.id for place in where("flat:3").world_map.places if place.id == place.room}
    assert rooms <= set(goals)
    assert goals[0] == goals[-1] and len(set(goals)) == len(goals) - 1
