"""The joint map as people write it: what is read, and what is refused with its line and a cure."""

import math

import pytest

from robot.drivers.motors import motor_map
from robot.drivers.motors.can import load
from robot.errors import ConfigError
from tests.fakes.can_rig import ARM, arm


def refused(tmp_path, text: str) -> str:
    with pytest.raises(ConfigError) as caught:
        arm(tmp_path, text)
    return str(caught.value)


def test_a_map_is_read_in_its_order_with_what_it_leaves_out(tmp_path):
    found = arm(tmp_path)
    assert list(found.joints) == ["shoulder", "elbow", "wrist"]
    shoulder = found.joints["shoulder"]
    assert (shoulder.answers_as, shoulder.gear, shoulder.sign) == (17, 1.0, -1)
    assert shoulder.expected == (12.5, 45, 54, 500, 5)
    assert found.buses["arm"].bitrate_hz == 1_000_000
    assert found.watchdog_s == 0.02
    for angle in (-1.0, 0.0, 0.7):
        for one in found.joints.values():
            assert one.joint_rad(one.motor_rad(angle)) == pytest.approx(angle)


@pytest.mark.parametrize(
    ("old", "new", "line", "said"),
    [
        ("bus: arm, model: DM8009", "bus: amr, model: DM8009", 5, "no bus 'amr' (did you mean"),
        ("model: DM4340", "model: DM4430", 6, "unknown model 'DM4430'"),
        ("id: 3", "id: 2", 7, "2 on the bus 'arm' is elbow's already"),
        ("id: 3", "id: 17", 7, "17 on the bus 'arm' is shoulder's already"),
        ("id: 3", "id: 3, reply_id: 18", 7, "18 on the bus 'arm' is elbow's already"),
        ("id: 3", "id: 0", 7, "id is 0, and must be from 1 to 2046"),
        ("sign: -1", "sign: 0", 5, "sign"),
        ("sign: -1", "sing: -1", 5, "sing"),
        ("lower_rad: -1.0", "lower_rad: 1.5", 7, "lower_rad is not below upper_rad"),
        ("gear: 2.0", "gear: 6.0", 6, "there the motor is at 14.40 rad, and its frames say 12.5"),
        ("velocity_limit_rad_s: 5", "velocity_limit_rad_s: 8", 6, "gives 5 rad/s at most"),
        ("torque_limit_nm: 7", "torque_limit_nm: 17", 7, "a DM4310 at gear 1 gives 10 N m at most"),
        ("DM4310", "AK80-9", 7, "cannot be asked what its frames stand for (say its ranges"),
        ("rate_hz: 500", "rate_hz: 100", 1, "at least 3 periods: 0.03"),
        ("rate_hz: 500", "rate_hz: 1000", 3, "3 joints at 1000 Hz fill it to 81%, at most 70% is "
         "safe (2 buses are needed, 2 joints each, or 864 Hz)"),
    ],
)  # fmt: skip
def test_what_cannot_be_meant_is_refused_where_it_stands(tmp_path, old, new, line: int, said: str):
    assert old in ARM
    message = refused(tmp_path, ARM.replace(old, new))
    assert said in message
    if "watchdog" not in message:
        assert f"can.yaml:{line}:" in message


def test_an_ak_is_taken_where_a_person_says_its_ranges(tmp_path):
    ranges = "ranges: {position_rad: 12.5, velocity_rad_s: 50, torque_nm: 18}"
    found = arm(tmp_path, ARM.replace("model: DM4310", f"model: AK80-9, {ranges}"))
    assert found.joints["wrist"].expected == (12.5, 50.0, 18.0, 500, 5)


def test_a_map_without_a_joint_is_refused(tmp_path):
    text = "rate_hz: 500\nbuses:\n  arm: {channel: can0}\njoints: {}\n"
    assert "no joint stands here" in refused(tmp_path, text)


def test_a_robots_motor_order_is_that_of_every_array(tmp_path):
    found = arm(tmp_path)
    names = ["wrist", "shoulder", "elbow"]
    assert list(motor_map.of_robot(found, names).joints) == names
    with pytest.raises(ConfigError) as caught:
        motor_map.of_robot(found, ["wrist", "shoulder", "elbows"])
    assert "no motor moves the joint 'elbows'" in str(caught.value)
    assert "the robot has no motor 'elbow'" in str(caught.value)


@pytest.mark.parametrize(
    ("joints", "rate_hz", "is_extended", "buses"),
    [(30, 500, False, 6), (30, 500, True, 8), (30, 200, False, 3), (1, 10_000, False, 0)],
)
def test_buses_for_a_humanoid(joints: int, rate_hz: float, is_extended: bool, buses: int):
    most = load.most_joints(rate_hz, is_extended=is_extended, bitrate_hz=1e6)
    assert (math.ceil(joints / most) if most else 0) == buses


def test_the_load_of_five_joints_at_500_hz():
    assert load.load(5, 500, is_extended=False, bitrate_hz=1e6) == pytest.approx(0.675)
    assert load.pair_s(is_extended=True, bitrate_hz=1e6) == pytest.approx(320e-6)
