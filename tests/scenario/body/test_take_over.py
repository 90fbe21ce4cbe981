"""A controller dies in the middle of something and another one takes the motors over."""

import math

import numpy as np
import pytest

from robot.bringup.fast import FastRuntime
from robot.messages import Grip, Stand, WalkTo
from robot.reality.faults import Kill
from robot.se3 import SE3
from sim.simulation import Simulation

KILL = Kill(process="controller")


def up_of(X_NB: SE3) -> float:
    """Cosine of the base's tilt."""
    return float(X_NB.rotation()[2, 2])


def walking(runtime: FastRuntime, x_m: float, y_m: float, duration_s: float) -> None:
    link = runtime.link
    runtime.advance(0.5)
    link.send(WalkTo(stamp_s=0.5, id=link.next_id(), x_m=x_m, y_m=y_m, yaw_rad=0.0))
    runtime.advance(duration_s)


@pytest.mark.parametrize(
    ("x_m", "y_m", "when_s"),
    [
        (2.0, 0.0, 2.3),
        pytest.param(2.0, 0.0, 2.6, marks=pytest.mark.rest),
        (0.0, 1.0, 2.4),
        pytest.param(-1.0, 0.0, 2.5, marks=pytest.mark.rest),
    ],
)
def test_in_mid_step_the_next_one_holds_the_robot_up(x_m, y_m, when_s):
    with FastRuntime(Simulation().world("empty"), seed=1) as runtime:
        walking(runtime, x_m, y_m, when_s)
        before = runtime.link.body()
        assert before.mode == "walk"
        runtime.inject(KILL)
        runtime.advance(3.0)
        after = runtime.link.body()
        assert (after.mode, after.failure) == ("stand", None)
        assert after.since_s == pytest.approx(before.stamp_s, abs=0.05)
        assert runtime.failure() is None
        walking(runtime, 1.0, 0.0, 2.0)
        assert runtime.link.body().mode == "walk"


@pytest.mark.parametrize(
    "when_s",
    [
        pytest.param(2.25, marks=pytest.mark.rest),
        2.35,
        pytest.param(2.45, marks=pytest.mark.rest),
    ],
)
def test_it_walks_on_upright_from_where_the_swinging_foot_came_down(when_s):
    """It once shifted its weight over the foot's place in the air: 6 cm beyond the sole.

    It leans by 13 degrees at most: on as much friction as a wet floor has, the trunk helps (10
    degrees with half as much again).
    """
    with FastRuntime(Simulation().world("empty"), seed=1) as runtime:
        link = runtime.link
        runtime.advance(0.5)
        aside = WalkTo(stamp_s=0.5, id=link.next_id(), x_m=-1.0, y_m=-1.0, yaw_rad=-1.2)
        link.send(aside)
        runtime.advance(when_s)
        runtime.inject(KILL)
        runtime.advance(1.0)
        on = WalkTo(stamp_s=link.now_s(), id=link.next_id(), x_m=1.5, y_m=0.0, yaw_rad=-1.2)
        link.send(on)
        for _ in range(20):
            runtime.advance(0.1)
            assert link.body().mode == "walk"
            assert up_of(link.body().X_NB) > math.cos(math.radians(15.0))


def test_one_that_comes_late_lets_the_motors_damp_until_it_is_told_to_stand(monkeypatch):
    monkeypatch.setattr("robot.bringup.lockstep.TAKE_OVER_MS", 120)
    with FastRuntime(Simulation().world("empty"), seed=1) as runtime:
        runtime.advance(1.0)
        runtime.inject(KILL)
        runtime.advance(0.14)
        body = runtime.link.body()
        assert body.mode == "damping"
        assert body.failure.code == "controller_lost"
        assert body.failure.evidence["silence_s"] == pytest.approx(0.12, abs=0.01)
        assert not runtime.plant.motors.stiff
        runtime.link.send(Stand(stamp_s=1.1, id=runtime.link.next_id()))
        runtime.advance(1.0)
        body = runtime.link.body()
        assert (body.mode, body.failure) == ("stand", None)


def test_a_robot_that_went_down_meanwhile_is_said_to_have_fallen(monkeypatch):
    monkeypatch.setattr("robot.bringup.lockstep.TAKE_OVER_MS", 3000)
    with FastRuntime(Simulation().world("empty"), seed=1) as runtime:
        walking(runtime, 2.0, 0.0, 2.3)
        runtime.inject(KILL)
        runtime.advance(4.0)
        assert runtime.link.body().mode == "fallen"
        assert runtime.link.body().failure.code == "fallen"
        assert not runtime.plant.motors.stiff


def test_a_hand_keeps_its_grip():
    with FastRuntime(Simulation().world("empty"), seed=1) as runtime:
        link, robot = runtime.link, runtime.plant.robot
        motor = robot.motor_names.index(robot.hands["right"].motor)
        runtime.advance(0.5)
        link.send(Grip(stamp_s=0.5, id=link.next_id(), side="right", opening_m=0.0, force_n=12.0))
        runtime.advance(3.0)
        before_n = np.array(link.body().tau_nm)[motor]
        runtime.inject(KILL)
        runtime.advance(1.0)
        assert np.array(link.body().tau_nm)[motor] == pytest.approx(before_n, abs=1.0)
