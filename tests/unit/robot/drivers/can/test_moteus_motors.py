"""The driver on emulated moteus over CAN FD, alone and beside Damiaos: what only they have."""

from pathlib import Path

import pytest

from robot.bringup import can_tools
from robot.drivers.motors.alarms import Level
from robot.drivers.motors.can import joint_map
from robot.drivers.motors.can.interview import interview
from robot.drivers.motors.can.moteus import TURN_RAD
from robot.drivers.motors.can.verdicts import verdicts
from robot.errors import ConfigError, DriverError
from sim.devices.direct import DirectPorts
from sim.devices.moteus import TIMEOUT, Moteus
from tests.fakes.can_rig import MOTEUS, MOTEUS_AND_A_DAMIAO, Rig, arm, killed, limbs


@pytest.fixture
def rig(tmp_path: Path) -> Rig:
    return Rig(arm(tmp_path, MOTEUS))


def motor(rig: Rig, name: str = "wrist") -> Moteus:
    found = rig.bench.motors[name]
    assert isinstance(found, Moteus)
    return found


def advance(rig: Rig, span_s: float) -> None:
    rig.clock.sleep_until(rig.clock.now_s() + span_s)
    rig.bench.advance(rig.clock.now_s())


# --- before anything is enabled ------------------------------------------------------------------


def test_gains_are_set_before_it_is_enabled_and_nothing_is_written_for_ever(rig: Rig):
    with rig.driver:
        assert motor(rig).console["servo.pid_position.kp"] == 4.0  # asked, and not touched
        rig.cycle(5)
    for name in rig.bench.motors:
        console = motor(rig, name).console
        assert console["servo.pid_position.kp"] == pytest.approx(500.0 * TURN_RAD, rel=1e-6)
        assert console["servo.pid_position.kd"] == pytest.approx(5.0 * TURN_RAD, rel=1e-6)
        assert console.written["servo.pid_position.kp"] == 4.0


def test_motors_that_do_not_take_their_gains_are_not_enabled_and_no_other_is(rig: Rig):
    motor(rig).console._set = lambda name, value: "OK"  # it says so, and does not do it
    with rig.driver, pytest.raises(DriverError, match=r"did not take their settings.*wrist"):
        rig.driver.write(rig.hold())
    assert not any(one.is_on for one in rig.bench.motors.values())


def test_what_a_console_said_to_others_is_not_taken_for_its_answer(rig: Rig):
    for name in rig.bench.motors:
        motor(rig, name).console._out = b"123.0\r\n" * 20
    with rig.driver:
        rig.cycle(50)
        assert rig.driver.alarms.level == Level.OK


def test_answers_that_are_lost_are_asked_for_again(rig: Rig):
    one = motor(rig)
    asked = one.console.hear
    lost: list[bytes] = []

    def hear(data: bytes) -> None:
        if data.startswith(b"conf get servo.max") and len(lost) < 2:
            lost.append(data)
            return
        asked(data)

    one.console.hear = hear
    with DirectPorts(rig.bench, rig.clock) as ports:
        assert not verdicts(rig.joints, interview(ports, rig.clock, rig.joints))
    assert len(lost) == 2


@pytest.mark.parametrize(
    ("setting", "value", "said", "is_grave"),
    [
        ("servopos.position_min", -0.05, "its own bounds are -0.05 to nan revolutions", True),
        ("servo.max_velocity", 1.0, "it gives less beyond 1 revolutions a second", True),
        ("motor_position.rotor_to_output_ratio", 1.0, "its model says 0.166667", True),
        ("servo.pid_position.ilimit", 3.0, "an integral that nobody commands", True),
        ("servo.timeout_mode", 0, "after a timeout it lets go", False),
        ("servo.motor_fault_temperature", 70.0, "lets go at 70 °C, before the map's 80", False),
    ],
)
def test_a_setting_that_does_not_fit_is_found(rig: Rig, setting, value, said: str, is_grave):
    motor(rig).console.settings[setting] = value
    with DirectPorts(rig.bench, rig.clock) as ports:
        (found,) = verdicts(rig.joints, interview(ports, rig.clock, rig.joints))
    assert found.joint == "wrist"
    assert said in found.text
    assert found.is_grave == is_grave
    assert found.cure


@pytest.mark.parametrize(
    ("homed", "code", "is_grave"), [(0, "unknown_position", True), (1, "within_a_turn", False)]
)
def test_where_its_zero_is_from_is_looked_at(rig: Rig, homed: int, code: str, is_grave: bool):
    motor(rig).homed = homed  # a qdd100 has a gear of 6 behind its rotor
    motor(rig, "elbow").homed = 2
    with DirectPorts(rig.bench, rig.clock) as ports:
        (found,) = verdicts(rig.joints, interview(ports, rig.clock, rig.joints))
    assert (found.joint, found.code, found.is_grave) == ("wrist", code, is_grave)


def test_a_console_that_says_nothing_is_refused(rig: Rig):
    motor(rig).console.hear = lambda data: None
    with pytest.raises(DriverError, match=r"wrist: its settings .* could not be read"):
        rig.driver.__enter__()


def test_a_fine_arm_has_no_findings(rig: Rig):
    with DirectPorts(rig.bench, rig.clock) as ports:
        assert not verdicts(rig.joints, interview(ports, rig.clock, rig.joints))


def test_readings_say_position_supply_and_heat(rig: Rig):
    with DirectPorts(rig.bench, rig.clock) as ports:
        (_, _, wrist) = can_tools.readings(ports, rig.clock, rig.joints)
    assert (wrist.status, wrist.supply_v, wrist.winding_c) == ("disabled", 24.0, 25.0)
    assert wrist.q_rad == pytest.approx(0.2, abs=0.1)


def test_a_scan_asks_every_bus_as_its_motors_speak(tmp_path):
    rig = Rig(arm(tmp_path, MOTEUS_AND_A_DAMIAO))
    with DirectPorts(rig.bench, rig.clock) as ports:
        found = can_tools.scan(ports, rig.clock, rig.joints, 16)
    assert {(one.bus, one.id, one.joint) for one in found} == {
        ("arm", 1, "shoulder"), ("arm", 3, "wrist"), ("old", 1, "elbow"),
    }  # fmt: skip
    assert not any(node.transmit_errors for wire in rig.bench.wires.values() for node in wire.nodes)


# --- while it is commanded -----------------------------------------------------------------------


def test_every_command_says_for_how_long_it_counts_and_the_most_torque(rig: Rig):
    with rig.driver:
        rig.cycle(20)
        for name, most_nm in (("shoulder", 60.0), ("elbow", 20.0), ("wrist", 16.0)):
            command = motor(rig, name).command
            assert command[0x27] == pytest.approx(0.02)
            assert command[0x25] == pytest.approx(most_nm)
            assert command[0x28] < 0.0  # no limit of its own on the way
            assert command[0x29] < 0.0


def test_a_killed_controller_leaves_motors_that_brake(rig: Rig):
    with rig.driver:
        rig.cycle(100, q=0.5, kd=2.0)
        killed(rig)
        advance(rig, 0.05)
        one = motor(rig)
        assert one.mode == TIMEOUT
        one.shaft.qd_rad_s = 3.0
        advance(rig, 0.05)
        assert abs(one.shaft.qd_rad_s) < 0.3


def test_leaving_has_every_motor_damp_for_good_and_not_brake_after_a_timeout(rig: Rig):
    with rig.driver:
        rig.cycle(100)
    advance(rig, 5.0)
    assert all(motor(rig, name).is_on for name in rig.bench.motors)


def test_a_question_beside_commands_destroys_none(rig: Rig):
    """Another program asks for feedback while this one commands, at the same moments."""
    with rig.driver, rig.another() as other:
        for _ in range(100):
            other._ask(other._life.lines)
            rig.cycle(1)
        nodes = rig.bench.wires["arm"].nodes
        assert [node.transmit_errors for node in nodes] == [0] * len(nodes)
        assert rig.driver.reception.lost == 0


# --- the map -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("model: qdd100, id: 3", "model: qdd100, id: 3, reply_id: 20", "leave reply_id out"),
        ("model: qdd100, id: 3", "model: qdd100, id: 128", "from 1 to 127, not 128"),
        ("model: qdd100", "model: moteus-c1", "sold without a motor"),
        ("torque_nm: 60", "torque_nm: 400", "say 327.7 at most"),
        ("position_rad: 12.5", "position_rad: 25", "say 20.59 at most"),
        (", data_bitrate_hz: 5000000", "", "speaks CAN FD, and the bus 'arm' is a classic one"),
        ("model: qdd100", "model: DM4310", "takes the FD frames of the bus 'arm' for errors"),
        ("model: qdd100", "model: RS00", "takes the FD frames of the bus 'arm' for errors"),
        ("rate_hz: 500\n", "rate_hz: 1200\n", "2 buses are needed, 2 joints each"),
    ],
)
def test_what_cannot_be_meant_is_refused(tmp_path, old: str, new: str, said: str):
    assert old in MOTEUS
    with pytest.raises(ConfigError) as caught:
        arm(tmp_path, MOTEUS.replace(old, new))
    assert said in str(caught.value)


@pytest.mark.parametrize(("joints", "fits"), [(6, True), (7, False)])
def test_six_joints_fit_a_bus_at_500_hz(joints: int, fits: bool):
    """Those with identifiers up to 7: their answers have identifiers of 11 bits."""
    found = limbs(1, joints, model="moteus-x1")
    assert (found.load("bus0") <= 0.70) == fits
    wrong = list(joint_map._loads(found))
    assert not wrong if fits else "2 buses are needed, 6 joints each" in wrong[0][2]
