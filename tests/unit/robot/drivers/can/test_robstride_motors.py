"""The driver on emulated RobStrides, alone and beside Damiaos: what holds for every family."""

from pathlib import Path

import numpy as np
import pytest

from robot.bringup import can_tools
from robot.drivers.motors.alarms import Level
from robot.drivers.motors.can.interview import interview
from robot.drivers.motors.can.verdicts import verdicts
from robot.errors import ConfigError, DriverError
from sim.devices.direct import DirectPorts
from sim.devices.robstride import HOT, RobStride
from tests.fakes.can_rig import Rig, arm

ARM = """\
rate_hz: 500
buses:
  arm: {channel: can0}
joints:
  shoulder: {bus: arm, model: RS04, id: 1, sign: -1, offset_rad: 0.3, lower_rad: -1.5, upper_rad: 2.0, velocity_limit_rad_s: 10, torque_limit_nm: 30}
  elbow: {bus: arm, model: RS02, id: 2, gear: 2.0, lower_rad: 0.0, upper_rad: 2.4, velocity_limit_rad_s: 5, torque_limit_nm: 30}
  wrist: {bus: arm, model: RS00, id: 3, lower_rad: -1.0, upper_rad: 1.4, velocity_limit_rad_s: 10, torque_limit_nm: 7}
"""  # noqa: E501
MIXED = ARM.replace("model: RS02, id: 2", "model: DM4340, id: 1")
both = pytest.mark.parametrize("text", [ARM, MIXED], ids=["robstride", "beside_a_damiao"])


@pytest.fixture
def rig(tmp_path: Path) -> Rig:
    return Rig(arm(tmp_path, ARM))


def motor(rig: Rig, name: str = "wrist") -> RobStride:
    found = rig.bench.motors[name]
    assert isinstance(found, RobStride)
    return found


def advance(rig: Rig, span_s: float) -> None:
    rig.clock.sleep_until(rig.clock.now_s() + span_s)
    rig.bench.advance(rig.clock.now_s())


@both
def test_joints_go_where_they_are_told_and_every_reply_is_in_its_period(tmp_path, text: str):
    rig = Rig(arm(tmp_path, text))
    with rig.driver:
        state = rig.cycle(1500, q=0.8, kp=40.0, kd=2.0)
        assert (state.age_s < 0.002).all()
    np.testing.assert_allclose(state.q, 0.8, atol=0.03)
    assert rig.bench.motors["shoulder"].shaft.q_rad == pytest.approx(-(0.8 - 0.3), abs=0.03)
    assert rig.driver.alarms.level == Level.OK
    assert rig.driver.late == rig.driver.reception.lost == rig.driver.reception.ignored == 0


@both
def test_what_it_says_was_sent_is_what_the_motors_obey(tmp_path, text: str):
    rig = Rig(arm(tmp_path, text))
    with rig.driver as driver:
        rig.cycle(200)
        sent = driver.write(rig.hold(0.6, kp=33.3, kd=1.23))
        driver.read()
        ordered = motor(rig)._ordered
    assert ordered.kp == pytest.approx(sent.kp[2])
    assert ordered.q_rad == pytest.approx(sent.q_des[2])
    assert sent.kp[2] == pytest.approx(33.3, abs=0.01)


@both
def test_nothing_is_enabled_before_the_first_command_and_then_all_are(tmp_path, text: str):
    rig = Rig(arm(tmp_path, text))
    with rig.driver as driver:
        for _ in range(10):
            state = driver.read()
        assert not any(one.is_on for one in rig.bench.devices)
        assert state.watchdog
        assert (state.age_s < 0.002).all()  # asked without a command
        driver.write(rig.hold())
        assert all(one.is_on for one in rig.bench.devices)
        assert motor(rig).parameters[0x7028] == 400


def test_leaving_lets_every_motor_damp_by_itself(rig: Rig):
    with rig.driver:
        rig.cycle(100)
    advance(rig, 1.0)
    for one in rig.bench.devices:
        assert one.is_on
        assert (one._ordered.kp, one._ordered.tau_nm) == (0.0, pytest.approx(0.0, abs=0.003))
        assert one._ordered.kd > 0.1


def test_a_killed_controller_leaves_motors_that_let_go_and_the_next_one_takes_over(rig: Rig):
    with rig.driver:
        rig.cycle(100)
        rig.driver._is_armed = False  # it never gets to say goodbye
    advance(rig, 0.2)
    assert not any(one.is_on for one in rig.bench.devices)
    rig.driver = rig.another()
    with rig.driver:
        rig.cycle(10)
        assert rig.driver.alarms.level == Level.OK


def test_a_spare_commands_the_motors_of_a_killed_controller_before_they_let_go(rig: Rig):
    with rig.driver:
        rig.cycle(300, q=0.5)
        with rig.another() as spare:
            for _ in range(3):
                spare.read()
                rig.cycle(1, q=0.5)
            rig.driver._is_armed = False
            rig.driver._claim.release()
            assert spare.claim()
            assert not spare.read().watchdog
            spare.write(rig.hold(0.5))
            assert all(one.is_on for one in rig.bench.devices)
            rig.driver, first = spare, rig.driver
            rig.cycle(50, q=0.5)
            assert rig.driver.alarms.level == Level.OK
            rig.driver = first


@pytest.mark.parametrize(
    ("flaw", "said"),
    [
        ("silent", "does not answer"),
        ("twin", "2 motors answer as motor 3"),
        ("wrong_range", "its position range is not 12.5664"),
        ("wrong_mode", "it is in mode 1, and must be in 0"),
        ("hot", "winding hot"),
        ("low_volts", "under voltage"),
        ("over_current", "over current"),
    ],
)
@both
def test_it_refuses_motors_that_are_not_as_the_map_says(tmp_path, text: str, flaw, said: str):
    rig = Rig(arm(tmp_path, text), wrist=flaw)
    with pytest.raises(DriverError) as caught:
        rig.driver.__enter__()
    assert said in str(caught.value)
    assert "wrist" in str(caught.value)
    assert "elbow" not in str(caught.value)
    assert not any(one.is_on for one in rig.bench.devices)


def test_a_motor_without_a_watchdog_is_not_enabled_and_no_other_is(tmp_path):
    rig = Rig(arm(tmp_path, ARM), elbow="no_watchdog")
    with rig.driver as driver, pytest.raises(DriverError, match=r"watchdog.*elbow"):
        driver.write(rig.hold())
    assert not any(one.is_on for one in rig.bench.devices)


def test_a_motor_that_gives_less_than_its_joint_may_is_refused(rig: Rig):
    motor(rig, "elbow").parameters[0x700B] = 5.0
    with pytest.raises(DriverError, match=r"elbow.*gives 5 N m at most \(register 0x700b\)"):
        rig.driver.__enter__()


@pytest.mark.parametrize(("bits", "code"), [(0x02, "over_current"), (0x10, "overload")])
def test_strain_holds_every_joint(rig: Rig, bits: int, code: str):
    with rig.driver:
        rig.cycle(50)
        motor(rig).trouble.status = bits
        rig.cycle(3)
        assert {one.code: one.who for one in rig.driver.alarms.on} == {code: "wrist"}
        assert rig.driver.alarms.level == Level.HOLD


@pytest.mark.parametrize(("bits", "code"), [(HOT, "winding_hot"), (0x08, "encoder")])
def test_other_faults_are_latched(rig: Rig, bits: int, code: str):
    with rig.driver:
        rig.cycle(50)
        motor(rig).trouble.status = bits
        rig.cycle(3)
        motor(rig).trouble.status = None
        rig.cycle(100)
        assert code in {one.code for one in rig.driver.alarms.on}
        assert rig.driver.alarms.level == Level.SIT


def test_a_scale_that_is_wrong_is_seen_in_motion(rig: Rig):
    with rig.driver:
        rig.cycle(300, q=0.5)
        motor(rig).suffer("slow_speed")
        for k in range(100):
            rig.cycle(1, q=0.5 + 0.4 * np.sin(0.06 * k))
        assert {one.code: one.who for one in rig.driver.alarms.on} == {"speed_mismatch": "wrist"}


def test_reports_that_nobody_asked_for_are_feedback_and_faults_are_none(rig: Rig):
    with rig.driver:
        rig.cycle(20)
        motor(rig)._reports_to = 0xFD
        rig.cycle(100)
        assert rig.driver.reception.ignored == 0
        assert rig.driver.alarms.level == Level.OK


def test_a_scan_finds_both_families(tmp_path):
    rig = Rig(arm(tmp_path, MIXED))
    with DirectPorts(rig.bench, rig.clock) as ports:
        found = can_tools.scan(ports, rig.clock, rig.joints, 16)
    assert {(one.id, one.joint) for one in found} == {(1, "shoulder"), (1, "elbow"), (3, "wrist")}
    assert {one.joint: one.ranges is None for one in found} == {
        "shoulder": True, "elbow": False, "wrist": True
    }  # fmt: skip


def test_readings_say_position_supply_and_heat(rig: Rig):
    with DirectPorts(rig.bench, rig.clock) as ports:
        (_, _, wrist) = can_tools.readings(ports, rig.clock, rig.joints)
    assert (wrist.status, wrist.supply_v, wrist.winding_c) == ("disabled", 24.0, 25.0)
    assert wrist.q_rad == pytest.approx(0.2, abs=0.05)


def test_a_fine_arm_has_no_findings(rig: Rig):
    with DirectPorts(rig.bench, rig.clock) as ports:
        assert not verdicts(rig.joints, interview(ports, rig.clock, rig.joints))


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("model: RS00, id: 3", "model: RS00, id: 3, reply_id: 20", "leave reply_id out"),
        ("model: RS00, id: 3", "model: RS00, id: 300", "from 1 to 127, not 300"),
        ("model: RS00, id: 3", "model: RS00, id: 2", "2 on the bus 'arm' is elbow's already"),
        ("rate_hz: 500", "rate_hz: 1000", "96%"),
    ],
)
def test_what_cannot_be_meant_is_refused(tmp_path, old: str, new: str, said: str):
    assert old in ARM
    with pytest.raises(ConfigError) as caught:
        arm(tmp_path, ARM.replace(old, new))
    assert said in str(caught.value)
