"""A hand: its motor's target never asks for more than the force, and says when it is done."""

import numpy as np
import pytest

from robot.control.hand import HandControl
from robot.messages import Grip
from robot.se3 import SE3
from tests.fakes.motors import motor_state

DT_S = 0.005
UPRIGHT = np.eye(3)


class Bench:
    """One hand whose fingers follow their target until they meet `stop_m` (travel of the motor)."""

    def __init__(self, body):
        self.body = body
        self.hand = body.description.hands["right"]
        self.q = np.array(body.description.posture("nominal"))
        self.control = HandControl(body, "right", self.q)
        self.motor = self.control.motor
        self.stop_m = 0.0
        self.force_n = []
        self.load_n = 0.0
        self.offset_n = (0.0, 0.0, 0.0)
        self.rotation_NW = UPRIGHT

    def state(self, speed):
        qd = np.zeros(self.body.count)
        qd[self.motor] = speed
        return motor_state(self.q, qd=qd)

    def update(self, speed):
        wrench = np.zeros((2, 6))
        down_n = self.load_n + self.control._weight_n
        wrench[1, :3] = self.offset_n - down_n * self.rotation_NW[2]
        return self.control.update(
            DT_S, self.state(speed), wrist_wrench=wrench, rotation_NW=self.rotation_NW
        )

    def run(self, duration_s):
        speed = 0.0
        for _ in range(round(duration_s / DT_S)):
            target = self.update(speed)
            self.force_n.append(self.body.kp[self.motor] * abs(target - self.q[self.motor]))
            before = self.q[self.motor]
            self.q[self.motor] = max(self.stop_m, before + 0.5 * (target - before))
            speed = (self.q[self.motor] - before) / DT_S

    def grip(self, opening_m, force_n=15.0):
        self.control.grip(
            Grip(id=4, stamp_s=0.0, side="right", opening_m=opening_m, force_n=force_n)
        )


@pytest.fixture
def bench(body):
    return Bench(body)


@pytest.mark.parametrize("opening", [0.0, 0.03, 0.1])
def test_free_fingers_reach_their_opening(bench, opening):
    bench.grip(opening)
    bench.run(2.0)
    assert bench.control.activity.status == "done"
    assert bench.control.activity.detail == ""
    assert bench.q[bench.motor] * bench.hand.opening_per_motor == pytest.approx(opening, abs=0.004)


@pytest.mark.parametrize("force", [3.0, 8.0, 15.0])
def test_fingers_that_meet_something_stop_and_press_as_asked(bench, force):
    bench.stop_m = 0.02
    bench.grip(0.0, force)
    bench.run(2.0)
    assert bench.control.activity.status == "done"
    assert "something" in bench.control.activity.detail
    assert max(bench.force_n) <= force + 1e-9
    assert bench.force_n[-1] == pytest.approx(force, rel=0.01)


@pytest.mark.parametrize(("opening", "force"), [(9.0, 99.0), (-1.0, -5.0)])
def test_what_is_asked_is_kept_inside_the_hands_limits(bench, opening, force):
    bench.grip(opening, force)
    bench.run(2.0)
    gap = bench.control.target * bench.hand.opening_per_motor
    assert 0.0 <= gap <= bench.hand.max_opening_m
    assert max(bench.force_n) <= bench.hand.max_force_n + 1e-9


def test_fingers_do_not_slam(bench):
    bench.grip(0.1)
    before = bench.update(0.0)
    after = bench.update(0.0)
    assert abs(after - before) <= bench.control.gripping.closing_m_s * DT_S + 1e-12


def test_fingers_that_never_rest_fail(bench):
    bench.grip(0.0)
    for k in range(round((bench.control.gripping.give_up_s + 0.5) / DT_S)):
        bench.q[bench.motor] = 0.03 + 0.005 * (k % 2)
        bench.update(0.5)
    assert bench.control.activity.status == "failed"


def test_the_load_is_what_hangs_below_the_hands_own_weight(bench):
    holding(bench, 4.0)
    assert bench.control.load_n == pytest.approx(4.0, abs=0.05)
    assert bench.control.state(bench.state(0.0), SE3()).load_n == bench.control.load_n


def holding(bench, load_n: float = 2.0) -> float:
    """Grip something 40 mm wide; the force with which it is held."""
    bench.stop_m, bench.load_n = 0.02, load_n
    bench.grip(0.0)
    bench.run(2.0)
    return bench.force_n[-1]


def pulled(bench, load_n: float, duration_s: float) -> float:
    bench.load_n = load_n
    bench.run(duration_s)
    return bench.force_n[-1]


@pytest.mark.parametrize("load", [0.0, 4.0, 9.0])
def test_what_is_carried_is_gripped_as_it_was_asked(bench, load):
    assert holding(bench, load) == pytest.approx(15.0, rel=0.01)
    assert bench.control.pulls == 0


def test_what_is_pulled_at_is_gripped_harder_at_once_and_no_longer_than_needed(bench):
    bench.stop_m = 0.035
    holding(bench)
    assert pulled(bench, 15.0, 0.03) > 15.0 * 1.25
    assert pulled(bench, 4.0, 0.9) > 15.0 * 1.25
    assert pulled(bench, 4.0, 0.3) == pytest.approx(15.0, rel=0.01)
    assert bench.control.pulls == 1
    pulled(bench, 14.0, 0.1)
    assert bench.control.pulls == 2


@pytest.mark.parametrize("load", [-30.0, 25.0, 60.0, 500.0])
def test_no_pull_asks_for_more_than_the_motor_gives_nor_for_less_than_nothing(bench, load):
    holding(bench)
    force_n = pulled(bench, load, 0.5)
    assert (
        15.0
        < force_n
        <= bench.control.gripping.peak_share * bench.body.torque_limit_nm[bench.motor]
    )
    assert min(bench.q) >= min(bench.body.lower_rad)


def test_an_opening_hand_and_an_empty_one_are_not_tightened(bench):
    bench.grip(0.1)
    bench.load_n = 30.0
    bench.run(2.0)
    bench.grip(0.0)
    bench.run(3.0)
    assert bench.control.pulls == 0


def test_a_new_grip_ends_what_a_pull_asked_for(bench):
    holding(bench)
    pulled(bench, 20.0, 0.1)
    bench.grip(0.08)
    bench.run(2.0)
    assert bench.q[bench.motor] * bench.hand.opening_per_motor == pytest.approx(0.08, abs=0.004)


OFFSETS_N = [(7.0, -6.0, 0.0), (0.0, 9.6, -4.0), (-10.0, 0.0, 10.0)]
"""1 to 2 sigma of what wrists are off by in `real` (docs/realities.md)."""


@pytest.mark.parametrize("offset", OFFSETS_N)
@pytest.mark.parametrize("turn", [0.0, 1.2, -2.5])
def test_a_sensor_that_is_off_is_no_pull_however_the_hand_is_turned(bench, offset, turn):
    bench.offset_n = offset
    bench.run(1.0)
    assert bench.control.load_n == pytest.approx(0.0, abs=0.1)
    holding(bench, 2.5)
    bench.rotation_NW = SE3.from_rpy(turn, 0.3 * turn, turn, (0.0, 0.0, 0.0)).rotation()
    bench.run(1.0)
    assert bench.control.load_n == pytest.approx(2.5, abs=0.1)
    assert bench.control.pulls == 0
    assert pulled(bench, 15.0, 0.03) > 15.0 * 1.25
    assert bench.control.pulls == 1


def test_what_is_carried_for_long_is_not_taken_for_the_sensors_offset(bench):
    holding(bench, 8.0)
    bench.run(30.0)
    assert bench.control.load_n == pytest.approx(8.0, abs=0.05)


def test_what_the_open_hand_brushes_is_hardly_taken_for_the_sensors_offset(bench):
    bench.run(5.0)
    bench.load_n = -5.0
    bench.run(0.5)
    bench.load_n = 0.0
    bench.run(0.5)
    assert abs(bench.control.load_n) < 0.5
