"""A controller that begins finds which way is up: standing, in mid-step, or lying."""

import math

import numpy as np
import pytest

from robot.control import starting
from robot.drivers.body_sample import BodySample, ForceReading, ImuReading
from robot.physics import GRAVITY_M_S2
from robot.se3 import SE3
from tests.fakes.motors import motor_state


@pytest.fixture
def sample(body, juno):
    """What is measured by a robot that stands still in its nominal posture."""
    wrench = np.zeros((2, 6))
    wrench[:, 2] = 0.5 * GRAVITY_M_S2 * body.mass_kg
    q = np.array(juno.posture("nominal"))
    return BodySample(
        motor_state(q, stamp_s=1.0, command_stamp_s=-math.inf),
        ImuReading(1.0, np.zeros(3), np.array((0.0, 0.0, GRAVITY_M_S2))),
        ForceReading(1.0, wrench, np.zeros((2, 6))),
    )


def up(roll_rad, pitch_rad):
    """The world's up in the axes of a base that is turned so, (3,)."""
    return SE3.from_rpy(roll_rad, pitch_rad, 0.0, (0.0, 0.0, 0.0)).rotation()[2]


def found_up(dynamics, sample, *, taking_over):
    return starting.find(dynamics, sample, taking_over=taking_over).X_NB.rotation()[2]


@pytest.mark.parametrize("taking_over", [False, True])
def test_on_its_feet_the_soles_stand_on_the_floor_and_the_stance_is_the_origin(
    dynamics, sample, juno, taking_over
):
    X_NB, left, right = starting.find(dynamics, sample, taking_over=taking_over)
    assert X_NB.p[2] == pytest.approx(juno.walking.base_height_m, abs=0.01)
    assert (left.x + right.x, left.y + right.y) == pytest.approx((0.0, 0.0), abs=1e-9)


def test_in_a_step_the_soles_say_what_is_up_whatever_the_step_feels(dynamics, sample):
    sample.imu.accel_m_s2 = GRAVITY_M_S2 * up(0.0, 0.32)
    assert found_up(dynamics, sample, taking_over=True) == pytest.approx(up(0.0, 0.0), abs=1e-6)


def test_at_rest_gravity_says_it(dynamics, sample):
    sample.imu.accel_m_s2 = GRAVITY_M_S2 * up(0.0, 0.32)
    assert found_up(dynamics, sample, taking_over=False) == pytest.approx(up(0.0, 0.32), abs=1e-6)


@pytest.mark.parametrize("roll_rad", [1.5, -1.5])
@pytest.mark.parametrize("felt", [1.0, 1.3])
def test_who_lies_does_not_stand_on_feet_that_are_pressed_by_the_floor(
    dynamics, sample, roll_rad, felt
):
    """Its controller died on the way up: limbs push, and shake it."""
    sample.imu.accel_m_s2 = felt * GRAVITY_M_S2 * up(roll_rad, 0.0)
    found = found_up(dynamics, sample, taking_over=True)
    assert found == pytest.approx(up(roll_rad, 0.0), abs=1e-6)


def test_before_anything_is_felt_it_stands(dynamics, sample):
    sample.imu.accel_m_s2 = np.array((1e-6, 0.0, 0.0))
    assert found_up(dynamics, sample, taking_over=False) == pytest.approx(up(0.0, 0.0), abs=1e-6)


@pytest.mark.parametrize(
    ("mode", "silence_s", "code"),
    [("stand", 0.01, None), ("stand", 0.2, "controller_lost"), ("damping", 0.01, "fallen"),
     ("damping", 0.2, "fallen")],
)  # fmt: skip
def test_what_stands_is_held_up_if_it_is_not_too_late(sample, mode, silence_s, code):
    state = sample.motors
    assert not starting.took_over(state)
    state.command_stamp_s = state.stamp_s - silence_s
    assert starting.took_over(state)
    reason = starting.left_by(state, mode)
    assert (reason.code if reason else None) == code
