"""The driver on emulated wires: what it sends, what it believes, what it does when things fail."""

import numpy as np
import pytest

from robot.drivers.motor_bus import MotorCommand
from robot.drivers.motors.alarms import Level
from robot.drivers.motors.can import mit11
from robot.drivers.motors.can.driver import CanMotors
from robot.drivers.motors.can.frames import Frame
from robot.drivers.motors.can.values import Ranges
from robot.errors import DriverError
from sim.devices.direct import DirectPorts
from sim.devices.wire import CanFrame
from tests.fakes.can_rig import ARM, Rig, arm, killed, limbs, with_channels_of_its_own

PERIOD_S = 0.002
QUIET_S = 0.0015
"""Into a period all have answered: two that send under one identifier at once throw both off."""


@pytest.fixture
def rig(tmp_path) -> Rig:
    return Rig(arm(tmp_path))


def codes(rig: Rig) -> dict[str, str]:
    return {alarm.code: alarm.who for alarm in rig.driver.alarms.on}


# --- a spare takes over ------------------------------------------------------------------------


def test_what_a_spare_takes_over_has_a_watchdog_though_it_was_left_without(rig: Rig):
    with rig.driver:
        rig.cycle(100)
        with rig.another() as spare:
            for motor in rig.bench.devices:
                motor.registers[9] = 0
            killed(rig)
            assert spare.claim()
            spare.read()
            spare.write(rig.hold())
            spare.read()
            assert [motor.registers[9] for motor in rig.bench.devices] == [400, 400, 400]
            killed_s = rig.clock.now_s()
            spare._is_armed = False
    rig.clock.sleep_until(killed_s + 0.1)
    rig.bench.advance(rig.clock.now_s())
    assert {motor.status for motor in rig.bench.devices} == {0xD}


def test_a_spare_that_comes_too_late_asks_and_arms_all_motors_anew(rig: Rig):
    with rig.driver:
        rig.cycle(100)
        with rig.another() as spare:
            killed(rig)
            rig.clock.sleep_until(rig.clock.now_s() + 0.05)
            rig.bench.advance(rig.clock.now_s())
            assert spare.claim()
            state = spare.read()
            assert state.watchdog
            assert state.command_stamp_s == -np.inf
            rig.driver = spare
            rig.cycle(10)
            assert [motor.status for motor in rig.bench.devices] == [1, 1, 1]
            assert spare._is_known


def test_one_motor_that_let_go_or_lost_its_reply_is_no_inheritance(rig: Rig):
    with rig.driver:
        rig.cycle(100)
        with rig.another() as spare:
            rig.motor("wrist").status = 0
            killed(rig)
            assert spare.claim()
            assert spare.read().watchdog
            spare.write(rig.hold())
            assert spare._is_known
            assert [motor.status for motor in rig.bench.devices] == [1, 1, 1]


# --- replies are lost --------------------------------------------------------------------------


def test_one_lost_reply_is_bridged_for_a_period(rig: Rig):
    with rig.driver:
        before = rig.cycle(100)
        rig.motor("wrist").shaft.qd_rad_s = 2.0
        before = rig.cycle(1)
        rig.motor("wrist").trouble.loses = 1
        state = rig.cycle(1)
        assert state.age_s[2] > PERIOD_S > state.age_s[1]
        assert state.q[2] == pytest.approx(before.q[2] + before.qd[2] * PERIOD_S)
        assert rig.driver.alarms.level == Level.OK
        assert rig.cycle(1).age_s[2] < PERIOD_S
        assert rig.driver.reception.lost == 1


def test_three_in_a_row_hold_every_joint_and_its_reply_lets_go_again(rig: Rig):
    with rig.driver as driver:
        rig.cycle(300, q=0.4)
        rig.motor("wrist").trouble.loses = 3
        rig.cycle(3, q=0.4)
        assert codes(rig) == {"silent": "wrist"}
        assert driver.alarms.level == Level.HOLD
        sent = driver.write(rig.hold(0.9))
        np.testing.assert_allclose(sent.q_des, 0.4, atol=0.02)
        driver.read()
        assert driver.alarms.level == Level.OK
        sent = driver.write(rig.hold(0.9))
        assert (sent.q_des > 0.405).all()


def test_silence_of_20_ms_is_latched_until_a_person_resets(rig: Rig):
    with rig.driver as driver:
        rig.cycle(300, q=0.4)
        rig.motor("wrist").trouble.silent = True
        rig.cycle(9)
        assert driver.alarms.level == Level.HOLD
        rig.cycle(1)
        (alarm,) = driver.alarms.on
        assert (alarm.level, alarm.is_latched, alarm.who) == (Level.SIT, True, "wrist")
        assert "motor 3 on arm" in alarm.cause
        rig.motor("wrist").trouble.silent = False
        rig.cycle(50)
        assert driver.alarms.level == Level.SIT
        driver.reset()
        rig.cycle(50)
        assert driver.alarms.level == Level.OK


def test_reading_never_waits_longer_than_a_period(rig: Rig):
    with rig.driver as driver:
        rig.cycle(10)
        rig.motor("wrist").trouble.silent = True
        for _ in range(20):
            before_s = rig.clock.now_s()
            driver.write(rig.hold())
            driver.read()
            assert rig.clock.now_s() - before_s <= PERIOD_S * 1.001


# --- what it does not believe ------------------------------------------------------------------


def test_a_jump_is_not_believed_and_three_of_them_are_an_alarm(rig: Rig):
    with rig.driver as driver:
        state = rig.cycle(300, q=0.5)
        rig.motor("wrist").shaft.q_rad += 1.0
        after = rig.cycle(1)
        assert after.q[2] == pytest.approx(state.q[2], abs=0.02)
        assert driver.alarms.level == Level.OK
        rig.cycle(2)
        assert codes(rig) == {"encoder_jump": "wrist"}
        assert driver.alarms.level == Level.SIT


def test_strange_frames_are_ignored_and_counted(rig: Rig):
    stranger = rig.bench.wires["arm"].attach(lambda *_: None)
    with rig.driver as driver:
        state = rig.cycle(100, q=0.5)
        ignored = driver.reception.ignored
        for frame in (CanFrame(0x13, b"abc"), CanFrame(0x300, bytes(8)), CanFrame(0x13, b"")):
            stranger.send(frame, rig.clock.now_s() + QUIET_S)
        after = rig.cycle(2, q=0.5)
        np.testing.assert_allclose(after.q, state.q, atol=0.03)
        assert driver.reception.ignored == ignored + 3
        assert driver.alarms.level == Level.OK


def test_what_came_in_before_its_turn_is_dropped(rig: Rig):
    """A spare that nobody let read for a while begins with what is so now."""
    with rig.driver, rig.another() as spare:
        rig.cycle(50)
        assert rig.ports[-1]._heard
        rig.driver.close()
        assert spare.claim()
        assert not rig.ports[-1]._heard


def test_another_program_that_reads_registers_does_not_disturb(rig: Rig):
    with rig.driver as driver:
        state = rig.cycle(300, q=0.5)
        with rig.another() as reader:
            read = reader.read()
            np.testing.assert_allclose(read.q, state.q, atol=0.3)
        driver.reset()
        state = rig.cycle(100, q=0.5)
        np.testing.assert_allclose(state.q, 0.5, atol=0.05)


def test_noise_on_the_bus_raises_nothing_and_moves_nothing(rig: Rig):
    import random

    draw = random.Random(5)
    stranger = rig.bench.wires["arm"].attach(lambda *_: None)
    with rig.driver as driver:
        rig.cycle(300, q=0.5)
        for _ in range(500):
            number = draw.choice((0x11, 0x12, 0x13, 0x40, 0x7FE))
            frame = CanFrame(number, draw.randbytes(draw.randrange(9)))
            stranger.send(frame, rig.clock.now_s() + QUIET_S)
            state = rig.cycle(1, q=0.5)
        for joint, motor in zip(rig.joints.joints.values(), rig.bench.devices, strict=True):
            assert joint.lower_rad <= joint.joint_rad(motor.shaft.q_rad) <= joint.upper_rad
        assert np.isfinite(state.q).all()
        assert driver.reception.ignored > 200


# --- motors that fail --------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("status", "code", "level"),
    [(0xA, "over_current", Level.HOLD), (0xC, "winding_hot", Level.SIT),
     (9, "under_voltage", Level.SIT),
     (0xE, "overload", Level.HOLD), (5, "unknown_status_5", Level.SIT)],
)  # fmt: skip
def test_a_fault_that_a_motor_reports_is_named(rig: Rig, status: int, code: str, level: Level):
    with rig.driver as driver:
        rig.cycle(100)
        rig.motor("wrist").trouble.status = status
        rig.cycle(2)
        assert codes(rig) == {code: "wrist"}
        assert driver.alarms.level == level


def test_a_warm_motor_gives_less_and_less(rig: Rig):
    with rig.driver as driver:
        rig.cycle(300, q=0.9, kp=200.0)
        most = []
        for celsius in (50.0, 65.0, 75.0, 85.0):
            rig.motor("wrist").winding_c = celsius
            rig.cycle(1, q=0.9)
            push = rig.hold(0.9, kp=0.0, kd=0.0)
            push.tau_ff[2] = 7.0
            most.append(driver.write(push).tau_ff[2])
            driver.read()
        assert codes(rig) == {"warm": "wrist"}
        assert driver.alarms.level == Level.DERATE
    assert most == pytest.approx([7.0, 5.8, 3.3, 2.1], abs=0.15)


def test_a_motor_that_let_go_is_armed_again_by_a_reset_alone(rig: Rig):
    with rig.driver as driver:
        rig.cycle(50)
        rig.clock.sleep_until(rig.clock.now_s() + 0.05)  # SIGSTOP
        rig.bench.advance(rig.clock.now_s())
        state = rig.cycle(5)
        assert state.watchdog
        assert set(codes(rig)) >= {"lost_communication"}
        assert driver.late >= 1
        rig.cycle(20)
        assert {motor.status for motor in rig.bench.devices} == {0xD}
        driver.reset()
        state = rig.cycle(50)
        assert driver.alarms.level == Level.OK
        assert {motor.status for motor in rig.bench.devices} == {1}


def test_at_sit_commands_pass_so_that_the_robot_can_be_lowered_and_the_state_says_why(rig: Rig):
    with rig.driver as driver:
        rig.cycle(300, q=0.4)
        rig.motor("wrist").trouble.silent = True
        rig.cycle(5, q=0.6)
        assert rig.cycle(1).alarms[0].level == "HOLD"
        held = driver.write(rig.hold(0.6)).q_des
        driver.read()
        rig.cycle(4, q=0.6)
        state = rig.cycle(150, q=0.6)
        (alarm,) = state.alarms
        assert (alarm.code, alarm.who, alarm.level) == ("silent", "wrist", "SIT")
        assert alarm.cure
        assert held[1] < 0.5
        assert state.q[1] == pytest.approx(0.6, abs=0.06)  # the elbow, which is well, obeys


# --- buses that fail ---------------------------------------------------------------------------


def test_a_bus_that_is_off_is_told_and_the_others_go_on():
    rig = Rig(limbs(2, 2))
    with rig.driver as driver:
        rig.cycle(50)
        rig.ports[0].node("bus0").garbles = 1000
        rig.cycle(10)
        assert codes(rig)["bus_off"] == "bus0"
        assert driver.alarms.level == Level.SIT
        state = rig.cycle(5)
        assert (state.age_s[:2] > 0.01).all()
        assert (state.age_s[2:] < PERIOD_S).all()


def test_with_no_motor_powered_the_queue_fills_and_nothing_old_is_ever_sent():
    rig = Rig(limbs(1, 3))
    wire = rig.bench.wires["bus0"]
    with rig.driver as driver:
        rig.cycle(20)
        nodes = [motor._node for motor in rig.bench.devices]
        for node in nodes:
            wire.detach(node)
        for k in range(100):
            before_s = rig.clock.now_s()
            rig.cycle(1, q=0.01 * k)
            assert rig.clock.now_s() - before_s <= PERIOD_S * 1.001
        assert codes(rig)["queue_full"] == "bus0"
        queue = driver.queues["bus0"]
        assert queue.waiting <= 3
        assert queue.replaced > 200
        heard: list[CanFrame] = []
        wire.attach(lambda frame, _: heard.append(frame))
        for node in nodes:
            wire.nodes.append(node)
        rig.cycle(3, q=1.0)
        commands = [frame for frame in heard if frame.id in (1, 2, 3)]
        assert len(commands) <= 10 + 3 * 3 + 3  # the interface's own queue, then new ones only


# --- commands ----------------------------------------------------------------------------------


@pytest.mark.parametrize("field", ["q_des", "qd_des", "tau_ff", "kp", "kd"])
@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_what_is_not_finite_is_refused_by_joint_and_field(rig: Rig, field: str, bad: float):
    with rig.driver as driver:
        rig.cycle(10)
        command = rig.hold()
        getattr(command, field)[1] = bad
        sent = rig.bench.wires["arm"].busy_s
        with pytest.raises(DriverError, match=f"{field} of elbow"):
            driver.write(command)
        rig.bench.advance(rig.clock.now_s())
        assert rig.bench.wires["arm"].busy_s == sent


def test_whatever_is_asked_no_motor_gives_more_than_its_joint_may():
    rig = Rig(limbs(1, 4))
    draw = np.random.default_rng(6)
    worst = 0.0
    with rig.driver as driver:
        rig.cycle(5)
        for _ in range(400):
            wild = MotorCommand(
                rig.clock.now_s(),
                *(draw.normal(0.0, scale, 4) for scale in (5.0, 50.0, 200.0)),
                *(draw.exponential(scale, 4) for scale in (500.0, 10.0)),
            )
            driver.write(wild)
            driver.read()
            worst = max(worst, *(abs(motor.tau_nm) for motor in rig.bench.devices))
    assert worst <= 54.0
    assert all(count > 0 for count in driver.limiter.clipped.values())


def test_one_program_commands_and_others_read(rig: Rig):
    with rig.driver as first, rig.another() as second:
        first.write(rig.hold())
        assert first.claim()
        assert not second.claim()
        with pytest.raises(DriverError, match="another controller"):
            second.write(rig.hold())
        first.read()
    with rig.another() as third:
        assert third.claim()


def test_the_bus_is_as_busy_as_computed(rig: Rig):
    with rig.driver:
        rig.cycle(10)
        wire = rig.bench.wires["arm"]
        before = wire.busy_s, rig.clock.now_s()
        rig.cycle(500)
        share = (wire.busy_s - before[0]) / (rig.clock.now_s() - before[1])
    assert share == pytest.approx(rig.joints.load("arm"), rel=0.01)
    assert share == pytest.approx(3 * 500 * 270e-6, rel=0.01)


def test_motors_that_cannot_be_asked_are_silent_without_alarm_until_they_are_commanded(tmp_path):
    ranges = "ranges: {position_rad: 12.5, velocity_rad_s: 30, torque_nm: 10}"
    rig = Rig(arm(tmp_path))
    asked = arm(tmp_path, ARM.replace("model: DM4310", f"model: AK80-9, {ranges}"))
    driver = CanMotors(
        with_channels_of_its_own(asked), rig.clock, ports=lambda: DirectPorts(rig.bench, rig.clock)
    )
    with driver:
        for _ in range(30):
            driver.read()
        assert driver.alarms.level == Level.OK


def test_a_damaged_command_does_not_exist():
    with pytest.raises(DriverError):
        mit11.target(Frame(1, b"short"), Ranges(1.0, 1.0, 1.0))


def test_replies_that_come_late_and_together_are_no_twin(rig: Rig):
    """Of a busy computer: nothing for six periods, then those of two in each."""
    with rig.driver as driver:
        rig.cycle(20, q=0.5)
        ports = rig.ports[0]
        hear, kept = ports.receive_packed, list[list[tuple[str, bytes]]]()
        may_hand = [0]

        def receive():
            kept[-1].extend(hear())
            given = [one for _ in range(may_hand[0]) if len(kept) > 1 for one in kept.pop(0)]
            may_hand[0] = 0
            return given

        ports.receive_packed = receive
        for period in range(14):
            kept.append([])
            may_hand[0] = 2 if period >= 6 else 0
            rig.cycle(1, q=0.5)
            assert "duplicate_id" not in {one.code for one in driver.alarms.on}
        ports.receive_packed = hear
