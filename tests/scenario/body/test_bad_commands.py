"""Commands that cannot be meant: refused at once, said so, and the robot goes on balancing."""

import math

import pytest

from benchmarks.rig import Rig
from robot.messages import Grip, Look, MoveArm, MoveHand, OneLeg, Payload, Stand, Walk, WalkTo
from robot.se3 import SE3

NAN = math.nan
BAD = [
    ("legs", Stand, {"height_m": NAN}),
    ("legs", OneLeg, {"side": "left", "duration_s": NAN}),
    ("legs", Walk, {"forward_m_s": NAN}),
    ("legs", WalkTo, {"x_m": NAN, "y_m": 0.0, "yaw_rad": 0.0}),
    ("left_arm", MoveArm, {"side": "left", "times_s": (1.0,), "positions_rad": ((NAN,) * 7,)}),
    ("left_arm", MoveArm, {"side": "left", "times_s": (NAN,), "positions_rad": ((0.0,) * 7,)}),
    ("left_arm", MoveHand, {"side": "left", "X_NG": SE3((NAN, 0.0, 0.0))}),
    ("left_hand", Grip, {"side": "left", "opening_m": NAN}),
    ("head", Look, {"p_N": (math.inf, 0.0, 0.0)}),
]


@pytest.fixture(scope="module")
def rig():
    """One robot for all: none of this may change anything."""
    made = Rig(seed=3)
    assert made.run(0.5)
    return made


@pytest.mark.parametrize(("channel", "kind", "fields"), BAD)
def test_a_number_that_is_not_finite_is_refused(rig, channel, kind, fields):
    number = rig.send(kind, **fields)
    assert rig.run(0.1)
    activity = rig.loop.state().activities[channel]
    assert (activity.id, activity.status) == (number, "failed")
    assert activity.detail
    assert rig.loop.limits.refused == 0  # no motor command was spoilt by it
    assert rig.loop.mode == "stand"


@pytest.mark.parametrize("mass_kg", [NAN, math.inf, 1e6])
def test_a_payload_that_no_hand_can_carry_changes_nothing(rig, mass_kg):
    before = rig.loop.body.mass_kg
    rig.send(Payload, side="left", mass_kg=mass_kg)
    assert rig.run(0.2)
    assert rig.loop.body.mass_kg < before + 10.0
    assert rig.upright
