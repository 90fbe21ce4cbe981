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
    with pytest.raises(
        ConfigError, match=r"no driver 'modbus' \(valid: can, dynamixel, ethernet, pwm, simulated\)"
    ):
        motor_choice.checked(robot, "modbus")
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


def test_servos_are_said_to_be_emulated_and_who_moves_the_rest(robot):
    said = motor_choice.checked(robot, "dynamixel")
    assert said.startswith("Motors by Dynamixel (emulated): 18 joints on 3 ports at 500 Hz")
    assert "left_arm, is 38% busy. Motors by CAN (emulated): 15 joints on 4 buses" in said


def test_a_robot_without_a_servo_map_is_refused(robot, tmp_path):
    with pytest.raises(ConfigError, match=r"no joint map.*write dynamixel.yaml beside"):
        motor_choice.checked(msgspec.structs.replace(robot, folder=str(tmp_path)), "dynamixel")


@pytest.fixture
def with_servos(robot, tmp_path):
    """Juno with another servo map."""

    def change(old: str, new: str):
        for name in ("can.yaml", "dynamixel.yaml"):
            text = robot.path().with_name(name).read_text()
            if name == "dynamixel.yaml":
                assert old in text
                text = text.replace(old, new)
            (tmp_path / name).write_text(text)
        return msgspec.structs.replace(robot, folder=str(tmp_path))

    return change


def test_ports_that_cannot_keep_the_rate_are_refused_with_how_many_can(with_servos):
    slower = with_servos("ttyUSB1, baud_hz: 4000000", "ttyUSB1, baud_hz: 3000000")
    with pytest.raises(ConfigError, match=r"8 servos take 0.99 ms.*2 ports are needed, 6 servos"):
        motor_choice.checked(slower, "dynamixel")
    patient = with_servos("ttyUSB1, baud_hz", "ttyUSB1, latency_s: 0.016, baud_hz")
    with pytest.raises(ConfigError, match=r"16 ms in the adapter.*no number of ports is enough"):
        motor_choice.checked(patient, "dynamixel")


def test_legs_are_too_much_for_servos(with_servos):
    knee = (
        "  left_knee: {port: head, model: XM540-W270, id: 9, lower_rad: 0, upper_rad: 2.3, "
        "velocity_limit_rad_s: 3, torque_limit_nm: 139}\n"
    )
    strong = with_servos("joints:\n", f"joints:\n{knee}")
    with pytest.raises(ConfigError, match=r"a XM540-W270 at gear 1 gives 10.6 N m at most"):
        motor_choice.checked(strong, "dynamixel")


def test_a_joint_that_nobody_moves_is_refused(with_servos):
    alone = with_servos("others: can\n", "")
    with pytest.raises(ConfigError, match="no motor moves the joint 'left_hip_yaw'"):
        motor_choice.checked(alone, "dynamixel")


def test_servos_and_can_at_different_rates_are_refused(with_servos):
    slower = with_servos("rate_hz: 500", "rate_hz: 250")
    with pytest.raises(ConfigError, match="servos are commanded at 250 Hz, the motors on CAN at"):
        motor_choice.checked(slower, "dynamixel")
