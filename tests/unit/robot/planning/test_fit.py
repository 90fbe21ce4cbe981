"""What a description says must be within reach of its legs and arms."""

import pytest
from msgspec.structs import replace

from robot.model.description import load
from robot.planning.fit import misfits
from robot.planning.requests import BodyPosture
from robot.planning.robot_body import Body
from robot.se3 import rotation_vector
from tests.fakes.bodies import JUNO, handless, shipped_or_skip, stiff


def test_what_is_shipped_fits():
    assert misfits(JUNO) == []


@pytest.mark.parametrize("name", ["g1", "t1"])
def test_the_bodies_of_others_fit(name):
    assert misfits(load(shipped_or_skip(name))) == []


def test_a_waist_that_only_turns_leans_from_the_hips(tmp_path):
    body = Body(stiff(tmp_path))
    X_SB = body.standing(BodyPosture(pitch_rad=0.3, yaw_rad=0.4)).X_SB
    assert X_SB.yaw_rad == pytest.approx(0.0)
    assert rotation_vector(X_SB.rotation()) == pytest.approx((0.0, 0.3, 0.0))
    assert misfits(body.description) == []


def test_a_trunk_over_its_waist_turns_as_a_whole():
    body = Body(load(shipped_or_skip("t1")))
    standing = body.standing(BodyPosture(pitch_rad=0.2, yaw_rad=0.4))
    assert standing.X_SB.yaw_rad == pytest.approx(0.4)
    assert standing.q[body.motor("waist")] == pytest.approx(-0.4)


def test_a_body_without_hands_fits():
    assert misfits(handless()) == []


def test_a_squat_below_what_the_legs_allow_is_named():
    low = replace(JUNO, balance=replace(JUNO.balance, squat_base_m=0.25))
    assert misfits(low) == ["balance.squat_base_m: the soles miss the floor by 54 mm"]


def test_a_hand_out_of_reach_is_named():
    giving = replace(JUNO.handy.giving, held_out_m=((0.9, 0.1, 1.0),))
    (left, right) = misfits(replace(JUNO, handling=replace(JUNO.handy, giving=giving)))
    assert left.startswith("giving.held_out_m[0]: the left hand stays")
    assert "right" in right


def test_a_posture_in_which_it_touches_itself_is_named():
    hug = {"left_shoulder_roll": -0.25, "left_shoulder_yaw": -1.5, "left_elbow": -1.9}
    robot = replace(JUNO, postures={**JUNO.postures, "hug": hug})
    assert "posture 'hug': left_forearm and torso" in misfits(robot)
