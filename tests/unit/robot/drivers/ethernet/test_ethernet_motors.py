"""The driver of motors behind Ethernet: emulated boards, in simulated time, and what goes wrong."""

import struct
from itertools import pairwise

import numpy as np
import pytest

from robot.drivers.motors.alarms import Level
from robot.drivers.motors.ethernet import datagrams
from robot.drivers.motors.ethernet.datagrams import ANSWER, Datagram, Kind
from robot.errors import DriverError
from sim.devices import ethernet_codec
from sim.devices.ethernet_board import BRAKING, ENABLED
from tests.fakes.ethernet_rig import Rig, arm, killed, limbs

PERIOD_S = 0.002


@pytest.fixture
def joints(tmp_path):
    return arm(tmp_path)


@pytest.fixture
def rig(joints):
    return Rig(joints)


def codes(rig: Rig) -> set[str]:
    return {alarm.code for alarm in rig.driver.alarms.on}


def on(rig: Rig) -> list[bool]:
    return [drive.is_on for drive in rig.bench.drives.values()]


def test_joints_get_where_they_are_sent_through_sign_gear_and_offset(rig):
    with rig.driver as driver:
        state = rig.cycle(1500, q=0.8, kp=40.0, kd=2.0)
        np.testing.assert_allclose(state.q, 0.8, atol=0.02)
        shafts = {name: drive.shaft.q_rad for name, drive in rig.bench.drives.items()}
        assert shafts["shoulder"] == pytest.approx(-(0.8 - 0.3), abs=0.02)
        assert shafts["elbow"] == pytest.approx(1.6, abs=0.04)
        assert driver.alarms.level == Level.OK
        assert driver.late == driver.reception.lost == driver.reception.refused.total() == 0
        assert (state.age_s < PERIOD_S).all()
        assert state.command_stamp_s == pytest.approx(state.stamp_s - PERIOD_S)
        assert not state.watchdog
        assert np.isfinite(state.temperature_c).all()
    assert "0 replies late (0.000%), 0 datagrams refused, 0 not sent" in rig.lines[-1]


def test_one_datagram_a_board_and_period_says_it_all_with_sequences_that_go_up(rig):
    told: list[tuple[str, datagrams.Datagram]] = []
    with rig.driver:
        rig.cycle(5)
        ports = rig.ports[0]
        sends = ports.send

        def send(board: str, data: bytes) -> bool:
            one = datagrams.opened(data)
            assert isinstance(one, Datagram)
            told.append((board, one))
            return sends(board, data)

        ports.send = send
        rig.cycle(10)
        ports.send = sends
    assert [board for board, _ in told] == ["upper", "lower"] * 10
    assert {one.kind for _, one in told} == {Kind.COMMAND}
    assert {(board, one.joints) for board, one in told} == {("upper", 0b11), ("lower", 1 << 5)}
    sequences = [one.sequence for board, one in told if board == "upper"]
    assert all((b - a) % datagrams.TURN == 1 for a, b in pairwise(sequences))
    assert len({one.session for _, one in told}) == 1


@pytest.mark.parametrize(
    ("flaw", "said"),
    [
        ("silent", "the board 'upper'"),
        ("loses_replies", "does not answer"),
        ("spoils", "answers is refused: 3 by their "),
        ("old_version", "answers is refused: 3 by their version (is its firmware of version 1"),
        ("wrong_board", "is board 0, the map says 1"),
        ("not_a_number", "or what it tells is no number"),
        ("wrong_model", "it is a OTHER-1, the map says ARM-20"),
        ("weak", "its drive does 25 N m at the joint, the map says 40"),
        ("unplugged_slot", "has no drive in slot 0"),
        ("hot", "it reports winding hot"),
        ("low_volts", "it reports under voltage"),
        ("over_current", "it reports over current"),
    ],
)
def test_what_is_wrong_at_the_start_is_named_and_nothing_is_enabled(joints, flaw, said):
    rig = Rig(joints, elbow=flaw)
    with pytest.raises(DriverError, match="elbow") as caught, rig.driver:
        pass
    assert said in str(caught.value)
    assert not any(on(rig))
    with pytest.raises(DriverError, match="not open"):
        rig.driver.read()


def test_a_board_that_keeps_no_watchdog_is_not_enabled(joints):
    rig = Rig(joints, wrist="no_watchdog")
    with rig.driver as driver, pytest.raises(DriverError, match=r"lower.*nothing is enabled|lower"):
        driver.write(rig.hold())
    assert not any(on(rig))


def test_its_watchdog_is_written_and_the_board_brakes_when_nothing_comes(rig):
    with rig.driver as driver:
        rig.cycle(20)
        board = rig.cable("elbow").board
        assert board.timeout_s == pytest.approx(0.02)
        rig.let_pass(0.018)
        assert board.is_on
        rig.let_pass(0.004)
        assert not board.is_on
        elbow = rig.drive("elbow")
        assert elbow.state == BRAKING
        assert elbow.damping_nm_s == pytest.approx(0.5)  # 2 N m s/rad behind a gear of 2
        state = rig.cycle(2)
        assert state.watchdog
        assert {one.code for one in state.alarms} == {"lost_communication"}
        assert driver.alarms.level == Level.SIT
        rig.cycle(50)
        assert elbow.state == BRAKING  # commands do not bring it back
        driver.reset()
        assert not rig.cycle(5).watchdog
        assert elbow.state == ENABLED
        assert not driver.alarms.on


def test_leaving_lets_boards_brake_for_ever(rig):
    with rig.driver:
        rig.cycle(20)
    rig.let_pass(0.2)
    for drive in rig.bench.drives.values():
        assert drive.state == BRAKING
    rig.bench.drives["wrist"].shaft.qd_rad_s = 3.0
    rig.let_pass(0.1)
    assert abs(rig.bench.drives["wrist"].shaft.qd_rad_s) < 0.05


# --- answers that are none -----------------------------------------------------------------------


def refused(rig: Rig) -> dict[str, int]:
    return dict(rig.driver.reception.refused)


def test_one_lost_answer_is_bridged_for_a_period(rig):
    with rig.driver as driver:
        rig.cycle(20, q=0.5, kp=5.0)
        rig.cable("wrist").trouble.loses = 1
        lost = driver.reception.lost
        before = driver.reception.q[2]
        state = rig.cycle(1, q=0.5, kp=5.0)
        assert state.q[2] != before
        assert driver.reception.lost - lost == 1
        assert state.age_s[2] > PERIOD_S
        assert (state.age_s[:2] < PERIOD_S).all()
        assert state.q[2] == pytest.approx(rig.drive("wrist").shaft.q_rad, abs=0.004)
        assert not state.alarms
        assert (rig.cycle().age_s < PERIOD_S).all()


def test_an_answer_of_the_period_before_is_late_and_not_believed(rig):
    with rig.driver as driver:
        rig.cycle(20)
        rig.cable("wrist").trouble.later_s = 0.0022
        state = rig.cycle(1)
        assert state.age_s[2] > PERIOD_S
        rig.cycle(1)
        assert refused(rig) == {"late": 1}
        assert driver.reception.lost == 2
        rig.cycle(2)
        assert codes(rig) == {"silent"}
        assert driver.alarms.level == Level.HOLD
        rig.cable("wrist").trouble.later_s = 0.0
        rig.cycle(3)
        assert not driver.alarms.on


@pytest.mark.parametrize(("flaw", "reason"), [("doubles", "duplicate"), ("swaps", "late")])
def test_what_comes_twice_or_in_another_order_is_counted_and_only_the_right_one_taken(
    rig, flaw, reason
):
    with rig.driver as driver:
        rig.cycle(20)
        setattr(rig.cable("wrist").trouble, flaw, 1)
        rig.cycle(5)
        assert refused(rig) == {reason: 1}
        assert driver.reception.lost == (1 if flaw == "swaps" else 0)
        assert not driver.alarms.on


def test_a_spoilt_answer_and_one_of_another_version_are_refused_by_their_reasons(rig):
    with rig.driver as driver:
        rig.cycle(20)
        rig.cable("wrist").trouble.spoils = 1
        rig.cycle(2)
        assert driver.reception.refused.total() == 1
        rig.cable("elbow").board.trouble.old_version = True
        rig.cycle(1)
        rig.cable("elbow").board.trouble.old_version = False
        assert driver.reception.refused["version"] == 1
        rig.cycle(2)
        assert not driver.alarms.on


def test_a_board_whose_time_stands_still_is_stale_and_then_silent(rig):
    with rig.driver as driver:
        rig.cycle(20)
        rig.cable("wrist").board.trouble.frozen_us = 0
        rig.cycle(4)
        assert driver.reception.refused["stale"] == 3
        assert codes(rig) == {"silent"}


def test_a_joint_whose_numbers_are_none_is_not_believed_and_the_others_of_its_board_are(rig):
    with rig.driver as driver:
        rig.cycle(20)
        rig.drive("elbow").trouble.not_a_number = True
        state = rig.cycle(1)
        assert driver.reception.refused["not_a_number"] == 1
        assert np.isfinite(state.q).all()
        assert state.age_s[1] > PERIOD_S
        assert state.age_s[0] < PERIOD_S
        rig.cycle(3)
        assert {(one.code, one.who) for one in driver.alarms.on} == {("silent", "elbow")}


def test_forgeries_of_other_sessions_boards_and_kinds_change_nothing(rig):
    """Whole, with a CRC that is right: as one sends who has read the page."""
    with rig.driver as driver:
        state = rig.cycle(500)
        talk = driver._opened_talk()
        body = ethernet_codec.itself(obeyed=1, volts=0.0, celsius=200.0, refused=0, flags=3)
        body += ethernet_codec.joint(3.0, 9.0, 9.0, celsius=200.0, faults=255, state=0)
        right = (Kind.COMMAND | ANSWER, 2, 1 << 5, talk.session, talk.sequence + 1, 1)
        for place, value in [
            (0, 0x82),
            (1, 3),
            (2, 1),
            (3, talk.session ^ 1),
            (4, talk.sequence + 9),
        ]:
            wrong = list(right)
            wrong[place] = value
            driver.write(rig.hold())
            rig.ports[0].inject("lower", datagrams.packed(Datagram(*wrong, body)))
            after = driver.read()
            right = (*right[:4], right[4] + 1, right[5])
        assert not driver.alarms.on
        np.testing.assert_allclose(after.q, state.q, atol=0.05)
        assert sum(driver.reception.refused.values()) == 5
        assert driver.reception.lost == 0
        assert {"kind", "board", "joints", "session", "ahead"} == set(refused(rig))


def test_many_refused_datagrams_warn_by_board_and_reason(rig):
    with rig.driver as driver:
        rig.cycle(20)
        rig.ports[0].strangers["lower"] += 3
        for _ in range(4):
            rig.ports[0].inject("lower", b"whatever this is, it is not ours and long enough")
        rig.cycle(501)
        (alarm,) = driver.alarms.on
        assert (alarm.code, alarm.who, alarm.level) == ("noisy", "lower", Level.WARN)
        assert "7 datagrams refused in 1 s: 4 magic, 3 source" in alarm.cause
        rig.cycle(501)
        assert not driver.alarms.on


def test_a_drive_that_tells_wrong_speeds_is_seen_within_160_ms_of_moving(rig):
    with rig.driver:
        rig.cycle(100, q=0.5)
        rig.drive("wrist").trouble.speed_scale = 0.5
        moves_s, seen_s = [], []
        for k in range(150):
            state = rig.cycle(1, q=0.5 + 0.4 * np.sin(0.03 * k), kp=20.0, kd=0.5)
            if abs(rig.drive("wrist").shaft.qd_rad_s) > 0.5:
                moves_s.append(rig.clock.now_s())
            if ("speed_mismatch", "wrist") in {(one.code, one.who) for one in state.alarms}:
                seen_s.append(rig.clock.now_s())
        assert seen_s
        assert seen_s[0] - moves_s[0] < 0.16


def test_a_first_answer_that_is_lost_makes_no_speed_wrong(rig, monkeypatch):
    """Of a joint far from 0, of which nothing is known yet."""
    periods = rig.driver._periods
    begin = periods.begin

    def begins() -> None:
        begin()
        rig.cable("elbow").trouble.loses = 1

    monkeypatch.setattr(periods, "begin", begins)
    with rig.driver as driver:
        for _ in range(200):
            driver.read()
        assert driver.reception.lost == 2  # both joints of its board, once
        ratio = driver.speeds.ratio
        assert np.isfinite(ratio).any()
        assert (np.isnan(ratio) | (np.abs(ratio - 1.0) < 0.2)).all()


# --- commands that are none ----------------------------------------------------------------------


def test_a_board_refuses_what_was_overtaken_what_comes_twice_and_what_is_no_number(rig):
    with rig.driver as driver:
        rig.cycle(20)
        cable, talk = rig.cable("wrist"), driver._opened_talk()
        order = cable.board.drives[5].order
        nan = struct.pack("<5f", np.nan, 0, 0, 0, 0)
        wild = struct.pack("<5f", 0.9, 0, 90, 0, 0)
        for number, (sequence, body) in enumerate(
            [(talk.sequence, wild), (talk.sequence - 3, wild), (talk.sequence + 1, nan)], start=1
        ):
            said = Datagram(Kind.COMMAND, 2, 1 << 5, talk.session, sequence, 0, body)
            assert cable.board.hear(datagrams.packed(said), rig.clock.now_s()) is None
            assert cable.board.refused == number
        assert cable.board.drives[5].order == order
        other = Datagram(Kind.COMMAND, 2, 1 << 5, talk.session ^ 7, talk.sequence + 1, 0, wild)
        answer = cable.board.hear(datagrams.packed(other), rig.clock.now_s())
        assert answer is not None  # it may read, and is told that another one commands
        opened = datagrams.opened(answer)
        assert isinstance(opened, Datagram)
        assert datagrams.told(opened.body).flags == datagrams.FLAGS_OTHERS
        assert cable.board.drives[5].order == order


def test_no_drive_is_ever_told_more_than_its_joint_may_give(rig):
    most = np.array([one.torque_limit_nm for one in rig.joints.joints.values()])
    with rig.driver as driver:
        rig.cycle(3)
        for k in range(60):
            wild = rig.hold(5.0 * (-1) ** k, kp=400.0, kd=5.0)
            wild.tau_ff[:] = 100.0 * (-1) ** k
            state = driver.read()
            sent = driver.write(wild)
            law = (
                sent.kp * (sent.q_des - state.q) + sent.kd * (sent.qd_des - state.qd) + sent.tau_ff
            )
            assert (np.abs(law) <= most * 1.001).all()


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_not_a_number_is_refused_by_joint_and_field_and_nothing_is_sent(rig, value):
    with rig.driver as driver:
        rig.cycle(3)
        heard = rig.cable("wrist").board.heard
        bad = rig.hold()
        bad.kd[2] = value
        with pytest.raises(DriverError, match="kd of wrist"):
            driver.write(bad)
        driver.read()
        assert rig.cable("wrist").board.heard == heard


def test_what_the_system_does_not_take_is_dropped_and_the_next_one_is_newer(rig):
    with rig.driver as driver:
        rig.cycle(20)
        rig.ports[0].full.add("lower")
        began_s = rig.clock.now_s()
        for _ in range(12):
            rig.cycle()
        assert rig.clock.now_s() - began_s == pytest.approx(12 * PERIOD_S)
        assert driver.unsent == 12
        assert "queue_full" in codes(rig)
        rig.ports[0].full.clear()
        driver.reset()
        rig.cycle(3)
        assert not driver.alarms.on


# --- one commander -------------------------------------------------------------------------------


def test_a_spare_commands_the_joints_of_a_killed_controller_before_they_brake(rig):
    with rig.driver:
        rig.cycle(20)
        spare = rig.another()
        with spare:
            for _ in range(5):
                rig.cycle()
                spare.read()
            killed(rig)
            state = spare.read()
            assert not state.watchdog or not spare._claim.is_held
            assert spare.claim()
            spare.write(rig.hold())
            assert "commanded as they are" in rig.lines[-1]
            for _ in range(10):
                spare.write(rig.hold())
                state = spare.read()
            assert all(on(rig))
            assert not state.alarms
            assert not any(cable.board.is_expired for cable in rig.bench.cables.values())
            spare._is_armed = False


def test_who_reads_takes_no_answer_from_who_commands(rig):
    with rig.driver as driver:
        rig.cycle(500)
        with rig.another() as reader:
            rig.cycle(3)
            lost, missed = driver.reception.lost, reader.reception.lost
            for _ in range(50):  # both in the same periods, the reader without a wait of its own
                reader._ask(reader._life.lines, Kind.STATE, dict.fromkeys(rig.joints.boards, b""))
                state = rig.cycle()
                reader._hear()
                told = reader._state()
            np.testing.assert_allclose(told.q, state.q, atol=0.02)
            assert driver.reception.lost == lost
            assert reader.reception.lost == missed
        assert all(on(rig))


def test_a_board_that_another_program_takes_is_latched(rig):
    with rig.driver as driver:
        rig.cycle(20)
        board = rig.cable("wrist").board
        theirs = Datagram(Kind.ENABLE, 2, 1 << 5, 999, 1, 0, b"")
        board.hear(datagrams.packed(theirs), rig.clock.now_s())
        rig.cycle(2)
        assert ("commanded_by_another", "lower") in {
            (one.code, one.who) for one in driver.alarms.on
        }
        assert driver.alarms.level == Level.SIT


def test_a_board_that_lost_its_power_is_said_to_have_restarted_and_stays_off(rig):
    with rig.driver as driver:
        rig.cycle(20)
        rig.cable("wrist").board.restart(rig.clock.now_s())
        rig.cycle(2)
        assert {("restarted", "lower"), ("disabled", "wrist")} <= {
            (one.code, one.who) for one in driver.alarms.on
        }
        assert not rig.drive("wrist").is_on
        rig.cycle(50)
        assert not rig.drive("wrist").is_on
        driver.reset()
        rig.cycle(5)
        assert all(on(rig))
        assert not driver.alarms.on


def test_on_a_network_that_loses_a_fiftieth_nothing_is_held_for_long_and_no_period_is_longer():
    rig = Rig(limbs(5, 6), is_still=True)
    with rig.driver as driver:
        rig.cycle(20)
        for cable in rig.bench.cables.values():
            cable.trouble.loses_share = 0.01
        began_s = rig.clock.now_s()
        held = 0
        for _ in range(1000):
            state = rig.cycle(1, q=0.1)
            held += any(alarm.level == "HOLD" for alarm in state.alarms)
        assert rig.clock.now_s() - began_s == pytest.approx(2.0)
        assert driver.late == 0
        share = driver.reception.lost / (1000 * 30)
        assert 0.01 < share < 0.03
        assert driver.alarms.level < Level.SIT
        assert held < 20
