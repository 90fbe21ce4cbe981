"""Maps of hobby servos: what cannot be meant, and what may not be moved by one."""

import msgspec
import pytest

from robot.bringup import motor_choice
from robot.drivers.motors import pwm_and_others
from robot.drivers.motors.pwm.driver import FAMILY
from robot.errors import ConfigError
from robot.model import description
from tests.fakes.pwm_rig import HEAD, head

LEG = (
    "joints:\n  left_knee: {chip: hat, model: BIG, id: 5, travel_rad: 3, lower_rad: 0, "
    "upper_rad: 1, velocity_limit_rad_s: 5, torque_limit_nm: 20}\n"
)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("pulse_us: [500, 2500]", "pulse_us: [2500, 500]", "exchange them"),
        ("pulse_us: [500, 2500]", "pulse_us: [100, 2500]", "300"),
        ("address: 64", "address: 64, frame_hz: 400", "330"),
        ("address: 64", "address: 64, frame_hz: 49", "50"),
        ("[500, 2500], travel_rad: 3.1416", "[500, 2500], travel_rad: 2", "its pulses go to 1.00"),
        ("id: 3", "id: 0", "output 0 of the chip 'hat' is yaw's already"),
        ("id: 15", "id: 16", "15"),
        ("start_rad: 0.1", "start_rad: 0.5", "outside 0 to 0.35"),
        ("address: 64}", "address: 64}\n  cap: {bus: 1, address: 64}", "is 'hat' already"),
        ("address: 64}", "address: 64, emulated: /tmp/x}", "a simulation's to say"),
        ("chip: hat, model: SG90", "chip: hut, model: SG90", "did you mean 'hat'"),
        ("chips:", "watchdog_s: 0.02\nchips:", "0"),
        ("address: 64}", "address: 64, frame_hz: 330, bus_hz: 50000}", "its bus is"),
    ],
)
def test_what_cannot_be_meant_is_refused(tmp_path, old, new, said):
    assert old in HEAD
    with pytest.raises(ConfigError) as caught:
        head(tmp_path, HEAD.replace(old, new, 1))
    assert said in str(caught.value)


def test_the_fastest_frames_hold_the_longest_pulse(tmp_path):
    fast = HEAD.replace("address: 64}", "address: 64, frame_hz: 330, bus_hz: 400000}")
    chip = head(tmp_path, fast.replace("[500, 2500]", "[500, 3000]")).chips["hat"]
    assert chip.frame_s == pytest.approx(1 / 321.2, rel=0.001)
    assert chip.frame_s * 4095 / 4096 > 3000e-6


def test_juno_looks_by_two_and_stands_by_can():
    juno = description.load("juno")
    said = motor_choice.checked(juno, "pwm")
    assert said.startswith("Motors by PWM (emulated): 2 joints on 1 chips at 500 Hz")
    assert "Motors by CAN (emulated): 31 joints on 8 buses" in said
    found = pwm_and_others.maps(juno)
    assert [*found.servos.joints] == ["head_yaw", "head_pitch"]
    assert found.boards is None


def juno_with(tmp_path, text: str):
    juno = description.load("juno")
    for name in ("can.yaml", "ethernet.yaml"):
        (tmp_path / name).write_text(juno.path().with_name(name).read_text())
    (tmp_path / "pwm.yaml").write_text(text)
    return msgspec.structs.replace(juno, folder=str(tmp_path))


def test_a_leg_an_arm_or_the_waist_on_a_hobby_servo_is_refused_with_the_reason(tmp_path):
    text = description.load("juno").path().with_name("pwm.yaml").read_text()
    leg = juno_with(tmp_path, text.replace("joints:\n", LEG))
    with pytest.raises(ConfigError, match=r"left_knee has to be where the controller takes it to"):
        motor_choice.checked(leg, "pwm")
    for other in ("waist_yaw", "left_elbow"):
        named = juno_with(tmp_path, text.replace("joints:\n", LEG.replace("left_knee", other)))
        with pytest.raises(ConfigError, match=f"{other} has to be.*hobby servos may move head and"):
            motor_choice.checked(named, "pwm")


def test_a_hand_may_go_by_one_and_the_rest_be_behind_ethernet(tmp_path):
    text = description.load("juno").path().with_name("pwm.yaml").read_text()
    hand = LEG.replace("left_knee", "left_gripper").replace("upper_rad: 1,", "upper_rad: 0.05,")
    hand = hand.replace("travel_rad: 3", "gear: 50, travel_rad: 5.1, offset_rad: 0.025")
    robot = juno_with(tmp_path, text.replace("others: can", "others: ethernet").replace(
        "joints:\n", hand
    ))  # fmt: skip
    found = pwm_and_others.maps(robot)
    assert [*found.servos.joints] == ["head_yaw", "head_pitch", "left_gripper"]
    assert found.can is None
    assert found.boards is not None
    assert len(found.boards.joints) == 30
    assert FAMILY.beside(robot).others == "ethernet"
