"""What a description says must be within reach of its legs and arms."""

from msgspec.structs import replace

from robot.planning.fit import misfits
from tests.fakes.bodies import JUNO, handless


def test_what_is_shipped_fits():
    assert misfits(JUNO) == []


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
