"""Getting up: the motions keep the joints' limits, and what is missed is tried another way."""

import numpy as np
import pytest

from robot.control.getting_up import GettingUp, on_its_feet
from robot.control.posture import towards
from robot.se3 import SE3

DT_S = 0.005
SIDES = {
    "on its front": (0.0, np.pi / 2),
    "on its back": (0.0, -np.pi / 2),
    "on its left side": (-np.pi / 2, 0.0),
    "on its right side": (np.pi / 2, 0.0),
}


def lay(dynamics, roll_rad, pitch_rad):
    """Turn the body, and say where up is in its axes."""
    X_NB = SE3.from_rpy(roll_rad, pitch_rad, 0.3, (0.0, 0.0, 0.1))
    dynamics.body.write_base(dynamics.data, X_NB)
    dynamics.kinematics()
    return X_NB.rotation()[2]


def begun(dynamics, q, side):
    """Lying on a side, still, with a motion under way."""
    lay(dynamics, *SIDES[side])
    rising = GettingUp(dynamics.body)
    while rising.resting:
        rising.update(DT_S, dynamics, q, np.zeros(len(q)))
    return rising


@pytest.fixture
def q(juno):
    return np.array(juno.posture("nominal"))


@pytest.mark.parametrize("side", SIDES)
def test_it_is_said_how_it_lies(dynamics, side):
    assert towards(lay(dynamics, *SIDES[side])) == side


@pytest.mark.parametrize("side", SIDES)
def test_every_motion_stays_inside_the_joints_ranges_and_speeds(dynamics, body, q, side):
    rising = begun(dynamics, q, side)
    before, seen = rising.q, set()
    for _ in range(4000):
        rising.update(DT_S, dynamics, q, np.zeros(len(q)))
        seen.add(rising.stage)
        assert (rising.q >= body.lower_rad - 1e-9).all()
        assert (rising.q <= body.upper_rad + 1e-9).all()
        assert (np.abs(rising.qd) < body.velocity_limit_rad_s).all()
        if len(seen) > 3:
            break
        assert (np.abs(rising.q - before) < 1.2 * DT_S * body.velocity_limit_rad_s).all()
        before = rising.q
    assert len(seen) > 3


def test_on_its_front_it_pushes_itself_up_and_on_a_side_it_rolls(dynamics, body, juno, q):
    motions = juno.getting_up.motions
    for side, keyframes in (
        ("on its front", motions.front),
        ("on its left side", motions.left),
        ("on its right side", motions.right),
    ):
        rising = begun(dynamics, q, side)
        assert rising.stage == keyframes[0].name


def test_a_body_that_does_not_follow_is_tried_so_often_and_then_given_up(dynamics, body, juno, q):
    rising = begun(dynamics, q, "on its front")
    needed = next(i for i, k in enumerate(juno.getting_up.motions.front) if k.needs == "upright")
    beyond = juno.getting_up.motions.front[needed].name
    times, stage = 0, ""
    while rising.outcome == "running":
        if rising.stage != stage and rising.stage == juno.getting_up.motions.front[0].name:
            times += 1
        stage = rising.stage
        assert stage != beyond  # it still lies: what follows would throw it over
        rising.update(DT_S, dynamics, q, np.zeros(len(q)))
    assert rising.outcome == "failed"
    assert times == juno.getting_up.tries


def test_who_still_falls_is_not_moved(dynamics, body, q):
    lay(dynamics, *SIDES["on its back"])
    rising = GettingUp(body)
    for _ in range(300):
        rising.update(DT_S, dynamics, q, np.full(len(q), 2.0))
        assert rising.resting


def test_a_motion_that_is_broken_off_is_chosen_anew(dynamics, body, juno, q):
    rising = begun(dynamics, q, "on its front")
    rising.update(DT_S, dynamics, q, np.zeros(len(q)))
    lay(dynamics, *SIDES["on its right side"])
    rising.miss()
    assert rising.resting
    while rising.resting:
        rising.update(DT_S, dynamics, q, np.zeros(len(q)))
    assert rising.stage == juno.getting_up.motions.right[0].name


def test_feet_carry_only_a_body_upright_above_them(dynamics, body, juno):
    assert on_its_feet(dynamics, body)
    for X_NB in (
        SE3.from_rpy(0.0, 0.6, 0.0, (0.0, 0.0, 0.5)),
        SE3.from_rpy(0.3, 0.0, 0.0, (0.0, 0.0, 0.5)),
    ):
        body.write_base(dynamics.data, X_NB)
        dynamics.kinematics()
        assert not on_its_feet(dynamics, body)
    body.write_base(dynamics.data, SE3((0.0, 0.0, 0.5)))
    lifted = np.array(juno.posture("nominal"))
    knee = juno.motor_names.index("left_knee")
    lifted[knee] += 0.5
    body.write_joints(dynamics.data, lifted)
    dynamics.kinematics()
    assert not on_its_feet(dynamics, body)
