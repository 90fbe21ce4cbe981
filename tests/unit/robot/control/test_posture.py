"""Whether it stands, falls or lies."""

import math

import numpy as np
import pytest
from msgspec.structs import replace

from robot.control.posture import Posture, steady
from robot.fusion.base_state import BaseStateEstimator
from robot.kinematics.dynamics import Dynamics
from robot.model.body import BodyModel
from robot.se3 import SE3


@pytest.fixture
def posture(body, dynamics):
    """The posture of a trunk that is turned so, at a height."""

    def make(roll_rad, pitch_rad, height_m):
        X_NB = SE3.from_rpy(roll_rad, pitch_rad, 0.4, (0.0, 0.0, height_m))
        body.write_base(dynamics.data, X_NB)
        dynamics.kinematics()
        return Posture(BaseStateEstimator(body, X_NB), dynamics)

    return make


def test_on_its_feet_it_neither_falls_nor_lies(posture, juno):
    made = posture(0.1, -0.1, juno.walking.base_height_m)
    assert made.upright
    assert not made.lies
    assert made.falling(rising=False) == ""


@pytest.mark.parametrize("tilt_rad", np.linspace(0.0, math.pi, 9))
def test_its_tilt_is_that_of_the_trunk_whatever_its_heading(posture, tilt_rad):
    assert posture(tilt_rad, 0.0, 0.5).tilt_rad == pytest.approx(tilt_rad, abs=1e-6)


def test_who_leans_far_falls_to_that_side_and_it_is_said(posture, juno):
    made = posture(juno.balance.falling.tilt_rad + 0.1, 0.0, juno.walking.base_height_m)
    assert "on its right side" in made.falling(rising=True)
    reason = made.fallen("why")
    assert (reason.code, reason.cause) == ("fallen", "why")
    assert reason.evidence["side"] == "on its right side"
    assert made.lies


def test_how_far_it_may_lean_is_the_bodys(juno):
    falling = replace(juno.balance.falling, tilt_rad=0.3)
    body = BodyModel(replace(juno, balance=replace(juno.balance, falling=falling)))
    dynamics = Dynamics(body)
    for tilt_rad, falls in ((0.2, False), (0.4, True)):
        X_NB = SE3.from_rpy(tilt_rad, 0.0, 0.0, (0.0, 0.0, juno.walking.base_height_m))
        made = Posture(BaseStateEstimator(body, X_NB), dynamics)
        assert bool(made.falling(rising=True)) is falls


def test_only_who_rises_may_be_low(posture):
    assert posture(0.0, 0.0, 0.1).falling(rising=False)
    assert posture(0.0, 0.0, 0.1).falling(rising=True) == ""
    assert not posture(0.0, 0.0, 0.1).upright


def test_a_trunk_that_turns_fast_is_not_steady():
    assert steady(np.array((0.1, -0.2, 0.3)))
    assert not steady(np.array((0.1, -1.2, 0.3)))
