"""Inverse kinematics meets reachable targets, inside the limits, and agrees with MuJoCo."""

import mujoco
import numpy as np
import pytest

from robot.planning.robot_body import Body


@pytest.mark.parametrize("side", ["left", "right"])
def test_forward_agrees_with_mujoco(body: Body, side) -> None:
    arm, rng = body.arms[side], np.random.default_rng(0)
    model, data = body.model, body.model.data()
    for q_arm in rng.uniform(arm.lower, arm.upper, (5, 7)):
        q = body.nominal.copy()
        q[arm.motors] = q_arm
        model.write_joints(data, q)
        mujoco.mj_kinematics(model.model, data)
        site = model.site_pose(data, model.grasp_site[side])
        root = data.body(arm.chain.body)
        rotation, position = arm.chain.forward(q_arm[None])
        R_WT = root.xmat.reshape(3, 3)
        assert np.allclose(R_WT @ position[0] + root.xpos, site.p, atol=1e-9)
        assert np.allclose(R_WT @ rotation[0], site.rotation(), atol=1e-9)


def test_reachable_targets_are_met_inside_the_limits(body: Body) -> None:
    arm, rng = body.arms["right"], np.random.default_rng(1)
    wanted = rng.uniform(arm.lower + 0.2, arm.upper - 0.2, (200, 7))
    rotations, positions = arm.chain.forward(wanted)
    start = np.clip(wanted + rng.normal(0.0, 0.4, wanted.shape), arm.lower, arm.upper)
    solved = arm.chain.solve(rotations, positions, start)
    assert solved.ok().mean() > 0.97
    assert (solved.q >= arm.lower).all()
    assert (solved.q <= arm.upper).all()
    found = arm.chain.forward(solved.q)[1]
    error = np.linalg.norm(found - positions, axis=1)
    assert np.allclose(error, solved.position_error_m, atol=1e-9)


def test_what_is_out_of_reach_is_said_by_how_much(body: Body) -> None:
    arm = body.arms["right"]
    q = np.zeros((1, 7))
    rotation, position = arm.chain.forward(q)
    far = position + np.array([[0.0, 0.0, -0.30]])
    solved = arm.chain.solve(rotation, far, q - 0.3, iterations=60)
    assert not solved.ok()[0]
    assert 0.25 < solved.position_error_m[0] < 0.40


def test_relaxing_keeps_the_hand_and_widens_the_margin(body: Body) -> None:
    arm, rng = body.arms["left"], np.random.default_rng(2)
    q = rng.uniform(arm.lower + 0.05, arm.upper - 0.05, (50, 7))
    relaxed = arm.chain.relax(q)
    assert np.allclose(arm.chain.forward(relaxed)[1], arm.chain.forward(q)[1], atol=2e-3)
    assert arm.chain.margin(relaxed).mean() > arm.chain.margin(q).mean() + 0.015


@pytest.mark.parametrize("side", ["left", "right"])
def test_swinging_keeps_the_hand_and_raises_the_elbow_inside_the_limits(body: Body, side) -> None:
    arm, rng = body.arms[side], np.random.default_rng(3)
    carry = np.array(body.description.posture("carry"))[arm.motors]
    q = np.clip(carry + rng.normal(0.0, 0.15, (20, 7)), arm.lower + 0.2, arm.upper - 0.2)
    up = np.tile([0.0, 0.4 if side == "left" else -0.4, 1.0], (len(q), 1))
    swung = arm.chain.swing(q, up, steps=6)
    assert np.allclose(arm.chain.forward(swung)[1], arm.chain.forward(q)[1], atol=1e-3)
    assert (swung >= arm.lower).all()
    assert (swung <= arm.upper).all()
    rise = [elbow_height(body, side, after) - elbow_height(body, side, before)
            for before, after in zip(q, swung, strict=True)]  # fmt: skip
    assert min(rise) > 0.0
    assert np.median(rise) > 0.03


def elbow_height(body: Body, side, q_arm) -> float:
    model, data = body.model, body.model.data()
    q = body.nominal.copy()
    q[body.arms[side].motors] = q_arm
    model.write_joints(data, q)
    mujoco.mj_kinematics(model.model, data)
    return float(data.body(model.model.joint(f"{side}_elbow").bodyid[0]).xpos[2])
