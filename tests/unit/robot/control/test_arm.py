"""An arm's reference: trajectories and straight lines, with ideal motors behind it."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from robot.control.arm import END_ZONE_RAD, Arm, Line
from robot.messages import HoldArm, MoveArm, MoveHand
from robot.se3 import SE3, rotation_vector

DT_S = 0.005


class Bench:
    """An arm whose motors are always where the reference is, on a base that may sway."""

    def __init__(self, body, dynamics, side="right"):
        self.body, self.dynamics, self.side = body, dynamics, side
        self.q = np.array(body.description.posture("carry"))
        self.arm = Arm(body, side, self.q)
        self.sway = lambda time_s: (0.0, 0.0)
        self.time_s = 0.0
        self.standing = True
        self._z = float(dynamics.data.qpos[2])
        self.refresh()

    def refresh(self):
        x, y = self.sway(self.time_s)
        self.body.write_base(self.dynamics.data, SE3((x, y, self._z)))
        self.body.write_joints(self.dynamics.data, self.q)
        self.dynamics.kinematics()

    @property
    def X_NG(self):
        return self.body.site_pose(self.dynamics.data, self.body.grasp_site[self.side])

    def run(self, duration_s, *, load_n=lambda time_s: 0.0, stuck=False):
        """Ticks until the activity ends or time is up; gives the rates that were asked for."""
        rates = []
        for _ in range(round(duration_s / DT_S)):
            arm, motors = self.arm, self.arm.motors
            arm.update(DT_S, self.dynamics, self.q[motors], load_n=load_n(self.time_s),
                       standing=self.standing)  # fmt: skip
            rates.append(np.abs(arm.qd).max())
            if not stuck:
                self.q[motors] = arm.q
            self.time_s += DT_S
            self.refresh()
            if arm.activity.status != "running":
                break
        return rates


@pytest.fixture
def bench(body, dynamics):
    return Bench(body, dynamics)


def line_to(bench, dx=0.0, dy=0.0, dz=0.0, **fields):
    X = bench.X_NG
    goal = SE3((X.p[0] + dx, X.p[1] + dy, X.p[2] + dz), X.quat_wxyz)
    bench.arm.reach(MoveHand(id=7, stamp_s=0.0, side=bench.side, X_NG=goal, **fields), X, 0.0)
    return goal


def off_line_m(point, start, goal):
    along = np.array(goal) - np.array(start)
    along = along / np.linalg.norm(along)
    gap = np.array(point) - np.array(start)
    return float(np.linalg.norm(gap - (gap @ along) * along))


# --- the line itself ----------------------------------------------------------------------------

offsets = st.tuples(*[st.floats(-0.3, 0.3)] * 3)
angles = st.floats(-1.0, 1.0)


def make_line(delta, roll, yaw, speed):
    start = SE3.from_rpy(0.3, -0.2, 1.0, (0.3, -0.2, 0.8))
    goal = SE3(tuple(np.add(start.p, delta).tolist()), start.quat_wxyz)
    goal = goal @ SE3.from_rpy(roll, 0.0, yaw, (0.0, 0.0, 0.0))
    return start, Line(
        MoveHand(id=1, stamp_s=0.0, side="left", X_NG=goal, speed_m_s=speed), start, 0.0
    )


@given(offsets, angles, angles, st.floats(0.05, 0.4))
def test_a_line_goes_from_start_to_goal_without_leaving_it(delta, roll, yaw, speed):
    start, line = make_line(delta, roll, yaw, speed)
    first, _ = line.at(0.0)
    last, rest = line.at(line.duration_s)
    np.testing.assert_allclose(first.matrix(), start.matrix(), atol=1e-9)
    assert last.p == pytest.approx(np.add(start.p, delta).tolist())
    assert not rest.any()
    if np.linalg.norm(delta) > 1e-3:
        for share in (0.2, 0.5, 0.8):
            X, _ = line.at(share * line.duration_s)
            assert off_line_m(X.p, start.p, last.p) < 1e-9


@given(offsets, angles, angles, st.floats(0.05, 0.4), st.floats(0.01, 0.99))
def test_a_lines_velocity_is_its_derivative_and_near_the_speed_asked_for(
    delta, roll, yaw, speed, share
):
    _, line = make_line(delta, roll, yaw, speed)
    t, h = share * line.duration_s, 1e-6
    before, after = line.at(t - h)[0].p, line.at(t + h)[0].p
    rate = np.subtract(after, before) / (2 * h)
    np.testing.assert_allclose(line.at(t)[1], rate, atol=1e-4)
    assert np.linalg.norm(rate) <= 1.26 * speed  # a minimum-jerk peak is 1.25 of 1.5 d / T


# --- the closed loop ----------------------------------------------------------------------------


@pytest.mark.parametrize("delta", [(0.08, 0.0, 0.0), (0.0, 0.06, 0.05), (-0.03, 0.0, 0.04)])
@pytest.mark.parametrize("side", ["left", "right"])
def test_the_hand_follows_a_line_to_its_end(body, dynamics, delta, side):
    bench = Bench(body, dynamics, side)
    start = bench.X_NG
    goal = line_to(bench, *delta)
    rates = bench.run(5.0)
    assert bench.arm.activity.status == "done"
    assert bench.arm.activity.id == 7
    assert math.dist(bench.X_NG.p, goal.p) < 0.006
    turn = rotation_vector(goal.rotation() @ bench.X_NG.rotation().T)
    assert np.linalg.norm(turn) < 0.04
    assert off_line_m(bench.X_NG.p, start.p, goal.p) < 0.006
    assert max(rates) <= body.description.arms.line_speed_rad_s + 1e-9


def test_the_hand_stays_in_the_world_while_the_body_sways(bench):
    goal = line_to(bench, dz=0.05)
    bench.run(3.0)
    bench.sway = lambda t: (0.01 * math.sin(2.0 * t), 0.01 * math.cos(2.0 * t) - 0.01)
    bench.run(DT_S)
    errors = []
    for _ in range(800):
        bench.run(DT_S)
        errors.append(math.dist(bench.X_NG.p, goal.p))
    assert max(errors[200:]) < 0.006  # the base moves by 20 mm


def test_a_point_out_of_reach_fails_and_says_by_how_much(bench):
    line_to(bench, dx=1.0, speed_m_s=0.5)
    bench.run(10.0)
    assert bench.arm.activity.status == "failed"
    assert "short" in bench.arm.activity.detail
    assert (bench.arm.q <= bench.arm.upper).all()
    assert (bench.arm.q >= bench.arm.lower).all()


def test_a_line_ends_at_contact_and_holds_there(bench):
    start = bench.X_NG
    line_to(bench, dz=-0.1, speed_m_s=0.05, stop_load_n=2.0)
    bench.run(10.0, load_n=lambda t: 0.0 if t < 1.0 else -3.0)
    assert bench.arm.activity.status == "done"
    assert bench.arm.activity.detail == "contact"
    assert bench.time_s == pytest.approx(1.0, abs=0.02)
    assert bench.X_NG.p[2] > start.p[2] - 0.09


def test_the_reference_does_not_run_away_from_a_stuck_arm(bench):
    line_to(bench, dz=0.2)
    bench.run(4.0, stuck=True)
    assert np.abs(bench.arm.q - bench.q[bench.arm.motors]).max() < 0.36
    assert bench.arm.activity.status == "failed"


@pytest.mark.parametrize("again_s", [9.0, 0.7])
def test_an_arm_that_something_holds_back_stops_pressing(bench, again_s):
    """Under a board's edge it pressed on for two seconds, slipped off, and the robot fell over.

    However often it is aimed anew meanwhile, as the body is pushed away.
    """
    arm, aimed_s = bench.arm, -math.inf
    while bench.time_s < 4.0 and arm.activity.status != "failed":
        if bench.time_s - aimed_s > again_s:
            line_to(bench, dz=0.2)
            aimed_s = bench.time_s
        bench.run(DT_S, stuck=True)
    assert "holds it back" in arm.activity.detail
    assert bench.time_s < 2.5
    for _ in range(200):
        arm.update(DT_S, bench.dynamics, bench.q[arm.motors], load_n=0.0, standing=True)
    ahead_rad = float(np.abs(arm.q - bench.q[arm.motors]).max())
    assert ahead_rad < 1.2 * arm.limits.joints_done_rad, "it still presses"


# --- trajectories -------------------------------------------------------------------------------


def follow(arm, times, positions):
    arm.follow(MoveArm(id=9, stamp_s=0.0, side=arm.side, times_s=tuple(times),
                       positions_rad=tuple(map(tuple, positions))))  # fmt: skip


def test_a_trajectory_ends_at_rest_at_its_last_point_through_the_others(bench):
    arm = bench.arm
    start = arm.q.copy()
    middle, end = start + 0.2, start + 0.1
    middle, end = (np.clip(q, arm.lower, arm.upper) for q in (middle, end))
    follow(arm, [0.5, 1.0], [middle, end])
    bench.run(0.5)
    np.testing.assert_allclose(arm.q, middle, atol=1e-3)
    bench.run(1.0)
    assert arm.activity.status == "done"
    np.testing.assert_allclose(arm.q, end, atol=1e-9)
    assert not arm.qd.any()
    assert not arm.qdd.any()


def test_a_trajectorys_rates_are_its_derivatives(bench):
    arm = bench.arm
    follow(arm, [1.0], [np.clip(arm.q + 0.3, arm.lower, arm.upper)])
    before, rate_before = arm.q.copy(), arm.qd.copy()
    for _ in range(150):
        bench.run(DT_S)
        middle = 0.5 * (rate_before + arm.qd)
        np.testing.assert_allclose((arm.q - before) / DT_S, middle, atol=1e-3)
        before, rate_before = arm.q.copy(), arm.qd.copy()


def test_an_arm_that_does_not_arrive_fails(bench):
    arm = bench.arm
    follow(arm, [0.5], [np.clip(arm.q + 0.5, arm.lower, arm.upper)])
    bench.run(5.0, stuck=True)
    assert arm.activity.status == "failed"
    assert "short" in arm.activity.detail


@pytest.mark.parametrize(
    ("times", "shift", "words"),
    [
        ((0.5, 0.4), (0.0, 0.0), "grow"),
        ((-0.5, 0.4), (0.0, 0.0), "grow"),
        ((0.5,), (9.0,), "limits"),
        ((0.5,), (math.nan,), "limits"),
        ((), (), ""),
        ((0.0,), (0.0,), ""),
        ((0.5, 1.0), (0.0,), "as many"),
    ],
)
def test_a_trajectory_that_cannot_be_meant_is_refused_and_nothing_moves(bench, times, shift, words):
    arm = bench.arm
    before = arm.q.copy()
    follow(arm, times, [before + value for value in shift])
    assert arm.activity.status == "failed"
    assert arm.activity.id == 9
    assert words in arm.activity.detail
    bench.run(0.1)
    np.testing.assert_array_equal(arm.q, before)


def test_a_trajectory_of_too_few_joints_is_refused(bench):
    follow(bench.arm, [1.0], [[0.0, 0.0]])
    assert bench.arm.activity.status == "failed"
    assert "7 columns" in bench.arm.activity.detail


def test_times_that_are_not_finite_are_refused(bench):
    before = bench.arm.q.copy()
    for times in ([math.nan], [math.inf]):
        follow(bench.arm, times, [before])
        assert bench.arm.activity.status == "failed", times


# --- braking ------------------------------------------------------------------------------------


def hold(bench):
    measured = bench.q[bench.arm.motors]
    bench.arm.hold(HoldArm(id=2, stamp_s=0.0, side=bench.side), measured)


def test_an_arm_that_is_held_back_does_not_go_on_pressing(bench):
    line_to(bench, dz=-0.2, speed_m_s=0.3)
    bench.run(2.0, stuck=True)
    measured = bench.q[bench.arm.motors]
    assert np.abs(bench.arm.q - measured).max() > 0.2
    hold(bench)
    bench.run(1.0, stuck=True)
    assert np.abs(bench.arm.q - measured).max() < 0.1


@pytest.mark.parametrize("before_s", [0.0, 0.1, 0.3, 0.5])
@pytest.mark.parametrize("kind", ["trajectory", "line"])
def test_an_arm_that_is_told_to_hold_comes_to_rest_without_a_jerk(bench, kind, before_s):
    if kind == "line":
        line_to(bench, dx=0.08, dz=0.1, speed_m_s=0.4)
    else:
        goal = bench.arm.q + np.array([0.5, -0.2, 0.3, 0.4, -0.3, 0.2, 0.1])
        goal = np.clip(goal, bench.arm.lower, bench.arm.upper)
        bench.arm.follow(MoveArm(id=1, stamp_s=0.0, side=bench.side, times_s=(0.6,),
                                 positions_rad=(tuple(goal),)))  # fmt: skip
    bench.run(before_s)
    q, qd, qdd = bench.arm.q, bench.arm.qd.copy(), bench.arm.qdd.copy()
    limits = bench.body.description.arms
    hold(bench)
    for _ in range(200):
        bench.run(DT_S)
        arm = bench.arm
        most = np.maximum(limits.brake_rad_s2, np.abs(qdd)) + 1e-9
        assert (np.abs(arm.q - q) <= (np.abs(qd) + most * DT_S) * DT_S + 1e-9).all()
        assert (np.abs(arm.qd - qd) <= most * DT_S).all()
        assert (np.abs(arm.qdd - qdd) <= limits.brake_rad_s3 * DT_S + 1e-9).all()
        q, qd, qdd = arm.q, arm.qd.copy(), arm.qdd.copy()
        if arm.activity.status == "done":
            break
    assert arm.activity.id == 2
    assert arm.activity.status == "done"
    assert not arm.qd.any()
    bench.run(0.2)
    assert (arm.q == q).all()


# --- where joints end ---------------------------------------------------------------------------

AT_ITS_ENDS = (0.656, 2.099, 0.507, -1.695, 1.964, -0.251, 0.641)
"""A left arm before a bottle that stands deep on a counter; moving in, two of its joints end."""


def moved_in(body, dynamics, posture_rad, ahead_m):
    """How far the hand leaves its line, and how far its axis turns [rad], while it moves ahead."""
    bench = Bench(body, dynamics, "left")
    bench.q[bench.arm.motors] = posture_rad
    bench.arm = Arm(body, "left", bench.q)
    bench.refresh()
    start = bench.X_NG
    goal = start @ SE3((ahead_m, 0.0, 0.0))
    bench.arm.reach(MoveHand(id=7, stamp_s=0.0, side="left", X_NG=goal, speed_m_s=0.1), start, 0.0)
    most_m = most_rad = 0.0
    while bench.arm.activity.status == "running":
        bench.run(DT_S)
        most_m = max(most_m, off_line_m(bench.X_NG.p, start.p, goal.p))
        turned = bench.X_NG.rotation() @ start.rotation().T
        most_rad = max(most_rad, float(np.linalg.norm(rotation_vector(turned))))
    return bench, most_m, most_rad


def test_a_joint_at_its_end_does_not_take_the_hand_off_its_line(body, dynamics):
    """It knocked the bottle over: the other joints moved on as if that one did."""
    bench, most_m, most_rad = moved_in(body, dynamics, AT_ITS_ENDS, 0.086)
    arm = bench.arm
    ended = np.minimum(arm.q - arm.lower, arm.upper - arm.q) < 0.02
    assert ended.any(), "else this shows nothing"
    assert most_m < 0.01, "it was 5 cm"
    assert most_rad < 0.02


def test_what_has_room_is_left_where_it_is(bench):
    """Away from their ends no joint is moved but for the hand."""
    arm = bench.arm
    assert (arm.q > arm.lower + END_ZONE_RAD).all() and (arm.q < arm.upper - END_ZONE_RAD).all()
    bench.dynamics.kinematics()
    jac = np.linalg.qr(np.random.default_rng(0).normal(size=(7, 6)))[0].T
    rate = arm._rate(jac, np.zeros(6), None, dt_s=DT_S)
    assert np.allclose(rate, 0.0)
