"""The judge looks at the world as it is, not as the robot believes it to be."""

import msgspec
import pytest

from robot.errors import ConfigError
from robot.reality import faults, truth
from robot.se3 import SE3
from sim import atlas
from sim import judge as judging
from sim.faults import apply
from sim.plant import Plant
from sim.witness import Witness


def judge(plant, data):
    """The verdict on checks as plain data."""
    return judging.judge(plant, truth.read(data, atlas.world_map(plant.world)), Witness(plant))


@pytest.fixture
def plant(robot, kitchen):
    plant = Plant(kitchen, robot, seed=0)
    plant.step(200)
    return plant


def test_an_object_is_on_a_place_or_it_is_not(plant):
    assert judge(plant, [{"object": "red_cup", "on": "table"}]).wrong == ()
    assert judge(plant, [{"object": "red_cup", "on": "counter"}]).wrong
    plant.put("object/red_cup", SE3((1.15, 0.15, 0.9)))
    assert "not on" in judge(plant, [{"object": "red_cup", "on": "table"}]).wrong[0]
    apply(plant, faults.KnockOver(target="box"))
    plant.step(600)
    assert judge(plant, [{"object": "box", "on": "counter"}]).wrong


def test_what_lay_from_the_beginning_may_lie_or_stand(robot, kitchen):
    objects = tuple(
        msgspec.structs.replace(o, lies=True) if o.id == "red_cup" else o for o in kitchen.objects
    )
    plant = Plant(msgspec.structs.replace(kitchen, objects=objects), robot, seed=0)
    plant.step(200)
    lies = plant.oracle.X_WO("red_cup")
    assert abs(lies.rotation()[2, 2]) < 0.05
    assert judge(plant, [{"object": "red_cup", "on": "table"}]).wrong == ()
    plant.put("object/red_cup", SE3((lies.p[0], lies.p[1], lies.p[2] + 0.02)))
    plant.step(200)
    assert judge(plant, [{"object": "red_cup", "on": "table"}]).wrong == ()
    assert judge(plant, [{"object": "red_cup", "on": "counter"}]).wrong


def test_an_object_is_in_a_hand_or_it_is_not(plant, robot):
    assert "from the hand" in judge(plant, [{"object": "red_cup", "held": True}]).wrong[0]
    hand = plant.data.site(robot.hands["left"].grasp_site).xpos
    plant.put("object/red_cup", SE3(tuple(hand.tolist())))
    assert judge(plant, [{"object": "red_cup", "held": True}]).wrong == ()


def test_the_robot_stands_somewhere_upright_with_or_without_power(plant, hold):
    x, y, _ = plant.oracle.X_WB().p
    assert judge(plant, [{"at": [x, y]}]).wrong == ()
    assert judge(plant, [{"at": [x + 1.0, y]}]).wrong
    assert judge(plant, []).damped
    plant.write(hold(0.0))
    verdict = judge(plant, [])
    assert (verdict.upright, verdict.damped, verdict.source) == (True, False, "oracle")


@pytest.mark.parametrize(
    ("check", "message"),
    [
        ({"object": "red_cop", "held": True}, "did you mean 'red_cup'"),
        ({"object": "red_cup", "on": "tabel"}, "did you mean 'table'"),
        ({"at": [0, 0], "held": True}, "a check is"),
        ({"att": [0, 0]}, "att"),
    ],
)
def test_checks_that_cannot_be_meant(plant, check, message):
    with pytest.raises(ConfigError, match=message):
        judge(plant, [check])
