"""What is noted while a plant runs: the way, what was touched, what was said."""

import pytest

from robot.reality import truth
from robot.se3 import SE3
from sim import atlas, judged_plant
from sim.world_schema import Person, Room, World


@pytest.fixture
def rooms():
    """Two rooms, one behind the other, and somebody in the second."""
    return World(
        name="two rooms",
        rooms=(
            Room(id="hall", at_m=(0.0, 0.0), size_m=(4.0, 4.0), walls=("north",)),
            Room(id="study", at_m=(4.0, 0.0), size_m=(4.0, 4.0)),
        ),
        people=(Person(id="ada", at_m=(5.0, 0.0)), Person(id="kurt", at_m=(0.0, -1.5))),
    )


@pytest.fixture
def plant(robot, rooms):
    plant = judged_plant.JudgedPlant(rooms, robot, seed=0, physics_ms=2)
    plant.watch()
    return plant


def wrong(plant, *checks):
    return plant.judge(truth.read(checks, atlas.world_map(plant.world))).wrong


def carry(plant, *points):
    """Take the robot along points of the floor, 0.2 s for each."""
    for x, y in points:
        plant.stand(SE3.from_xy_yaw(x, y, 0.0))
        for _ in range(20):
            plant.step(10)


def test_rooms_and_people_count_in_the_order_asked_for(plant):
    carry(plant, (0.0, -1.0), (4.0, 0.0), (4.6, 0.3))
    assert wrong(plant, {"visited": ["hall", "study"]}, {"robot_in": "study"}) == ()
    assert wrong(plant, {"visited": ["study", "hall"]}) == ("it was not at hall",)
    assert wrong(plant, {"passed": ["kurt", "ada"], "within_m": 0.8}) == ()
    assert wrong(plant, {"passed": ["ada", "kurt"], "within_m": 0.8}) == ("it was not at kurt",)
    assert wrong(plant, {"passed_at": [4.0, 0.1], "within_m": 0.3}) == ()
    assert wrong(plant, {"passed_at": [2.0, 1.5], "within_m": 0.3})
    assert wrong(plant, {"robot_near": "ada", "within_m": 0.6}) == ()
    assert wrong(plant, {"robot_near": "kurt", "within_m": 0.6})


def test_what_was_said_is_searched_for(plant):
    plant.hear("There are 2 mugs.")
    assert wrong(plant, {"said": r"(?i)\b(2|two)\b"}) == ()
    assert wrong(plant, {"said": r"\b3\b"})
    assert wrong(plant, {"any": [{"said": "3"}, {"said": "mugs"}]}) == ()


def test_a_wall_and_a_person_that_are_touched_are_told(plant):
    verdict = plant.judge([])
    assert (verdict.touched, verdict.too_near) == ((), ())
    carry(plant, (0.5, 1.9))
    assert any("touched wall/hall" in text for text in plant.judge([]).touched)
    carry(plant, (4.95, 0.0))
    verdict = plant.judge([])
    assert any("touched person/ada" in text for text in verdict.touched)
    assert [text.split()[0] for text in verdict.too_near] == ["ada"]
