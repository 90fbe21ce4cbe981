"""The example of a robot: two files, loaded, checked and stood up."""

from pathlib import Path

import pytest

from benchmarks.rig import Rig
from robot.messages import Stand
from robot.model import description
from robot.model.body import BodyModel
from robot.planning.fit import misfits

COURIER = Path(__file__).parents[3] / "examples" / "robot_courier" / "courier.yaml"


def mass_kg(robot: description.RobotDescription) -> float:
    return float(BodyModel(robot).model.body_subtreemass[0])


def test_it_is_loaded_with_its_overlay():
    courier, juno = description.load(str(COURIER)), description.load("juno")
    assert (courier.name, courier.hands, courier.handling) == ("courier", {}, None)
    assert mass_kg(courier) == pytest.approx(mass_kg(juno) + 1.5)
    assert set(courier.motors) == {name for name in juno.motors if "gripper" not in name}


def test_the_doctor_finds_nothing_wrong():
    assert misfits(description.load(str(COURIER))) == []


def test_it_stands_up_and_squats():
    rig = Rig(robot=str(COURIER))
    assert rig.run(0.3)
    for height_m in (rig.robot.balance.squat_base_m, rig.robot.walking.base_height_m):
        rig.send(Stand, height_m=height_m)
        assert rig.wait("legs", 8.0) == "done"
        assert rig.X_WB.p[2] == pytest.approx(height_m, abs=0.01)
    assert rig.loop.state().clamped == 0
