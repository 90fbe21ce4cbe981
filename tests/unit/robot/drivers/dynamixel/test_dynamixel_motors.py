"""The driver of servos: emulated ones, in simulated time, with all that goes wrong with them."""

import msgspec
import numpy as np
import pytest

from robot.drivers.motor_bus import MotorCommand
from robot.drivers.motors.alarms import Level
from robot.drivers.motors.dynamixel import load
from robot.drivers.motors.dynamixel.joint_map import JointServo, Port, ServoMap
from robot.errors import DriverError
from tests.fakes.dynamixel_rig import Rig, arm


@pytest.fixture
def joints(tmp_path):
    return arm(tmp_path)


@pytest.fixture
def rig(joints):
    return Rig(joints)


def codes(rig: Rig) -> set[str]:
    return {alarm.code for alarm in rig.driver.alarms.on}


def test_joints_get_where_they_are_sent_through_sign_gear_and_offset(rig):
    with rig.driver:
        state = rig.cycle(500, q=0.7)
        np.testing.assert_allclose(state.q, 0.7, atol=0.06)  # a bench's spring pulls
        for name, one in rig.joints.joints.items():
            q = one.joint_rad(rig.servo(name).shaft.q_rad)
            assert q == pytest.approx(state.q[list(rig.joints.joints).index(name)], abs=0.01)
        assert rig.driver.reception.lost == 0
        assert not rig.driver.alarms.on
        assert (state.age_s < rig.joints.period_s + 1e-9).all()
        assert np.isfinite(state.temperature_c).all()
        assert state.command_stamp_s == pytest.approx(rig.clock.now_s() - rig.joints.period_s)


def test_the_torque_on_the_wire_is_the_law_at_what_was_measured(rig):
    with rig.driver as driver:
        state = rig.cycle(3, q=0.5)
        sent = driver.write(rig.hold(0.55, kp=3.0, kd=0.1))
        obeyed = driver._obeyed
        wanted = obeyed.kp * (obeyed.q_des - state.q) - obeyed.kd * state.qd
        step = np.abs(driver._nm_a_step)
        np.testing.assert_array_less(np.abs(sent.tau_ff - wanted), 0.51 * step)
        assert not sent.kp.any()
        assert not sent.kd.any()


def test_no_servo_is_ever_told_more_than_its_joint_may_give(rig):
    most = np.array([one.torque_limit_nm for one in rig.joints.joints.values()])
    with rig.driver as driver:
        for k in range(60):
            wild = rig.hold(5.0 * (-1) ** k, kp=400.0, kd=5.0)
            wild.tau_ff[:] = 100.0 * (-1) ** k
            sent = driver.write(wild)
            driver.read()
            assert (np.abs(sent.tau_ff) <= most).all()
            for name, one in rig.joints.joints.items():
                current = rig.servo(name).memory.get(102, 2, signed=True)
                assert abs(current) * abs(one.nm_a_step) <= one.torque_limit_nm


@pytest.mark.parametrize(
    ("flaw", "said"),
    [
        ("silent", "does not answer"),
        ("crc_errors", "two servos have one id"),
        ("half_packets", "does not answer"),
        ("late", "does not answer"),
        ("wrong_model", "it is a model 1060, the map says XM540-W150"),
        ("twin", "spoilt"),
        ("alert", "it reports electrical shock"),
        ("hot", "it reports overheating"),
        ("low_volts", "it reports input voltage"),
    ],
)
def test_what_is_wrong_at_the_start_is_named_and_nothing_is_enabled(joints, flaw, said):
    rig = Rig(joints, elbow=flaw)
    with pytest.raises(DriverError, match="elbow") as caught, rig.driver:
        pass
    assert said in str(caught.value)
    assert not any(servo.is_on for servo in rig.bench.servos.values())


def test_a_wrong_limit_of_current_is_refused(rig):
    rig.servo("wrist").memory.put(38, 2, 200)
    with (
        pytest.raises(DriverError, match=r"limit of current \(200\) lets it give 0.96 N m"),
        rig.driver,
    ):
        pass


def test_another_mode_and_a_return_delay_are_set_and_the_watchdog_is_written(joints):
    rig = Rig(joints, elbow="wrong_mode")
    with rig.driver:
        rig.cycle(2)
        for servo in rig.bench.servos.values():
            memory = servo.memory
            assert (memory.get(11, 1), memory.get(9, 1), memory.get(98, 1)) == (0, 0, 2)
            assert servo.is_on


def test_one_answer_that_is_spoilt_is_bridged(rig):
    with rig.driver as driver:
        rig.cycle(20)
        rig.servo("elbow").trouble.spoils = 1
        before = driver.reception.lost
        state = rig.cycle()
        assert driver.reception.lost - before == 1
        assert not rig.driver.alarms.on
        assert state.age_s[1] > rig.joints.period_s
        assert (state.age_s[[0, 2]] < rig.joints.period_s + 1e-9).all()
        assert (rig.cycle().age_s < rig.joints.period_s + 1e-9).all()


def test_a_servo_that_dies_takes_nobody_with_it_and_no_period_gets_longer(rig):
    with rig.driver as driver:
        rig.cycle(20)
        rig.servo("shoulder").trouble.silent = True  # the first to be asked
        begun_s = rig.clock.now_s()
        for k in range(1, 11):
            state = rig.cycle()
            assert rig.clock.now_s() == pytest.approx(begun_s + 0.004 * k)
            if k >= 2:
                assert (state.age_s[1:] < rig.joints.period_s + 1e-9).all()
            if k == 3:
                assert driver.alarms.level == Level.HOLD
        assert driver.alarms.level == Level.SIT
        assert codes(rig) == {"silent"}
        assert state.alarms[0].who == "shoulder"
        assert driver.late == 0


def test_nothing_is_fed_back_of_a_servo_that_does_not_answer(rig):
    with rig.driver:
        rig.cycle(20)
        rig.servo("shoulder").trouble.silent = True
        rig.cycle(6)
        sent = rig.driver.write(rig.hold(1.5))
        assert sent.tau_ff[0] == 0.0
        assert sent.tau_ff[1] != 0.0


def test_half_an_answer_costs_one_period(rig):
    with rig.driver as driver:
        rig.cycle(20)
        rig.servo("elbow").trouble.halves = 1
        lost = driver.reception.lost
        rig.cycle(3)
        assert driver.reception.lost - lost == 2  # its own and that of the one behind it
        assert not driver.alarms.on


@pytest.mark.parametrize(
    ("spoil", "code"),
    [
        (lambda servo: setattr(servo, "volts", 9.0), "input_voltage"),
        (lambda servo: setattr(servo, "winding_c", 90.0), "overheating"),
        (lambda servo: servo.suffer("overload"), "overload"),
        (lambda servo: servo.suffer("alert"), "electrical_shock"),
    ],
)
def test_an_alert_is_read_and_named_within_50_ms_and_latched(rig, spoil, code):
    with rig.driver as driver:
        rig.cycle(30)
        spoil(rig.servo("wrist"))
        for _ in range(round(0.05 / rig.joints.period_s)):
            state = rig.cycle()
        assert code in codes(rig)
        assert driver.alarms.level == Level.SIT
        assert {alarm.who for alarm in state.alarms} >= {"wrist"}
        rig.servo("wrist").trouble.error = 0
        rig.cycle(20)
        assert code in codes(rig)


def test_a_pause_longer_than_the_watchdog_is_latched_until_a_reset(rig):
    with rig.driver as driver:
        rig.cycle(20)
        rig.clock.sleep_until(rig.clock.now_s() + 0.06)
        rig.cycle(2)
        assert codes(rig) == {"lost_communication"}
        assert {servo.memory.get(98, 1, signed=True) for servo in rig.bench.servos.values()} == {-1}
        assert rig.cycle(5).watchdog
        driver.reset()
        state = rig.cycle(5)
        assert not state.watchdog
        assert {servo.memory.get(98, 1, signed=True) for servo in rig.bench.servos.values()} == {2}


def test_without_a_program_servos_stop_by_their_own_watchdogs(rig):
    driver = rig.driver.__enter__()
    rig.cycle(20, q=1.5)
    assert any(servo.tau_nm for servo in rig.bench.servos.values())
    rig.clock.sleep_until(rig.clock.now_s() + 0.05)
    for line in rig.bench.lines.values():
        line.advance(rig.clock.now_s())
        line.live(rig.clock.now_s())
    assert not any(servo.tau_nm for servo in rig.bench.servos.values())
    driver._is_armed = False  # it was killed
    driver.close()


def test_a_spare_commands_servos_that_were_left_on_before_they_stop(rig):
    first = rig.driver.__enter__()
    with rig.another() as spare:
        rig.cycle(20)
        first._is_armed = False  # it is killed, and its claim ends
        first.close()
        rig.driver = spare
        rig.cycle(3)
        assert {servo.memory.get(98, 1, signed=True) for servo in rig.bench.servos.values()} == {2}
        assert all(servo.is_on for servo in rig.bench.servos.values())
        assert not spare.alarms.on


def test_a_spare_asks_for_nothing_while_another_commands(rig):
    with rig.driver as first, rig.another() as spare:
        rig.cycle(5)
        busy_s = rig.bench.lines["arm"].busy_s
        state = spare.read()
        assert rig.bench.lines["arm"].busy_s == busy_s
        assert (state.age_s > 0.0).all()
        assert first.reception.lost == 0


def test_an_unplugged_port_is_named_and_the_other_goes_on(joints):
    ports = {"arm": joints.ports["arm"], "hand": Port(device="/dev/ttyUSB1", baud_hz=3_000_000)}
    wrist = msgspec.structs.replace(joints.joints["wrist"], port="hand")
    rig = Rig(
        msgspec.structs.replace(joints, ports=ports, joints={**joints.joints, "wrist": wrist})
    )
    with rig.driver:
        rig.cycle(20)
        rig.ports[-1].gone["hand"] = "it went away"
        state = rig.cycle()
        assert (state.alarms[0].code, state.alarms[0].who) == ("unplugged", "hand")
        state = rig.cycle(10)
        assert (state.age_s[:2] < rig.joints.period_s + 1e-9).all()
        rig.ports[-1].gone["arm"] = "it went away"
        with pytest.raises(DriverError, match="all ports"):
            rig.cycle()
        rig.ports[-1].gone.clear()


def test_a_jump_is_not_believed_and_three_are_latched(rig):
    with rig.driver as driver:
        state = rig.cycle(20)
        rig.servo("wrist").shaft.q_rad += 1.0
        after = rig.cycle()
        assert after.q[2] == pytest.approx(state.q[2], abs=0.05)
        rig.cycle(3)
        assert "encoder_jump" in {alarm.code for alarm in driver.alarms.on}


def test_warm_servos_give_less(rig):
    with rig.driver as driver:
        rig.cycle(20)
        for servo in rig.bench.servos.values():
            servo.winding_c, servo.heat_k_s = 75.0, 0.0
        rig.cycle(30)
        assert driver.alarms.level == Level.DERATE
        wild = rig.hold(0.5)
        wild.tau_ff[:] = 100.0
        sent = driver.write(wild)
        assert (sent.tau_ff < 0.55 * np.array([8.0, 6.0, 3.0])).all()


def test_not_a_number_is_refused_and_nothing_is_sent(rig):
    with rig.driver as driver:
        rig.cycle(5)
        busy_s = rig.bench.lines["arm"].busy_s
        command = rig.hold()
        command.tau_ff[1] = np.nan
        with pytest.raises(DriverError, match="tau_ff of elbow is nan"):
            driver.write(command)
        assert rig.bench.lines["arm"].busy_s == busy_s


def test_at_the_end_they_brake_by_themselves_and_it_is_said_how_it_went(rig):
    with rig.driver:
        rig.cycle(50)
    for servo in rig.bench.servos.values():
        assert servo.is_on
        assert servo.memory.get(11, 1) == 1
        assert servo.memory.get(98, 1) == 0
    assert rig.lines[-1] == (
        "Dynamixel: 3 joints, 50 periods at 250 Hz, 0 answers missed (0.000%), 0 packets spoilt, "
        "0 periods late"
    )


def test_twenty_servos_on_one_port_at_200_hz():
    """2 Mbit/s carry them; at 1 Mbit/s it is said how many ports it takes."""
    joints = ServoMap(
        rate_hz=200,
        ports={"all": Port(device="tty", baud_hz=2_000_000)},
        joints={
            f"joint{n}": JointServo(
                port="all", model="XM430-W350", id=n, lower_rad=-2.0, upper_rad=2.0,
                velocity_limit_rad_s=4.0, torque_limit_nm=3.0,
            )
            for n in range(1, 21)
        },
    )  # fmt: skip
    assert load.is_enough(20, 200, 2_000_000, 0.001)
    assert load.ports_needed(20, 200, 1_000_000, 0.001) == 2
    rig = Rig(joints)
    with rig.driver as driver:
        begun_s, busy_s = rig.clock.now_s(), 0.0
        rig.cycle(1)
        begun_s, busy_s = rig.clock.now_s(), rig.bench.lines["all"].busy_s
        rig.cycle(100)
        assert rig.clock.now_s() - begun_s == pytest.approx(0.5)
        used = (rig.bench.lines["all"].busy_s - busy_s) / 0.5
        assert used < joints.load("all") < 0.70
        assert driver.reception.lost == 0
        assert not driver.alarms.on


def test_commands_that_damp_slow_a_joint_down(rig):
    with rig.driver as driver:
        rig.cycle(2)
        rig.servo("wrist").shaft.qd_rad_s = 3.0
        n = len(rig.joints.joints)
        for _ in range(100):
            driver.write(MotorCommand.damping(n, rig.clock.now_s(), 0.5))
            state = driver.read()
        assert abs(state.qd[2]) < 0.5
