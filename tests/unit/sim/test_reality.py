"""The simulation as the rest of the software knows it."""

import pickle

import pytest

from robot.errors import ConfigError
from robot.reality import faults
from robot.reality.truth import Check
from sim.simulation import Simulation

SIMULATION = Simulation()


@pytest.fixture(scope="module")
def kitchen():
    return SIMULATION.world("kitchen")


def test_shipped_worlds_are_named_and_can_be_read():
    for name in SIMULATION.names():
        assert SIMULATION.world(name).map.name
    with pytest.raises(ConfigError, match="did you mean 'kitchen'"):
        SIMULATION.world("kitchn")


def test_it_can_be_sent_to_a_worker(kitchen):
    sent = pickle.loads(pickle.dumps(SIMULATION))
    assert sent.world("kitchen").content() == kitchen.content()


def test_a_world_says_how_another_process_finds_it_again(kitchen):
    varied = SIMULATION.world("kitchen", vary_seed=3)
    assert (kitchen.name, kitchen.vary_seed) == ("kitchen", None)
    again = SIMULATION.world(varied.name, vary_seed=varied.vary_seed)
    assert again.content() == varied.content() != kitchen.content()


def test_objects_begin_where_the_plant_has_them(kitchen, robot):
    plant = kitchen.plant(robot, seed=0)
    begins = kitchen.objects()
    assert set(begins) == {info.id for info in kitchen.map.objects}
    places = {place.id for place in kitchen.map.places}
    for name, begin in begins.items():
        assert plant.where(f"object/{name}").p == pytest.approx(begin.X_WO.p, abs=1e-6)
        assert begin.place_id in places


def test_a_nudged_world_is_the_same_for_the_same_seed_and_keeps_its_map(kitchen):
    assert kitchen.nudged(1).content() == kitchen.nudged(1).content()
    assert kitchen.nudged(1).content() != kitchen.nudged(2).content()
    nudged = kitchen.nudged(1, start=(0.5, 0.0, 90.0)).map
    assert nudged.places == kitchen.map.places
    assert nudged.objects == kitchen.map.objects


def test_a_fault_is_checked_before_there_is_a_plant_and_suffered_by_it(kitchen, robot):
    with pytest.raises(ConfigError, match="did you mean 'red_cup'"):
        kitchen.verify(faults.Remove(target="red_cop"), robot)
    gone = faults.Remove(target="red_cup")
    kitchen.verify(gone, robot)
    plant = kitchen.plant(robot, seed=0, physics_ms=2)
    there = Check(object="red_cup", on=kitchen.objects()["red_cup"].place_id)
    assert plant.judge([there]).wrong == ()
    plant.suffer(gone)
    plant.step(2)
    assert plant.judge([there]).wrong
