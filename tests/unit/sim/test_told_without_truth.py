"""With `--eyes camera` nothing that only the simulator knows of things leaves the plant."""

import msgspec
import pytest

from robot.bus import topics
from robot.model import description
from robot.usual_things import UNKNOWN, usual
from sim import world
from sim.simulation import SimulatedWorld, Simulation


def sent(entries, eyes):
    """What the plant sends at first, by topic."""
    plant = SimulatedWorld(entries, eyes=eyes).plant(description.load("juno"), seed=1)
    return {topic.name: message for topic, message in plant.sense(0.0)}


@pytest.fixture(scope="module")
def kitchen():
    return world.load("kitchen")


def tainted(entries):
    """The same with other sizes, forms and masses of things."""
    other = tuple(
        msgspec.structs.replace(
            item, shape="box", mass_kg=3.0 * item.mass_kg,
            size_m=tuple(1.3 * size for size in item.size_m),
        )
        for item in entries.objects
    )  # fmt: skip
    return msgspec.structs.replace(entries, objects=other)


def test_the_oracle_sights_nobody_and_nothing_where_the_robot_has_eyes_of_its_own(kitchen):
    by_oracle, by_camera = (sent(kitchen, eyes) for eyes in ("oracle", "camera"))
    assert {one.id for one in by_oracle[topics.ORACLE_SIGHTINGS.name].objects} >= {"red_cup"}
    assert topics.ORACLE_SIGHTINGS.name not in by_camera


def test_what_is_told_of_things_is_the_same_whatever_they_are_like(kitchen):
    as_it_is, otherwise = (
        sent(entries, "camera")[topics.ORACLE_MAP.name].objects
        for entries in (kitchen, tainted(kitchen))
    )
    assert as_it_is == otherwise
    told = SimulatedWorld(tainted(kitchen), eyes="camera").map.objects
    assert told == as_it_is
    assert {(one.id, one.category, one.color) for one in as_it_is} == {
        (item.id, item.category, item.color) for item in kitchen.objects
    }


def test_without_eyes_of_its_own_all_is_as_it_was(kitchen):
    assert SimulatedWorld(kitchen).map == Simulation().world("kitchen").map
    assert SimulatedWorld(kitchen).map != SimulatedWorld(tainted(kitchen)).map


def test_a_name_says_what_such_things_are_usually_like():
    assert usual("wine bottle") == usual("bottle")
    assert usual("") == usual("gizmo") == UNKNOWN
    assert usual("cup").kind == "cylinder" and usual("cereal box").kind == "box"
    assert usual("blue pill bottle") == usual("pill_bottle") != usual("bottle")
