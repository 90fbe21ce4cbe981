"""Another driver of the motors: refused where it cannot drive them, with the cure."""

import msgspec
import pytest

from robot.bringup import motor_choice
from robot.drivers.motors.can import joint_map
from robot.errors import ConfigError
from robot.model import description


@pytest.fixture(scope="module")
def robot():
    return description.load("juno")


@pytest.fixture
def mapped(robot, tmp_path):
    """Juno with another joint map."""

    def change(old: str, new: str):
        text = robot.path().with_name(joint_map.FILE).read_text()
        assert old in text
        (tmp_path / joint_map.FILE).write_text(text.replace(old, new))
        return msgspec.structs.replace(robot, folder=str(tmp_path))

    return change


def test_it_says_how_full_the_buses_get_and_that_they_are_emulated(robot):
    said = motor_choice.checked(robot, "can")
    assert said.startswith("Motors by CAN (emulated): 33 joints on 8 buses at 500 Hz")
    assert "trunk, is 68% busy" in said
    assert motor_choice.checked(robot, "simulated") == ""


def test_an_unknown_driver_is_refused_with_those_that_there_are(robot):
    with pytest.raises(ConfigError, match=r"no driver 'ethercat' \(valid: can, simulated\)"):
        motor_choice.checked(robot, "ethercat")
    with pytest.raises(ConfigError, match="did you mean 'can'"):
        motor_choice.checked(robot, "cann")


def test_a_robot_without_a_joint_map_is_refused(robot, tmp_path):
    with pytest.raises(ConfigError, match=r"no joint map.*write can.yaml beside"):
        motor_choice.checked(msgspec.structs.replace(robot, folder=str(tmp_path)), "can")


def test_buses_that_cannot_carry_the_rate_are_refused_with_how_many_can(mapped):
    crowded = mapped("bus: left_hand, model: DM6006, id: 1,", "bus: trunk, model: DM6006, id: 6,")
    with pytest.raises(ConfigError, match=r"6 joints at 500 Hz fill it to 81%.*2 buses are needed"):
        motor_choice.checked(crowded, "can")


def test_a_rate_that_is_not_the_controllers_is_refused(mapped):
    with pytest.raises(ConfigError, match=r"at 250 Hz, the controller 500 times a second"):
        motor_choice.checked(mapped("rate_hz: 500", "rate_hz: 250"), "can")
