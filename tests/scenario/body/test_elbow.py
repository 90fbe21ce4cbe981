"""The elbow goes where it is wanted, and the hand stays on its line."""

import math

import numpy as np
import pytest

from benchmarks.rig import Rig
from robot.messages import MoveArm, MoveHand
from robot.planning.robot_body import Body

LOW = (-0.6, 1.3, -0.5, -1.5, 1.2, 0.2, -0.3)


@pytest.fixture
def rig() -> Rig:
    made = Rig(seed=1)
    assert made.run(0.5)
    made.send(MoveArm, side="left", times_s=(1.5,), positions_rad=(LOW,))
    assert made.wait("left_arm", 6.0) == "done"
    return made


def test_the_elbow_is_swung_up_while_the_hand_stays(rig: Rig) -> None:
    chain = Body(rig.robot).arms["left"].chain
    high = chain.swing(np.array([LOW]), np.array([[0.0, 0.4, 1.0]]), steps=3)[0]
    before, X_NG = rig.site("left_wrist_ft"), rig.loop.state().hands["left"].X_NG
    low_m = float(rig.plant.data.body("left_forearm").xpos[2])
    rig.send(MoveHand, side="left", X_NG=X_NG, near_rad=tuple(high.tolist()))
    assert rig.run(2.0)
    assert float(rig.plant.data.body("left_forearm").xpos[2]) > low_m + 0.015
    assert math.dist(rig.site("left_wrist_ft").p, before.p) < 0.01


def test_joints_of_another_arm_are_refused(rig: Rig) -> None:
    X_NG = rig.loop.state().hands["left"].X_NG
    rig.send(MoveHand, side="left", X_NG=X_NG, near_rad=(0.0, 1.0))
    assert rig.wait("left_arm", 2.0) == "failed"
