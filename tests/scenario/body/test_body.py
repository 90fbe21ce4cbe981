"""The body in physics, its state estimated: a few simulated seconds each, judged by the truth."""

import math

import numpy as np
import pytest

from benchmarks.rig import Rig, planar_error
from robot.control.loop import BUS_PERIOD_S
from robot.messages import (
    Damp,
    Grip,
    Look,
    MoveHand,
    OneLeg,
    Stand,
    Walk,
    WalkTo,
)
from robot.reality.contract import IDEAL
from robot.se3 import SE3


@pytest.fixture
def rig():
    made = Rig(seed=1)
    assert made.run(0.5)
    return made


def legs(rig):
    return rig.loop.state().activities["legs"]


def test_it_stands_still(rig):
    X_WB = rig.X_WB
    assert rig.run(2.0)
    assert rig.upright
    assert rig.loop.mode == "stand"
    assert math.dist(rig.X_WB.p, X_WB.p) < 0.008
    state = rig.loop.state()
    assert state.left_contact
    assert state.right_contact
    assert (state.refused, state.failure) == (0, None)
    assert rig.drift_m() < 0.003


def test_it_walks_as_fast_as_it_is_told_then_stands():
    rig = Rig(seed=1, reality=IDEAL)
    assert rig.run(0.5)
    X_WS, gait = rig.X_WS, rig.robot.walking
    rig.send(Walk, forward_m_s=0.35, hold_s=5.0)
    assert rig.run(2.2)
    assert rig.loop.mode == "walk"
    before, steps_s = rig.X_WS, 4 * (gait.single_support_s + gait.double_support_s)
    assert rig.run(steps_s)
    assert (before.inverse() @ rig.X_WS).p[0] / steps_s == pytest.approx(0.35, rel=0.03)
    assert rig.wait("legs", 5.0) == "done"
    assert rig.upright
    assert rig.loop.mode == "stand"
    X_SS = X_WS.inverse() @ rig.X_WS
    assert 1.5 < X_SS.p[0] < 0.35 * 5.0 + 0.2  # braking takes 0.18 m
    assert abs(X_SS.p[1]) < 0.05
    assert rig.drift_m() < 0.03


@pytest.mark.parametrize(
    ("twist", "along"),
    [
        ({"forward_m_s": 0.35}, lambda X_SS: X_SS.p[0] / 0.35),
        ({"turn_rad_s": 0.6}, lambda X_SS: X_SS.yaw_rad / 0.6),
        ({"turn_rad_s": -0.6}, lambda X_SS: -X_SS.yaw_rad / 0.6),
    ],
)
def test_its_first_step_goes_where_it_is_told(rig, twist, along):
    X_WS, gait = rig.X_WS, rig.robot.walking
    rig.send(Walk, **twist, hold_s=5.0)
    while rig.loop.legs.gait.steps_taken < 1:
        assert rig.run(0.02)
    step_s = gait.single_support_s + gait.double_support_s
    assert along(X_WS.inverse() @ rig.X_WS) > 0.4 * step_s
    assert rig.run(4 * step_s)
    assert rig.upright


@pytest.mark.parametrize("goal", [(0.4, 0.25, 0.8), (1.3, -0.9, -2.2)])
def test_it_stops_at_a_goal(rig, goal):
    x, y, yaw = goal
    goal = SE3.from_xy_yaw(x, y, yaw)
    rig.send(WalkTo, x_m=x, y_m=y, yaw_rad=yaw)
    assert rig.wait("legs", 20.0) == "done"
    assert rig.run(0.5)
    for distance_m, turn_rad in (
        planar_error(goal, rig.X_NS),
        planar_error(rig.X_WN @ goal, rig.X_WS),
    ):
        assert distance_m < 0.03
        assert turn_rad < math.radians(3.0)


@pytest.mark.parametrize("direction_deg", [0, 110, pytest.param(250, marks=pytest.mark.rest)])
def test_it_survives_a_push_of_10_newton_seconds(rig, direction_deg):
    rig.plant.push(10.0, math.radians(direction_deg))
    assert rig.run(4.0)
    assert rig.upright
    assert rig.loop.mode == "stand"


def test_it_survives_a_push_while_walking(rig):
    rig.send(Walk, forward_m_s=0.3, hold_s=20.0)
    assert rig.run(2.6)
    rig.plant.push(6.0, math.radians(180.0))
    assert rig.run(3.0)
    assert rig.upright


def test_it_squats_and_rises(rig):
    nominal = rig.robot.walking.base_height_m
    rig.send(Stand, height_m=0.45)
    assert rig.wait("legs", 6.0) == "done"
    assert rig.X_WB.p[2] == pytest.approx(0.45, abs=0.02)
    rig.send(Stand)
    assert rig.wait("legs", 6.0) == "done"
    assert rig.X_WB.p[2] == pytest.approx(nominal, abs=0.02)


@pytest.mark.parametrize("side", ["left", "right"])
def test_it_stands_on_one_leg(rig, side):
    lifted = rig.robot.feet["right" if side == "left" else "left"].sole_site
    rig.send(OneLeg, side=side, duration_s=2.0)
    assert rig.run(2.5)
    assert rig.site(lifted).p[2] > 0.03
    assert rig.wait("legs", 6.0) == "done"
    assert rig.run(0.5)
    assert rig.upright


def test_a_hand_moves_on_a_line_and_grips_air(rig):
    X_NG = rig.loop.state().hands["left"].X_NG
    goal = SE3((X_NG.p[0] + 0.05, X_NG.p[1], X_NG.p[2] + 0.05), X_NG.quat_wxyz)
    rig.send(MoveHand, side="left", X_NG=goal)
    rig.send(Grip, side="right", opening_m=0.0)
    rig.send(Look, p_N=(1.0, 0.5, 0.3))
    assert rig.wait("left_arm", 5.0) == "done"
    assert rig.wait("right_hand", 3.0) == "done"
    assert rig.wait("head", 3.0) == "done"
    true = rig.X_WN @ rig.loop.state().hands["left"].X_NG
    assert math.dist(true.p, (rig.X_WN @ goal).p) < 0.008
    assert rig.loop.state().hands["right"].opening_m < 0.005


def test_the_motors_damp_when_the_controller_stops(rig):
    """The plant goes on alone: its firmware lets the robot down, softly, by itself."""
    plant = rig.plant
    plant.step(15)  # the last command is 2 ms old
    assert not plant.read().motors.watchdog
    plant.step(5)
    state = plant.read().motors
    assert state.watchdog
    fastest = 0.0
    for _ in range(200):
        plant.step(10)
        fastest = max(fastest, float(np.abs(plant.read().motors.qd).max()))
    assert rig.X_WB.p[2] < 0.4
    assert fastest < 30.0
    assert float(np.abs(plant.read().motors.qd).max()) < 1.0  # it lies, and rests


def test_damp_ends_everything_and_only_stand_begins_again(rig):
    rig.send(Damp)
    assert not rig.run(BUS_PERIOD_S)
    assert rig.loop.mode == "damping"
    refused = rig.send(Walk, forward_m_s=0.3)
    assert legs(rig).id == refused
    assert legs(rig).status == "failed"
    rig.send(Stand)
    assert rig.run(1.0)
    assert rig.loop.mode == "stand"
    assert rig.upright


def test_a_fall_is_noticed_and_the_motors_let_go(rig):
    rig.plant.push(60.0, 0.0)
    assert not rig.run(3.0)
    assert rig.loop.mode in ("fallen", "damping")
    state = rig.loop.state()
    assert state.failure is not None
    assert state.failure.code in ("fallen", "lost_balance")
    command = rig.loop.tick(rig.plant.read())
    assert not command.kp.any()
    assert not command.tau_ff.any()


def test_the_same_seed_gives_the_same_bits():
    def walk(seed):
        rig = Rig(seed=seed)
        rig.run(0.2)
        rig.send(Walk, forward_m_s=0.2, left_m_s=0.05, turn_rad_s=0.2)
        rig.run(1.0)
        return rig.plant.data.qpos.tobytes() + rig.plant.data.qvel.tobytes(), rig.loop.state()

    (first, believed), (second, also), (other, _) = walk(5), walk(5), walk(6)
    assert first == second
    assert believed == also
    assert first != other
