"""What the owner sends period by period, with a body that is only told of."""

import numpy as np
import pytest

from robot.drivers.body_sample import BodySample, ForceReading, ImuReading
from robot.drivers.motor_bus import MotorCommand, MotorState
from robot.drivers.motors.alarms import Level
from robot.drivers.motors.owned.memory import Order
from robot.owner.balancing import OwnController
from robot.owner.owner import BusOwner
from robot.owner.reactions import WELL, Refused
from robot.physics import GRAVITY_M_S2

PERIOD_S = 0.002


class Rig:
    """A robot that stands, its owner, and a controller that may stop commanding."""

    def __init__(self, body, squat) -> None:
        self.body, self.squat = body, squat
        self.owner = BusOwner(body, squat)
        self.period, self.number = 0, 0
        self.q = np.array(body.description.posture("nominal"))
        self.q[squat.legs] = squat.q_rad[8]
        self.bears = [0.5, 0.5]
        self.lets_go = self.is_claimed = False
        self.sent: list[MotorCommand | None] = []

    @property
    def now_s(self) -> float:
        return self.period * PERIOD_S

    @property
    def level(self) -> Level:
        return self.owner.state.level

    def sample(self) -> BodySample:
        zero = np.zeros(self.body.count)
        motors = MotorState(
            self.now_s, self.q.copy(), zero, zero, zero + 30.0, zero,
            watchdog=self.lets_go or not any(self.sent), command_stamp_s=-np.inf,
        )  # fmt: skip
        imu = ImuReading(self.now_s, np.zeros(3), np.array((0.0, 0.0, GRAVITY_M_S2)))
        ankles = np.zeros((2, 6))
        ankles[:, 2] = np.array(self.bears) * GRAVITY_M_S2 * self.body.mass_kg
        return BodySample(motors, imu, ForceReading(self.now_s, ankles, np.zeros((2, 6))))

    def command(self, *, at: float = 0.1) -> MotorCommand:
        zero = np.zeros(self.body.count)
        return MotorCommand(
            self.now_s, self.q.copy(), zero + at, zero + 2.0, self.body.kp, self.body.kd
        )

    def order(self, *, late_s: float = 0.0, leaves: bool = False) -> Order:
        self.number += 1
        return Order(self.number, self.now_s - late_s + 0.004, leaves, self.command())

    def pass_by(self, periods: int = 1, *, commanded: bool = False, is_pressed: bool = False):
        """So many periods; returns what was sent in the last one."""
        for _ in range(periods):
            self.period += 1
            order = self.order() if commanded else None
            claimed = self.is_claimed or commanded
            self.sent.append(
                self.owner.decide(self.sample(), order, is_pressed=is_pressed, is_claimed=claimed)
            )
        return self.sent[-1]


@pytest.fixture
def rig(body, squat) -> Rig:
    return Rig(body, squat)


def is_without_torque(command: MotorCommand) -> bool:
    return not any((command.kp.any(), command.kd.any(), command.tau_ff.any()))


def test_before_the_first_command_nothing_is_sent_however_long_that_takes(rig):
    rig.pass_by(1000)
    assert rig.sent == [None] * 1000
    assert rig.owner.state == WELL


def test_a_command_is_sent_on_in_its_period(rig):
    sent = rig.pass_by(20, commanded=True)
    assert sent.tau_ff == pytest.approx(2.0)
    assert sent.qd_des == pytest.approx(0.1)
    assert rig.level == Level.OK


def test_a_controller_that_falls_silent_holds_6_ms_then_sits_then_damps_then_nothing(rig):
    rig.pass_by(20, commanded=True)
    lost_s, told = rig.now_s, dict[Level, float]()
    for _ in range(3500):
        rig.pass_by()
        told.setdefault(rig.level, rig.now_s - lost_s)
        if rig.level == Level.SIT:  # the joints follow
            rig.q[rig.squat.legs] = rig.sent[-1].q_des[rig.squat.legs]
    assert list(told) == [Level.HOLD, Level.SIT, Level.DAMP, Level.OFF]
    assert told[Level.HOLD] == pytest.approx(0.002)
    assert told[Level.SIT] == pytest.approx(0.008)
    assert 2.0 < told[Level.DAMP] < 3.1
    assert told[Level.OFF] == pytest.approx(told[Level.DAMP] + 2.0, abs=0.01)
    assert is_without_torque(rig.sent[-1])


def test_held_joints_keep_their_last_targets_without_speed(rig):
    last = rig.pass_by(20, commanded=True)
    for _ in range(3):
        held = rig.pass_by()
        assert rig.level == Level.HOLD
        assert held.q_des == pytest.approx(last.q_des)
        assert held.tau_ff == pytest.approx(last.tau_ff)
        assert not held.qd_des.any()


def test_one_that_stands_still_and_keeps_its_claim_is_given_20_ms(rig):
    rig.pass_by(20, commanded=True)
    rig.is_claimed = True
    rig.pass_by(10)
    assert rig.level == Level.HOLD
    rig.pass_by()
    assert (rig.level, rig.owner.state.code) == (Level.SIT, "controller_silent")


def test_a_spare_that_claims_within_6_ms_has_until_20_ms_for_its_first_command(rig):
    rig.pass_by(20, commanded=True)
    rig.pass_by(3)
    rig.is_claimed = True
    rig.pass_by(7)
    assert rig.level == Level.HOLD
    rig.pass_by(commanded=True)
    assert rig.owner.state == WELL


def test_a_spare_within_the_hold_goes_on_and_nothing_is_latched(rig):
    rig.pass_by(20, commanded=True)
    rig.pass_by(3)
    assert rig.level == Level.HOLD
    rig.pass_by(commanded=True)
    assert rig.owner.state == WELL
    assert rig.sent[-1].qd_des == pytest.approx(0.1)


def test_one_that_comes_later_is_not_obeyed_until_a_person_resets_it(rig):
    rig.pass_by(20, commanded=True)
    rig.pass_by(5)
    assert rig.level == Level.SIT
    rig.pass_by(3000, commanded=True)
    assert rig.level == Level.OFF
    assert is_without_torque(rig.sent[-1])
    assert rig.owner.reset() == WELL
    assert rig.pass_by() is None  # nobody commands yet, and the motors are not enabled
    rig.pass_by(commanded=True)
    assert rig.level == Level.OK
    assert rig.sent[-1].tau_ff == pytest.approx(2.0)


def test_a_reset_on_the_way_down_is_refused_and_changes_nothing(rig):
    rig.pass_by(20, commanded=True)
    rig.pass_by(100)
    before = rig.owner.state
    assert isinstance(rig.owner.reset(), Refused)
    assert rig.owner.state == before


@pytest.mark.parametrize("bears", [[1.0, 0.0], [0.95, 0.05], [0.0, 0.0]])
def test_in_a_step_or_in_the_air_it_damps(rig, bears):
    rig.pass_by(20, commanded=True)
    rig.bears = bears
    sent = rig.pass_by(5)
    assert (rig.level, rig.owner.state.code) == (Level.DAMP, "controller_lost_astray")
    assert not sent.kp.any()
    assert not sent.tau_ff.any()
    assert sent.kd == pytest.approx(rig.body.kd)


def test_a_robot_that_knows_no_squat_damps(body, squat):
    rig = Rig(body, squat)
    rig.owner = BusOwner(body, None)
    rig.pass_by(20, commanded=True)
    rig.pass_by(5)
    assert rig.level == Level.DAMP


def test_a_command_after_its_deadline_is_not_carried_out(rig):
    rig.pass_by(20, commanded=True)
    rig.period += 1
    sent = rig.owner.decide(
        rig.sample(), rig.order(late_s=0.006), is_pressed=False, is_claimed=True
    )
    assert rig.owner.stale == 1
    assert rig.level == Level.HOLD
    assert not sent.qd_des.any()


def test_a_controller_that_takes_its_leave_is_not_missed(rig):
    rig.pass_by(20, commanded=True)
    rig.period += 1
    rig.owner.decide(rig.sample(), rig.order(leaves=True), is_pressed=False, is_claimed=True)
    rig.pass_by(500)
    assert rig.owner.state == WELL


def test_the_stop_takes_all_torque_in_the_period_in_which_it_is_seen(rig):
    rig.pass_by(20, commanded=True)
    sent = rig.pass_by(commanded=True, is_pressed=True)
    assert rig.level == Level.OFF
    assert is_without_torque(sent)
    rig.pass_by(50, commanded=True)
    assert rig.level == Level.OFF  # released, and latched
    assert is_without_torque(rig.sent[-1])


def test_a_reset_while_the_stop_is_pressed_is_refused_and_taken_once_it_is_not(rig):
    rig.pass_by(20, commanded=True)
    rig.pass_by(10, is_pressed=True)
    refused = rig.owner.reset()
    assert isinstance(refused, Refused)
    assert refused.code == "stop_pressed"
    rig.pass_by(10)
    assert rig.owner.reset() == WELL


def test_a_stop_before_anybody_commanded_enables_nothing_and_lets_nobody(rig):
    rig.pass_by(10, is_pressed=True)
    assert rig.sent == [None] * 10
    rig.pass_by(10, commanded=True)
    assert rig.level == Level.OFF
    assert rig.sent == [None] * 20


def test_motors_that_stopped_by_themselves_give_no_torque_again_unasked(rig):
    rig.pass_by(20, commanded=True)
    rig.lets_go = True
    sent = rig.pass_by(commanded=True)
    assert (rig.level, rig.owner.state.code) == (Level.OFF, "motors_let_go")
    assert is_without_torque(sent)


@pytest.mark.parametrize("kept", range(1, 8))
def test_a_spare_has_time_for_a_claim_that_was_let_go_late(rig, kept):
    """A process that is killed keeps its claim for a while: a spare has its time from then on."""
    rig.pass_by(20, commanded=True)
    rig.is_claimed = True
    rig.pass_by(kept)
    rig.is_claimed = False
    rig.pass_by(1)
    assert rig.level == Level.HOLD
    rig.is_claimed = True  # the spare
    rig.pass_by(1)
    assert rig.level == Level.HOLD
    rig.pass_by(20, commanded=True)
    assert rig.owner.state == WELL


def test_a_claim_that_stays_free_is_not_waited_for_beyond_20_ms(rig):
    rig.pass_by(20, commanded=True)
    for _ in range(5):  # somebody tries again and again, and never commands
        rig.is_claimed = not rig.is_claimed
        rig.pass_by(2)
    rig.pass_by(1)
    assert rig.level == Level.SIT


class Balances:
    """Lowers by saying a posture of its own; a test says how that goes."""

    def __init__(self) -> None:
        self.is_up, self.is_low = True, False
        self.calls = 0

    def command(self, sample: BodySample) -> MotorCommand:
        self.calls += 1
        zero = np.zeros(len(sample.motors.q))
        return MotorCommand(sample.motors.stamp_s, zero + 0.123, zero, zero, zero + 1.0, zero + 1.0)


@pytest.fixture
def stepping(body, squat) -> tuple[Rig, Balances]:
    """A robot on one foot, whose owner can lower it from there; nobody commands any more."""
    rig, balances = Rig(body, squat), Balances()
    rig.owner = BusOwner(body, squat, lambda: balances)
    rig.pass_by(5, commanded=True)
    rig.bears = [1.0, 0.0]
    return rig, balances


def test_from_a_step_it_is_lowered_with_balance_and_begins_only_then(stepping):
    rig, balances = stepping
    rig.pass_by(3)
    assert (rig.level, balances.calls) == (Level.HOLD, 0)
    command = rig.pass_by(200)
    assert (rig.owner.state.code, balances.calls) == ("controller_lost_in_a_step", 200)
    assert command is not None
    assert (command.q_des == 0.123).all()


def test_low_and_on_both_feet_the_rest_of_the_way_is_played_and_else_it_lets_go_there(stepping):
    rig, balances = stepping
    rig.pass_by(100)
    balances.is_low = True
    rig.pass_by(100)  # still on one foot
    assert rig.level == Level.SIT
    rig.pass_by(200)
    assert rig.owner.state.code == "seated"
    assert rig.level == Level.DAMP


def test_who_does_not_stay_up_is_damped_within_100_ms(stepping):
    rig, balances = stepping
    rig.pass_by(100)
    balances.is_up = False
    rig.pass_by(round(0.1 / PERIOD_S) + 2)
    assert rig.owner.state.code == "tipping"
    assert rig.level == Level.DAMP


def test_what_lies_is_damped_also_where_it_could_be_balanced(stepping):
    rig, balances = stepping
    rig.pass_by(2, commanded=True)
    rig.bears = [0.0, 0.0]
    rig.pass_by(60, commanded=True)
    rig.pass_by(5)
    assert rig.owner.state.code == "controller_lost_astray"
    assert not balances.calls


def test_a_copy_that_breaks_as_the_controller_did_damps_and_raises_nothing(
    body, monkeypatch, squat
):
    rig = Rig(body, squat)
    rig.owner = BusOwner(body, squat, lambda: OwnController(body.description))
    rig.pass_by(5, commanded=True)
    rig.bears = [1.0, 0.0]

    def breaks(*_):
        raise ValueError("as before")

    monkeypatch.setattr("robot.control.loop.ControlLoop.tick", breaks)
    command = rig.pass_by(5)
    assert rig.owner.state.code == "controller_lost_in_a_step"
    assert command is not None
    assert not command.kp.any()
    assert command.kd.any()
    rig.pass_by(60)
    assert rig.owner.state.code == "tipping"


def test_after_a_reset_it_can_be_lowered_from_a_step_again(stepping):
    rig, balances = stepping
    rig.pass_by(100)
    balances.is_low = True
    rig.pass_by(2000)
    assert rig.level == Level.OFF
    balances.is_low, before = False, balances.calls
    assert not isinstance(rig.owner.reset(), Refused)
    rig.bears = [1.0, 0.0]
    rig.pass_by(5, commanded=True)
    rig.pass_by(50)
    assert rig.owner.state.code == "controller_lost_in_a_step"
    assert balances.calls > before
