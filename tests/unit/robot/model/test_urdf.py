"""The URDF is the same robot: read back by MuJoCo, it has the same masses, limits and motions."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from robot.model.body import BodyModel
from robot.model.description import load
from robot.model.urdf import urdf


@pytest.fixture(scope="module")
def pair():
    description = load("juno")
    read = mujoco.MjModel.from_xml_string(urdf(description))
    return BodyModel(description).model, read


def test_masses_agree(pair):
    ours, read = pair
    # MuJoCo merges the base of a URDF into the world, so the moving links are compared.
    for body in range(2, ours.nbody):
        name = ours.body(body).name
        total = read.body_subtreemass[read.body(name).id]
        assert total == pytest.approx(ours.body_subtreemass[body], abs=1e-6)


def test_joints_and_limits_agree(pair):
    ours, read = pair
    names = [ours.joint(j).name for j in range(1, ours.njnt)]
    assert sorted(names) == sorted(read.joint(j).name for j in range(read.njnt))
    for name in names:
        assert np.allclose(ours.joint(name).range, read.joint(name).range, atol=1e-6)
        assert np.allclose(ours.joint(name).axis, read.joint(name).axis, atol=1e-6)


@pytest.mark.parametrize("seed", range(5))
def test_links_move_alike(pair, seed):
    ours, read = pair
    rng = np.random.default_rng(seed)
    here, there = mujoco.MjData(ours), mujoco.MjData(read)
    here.qpos[:7] = (0, 0, 0, 1, 0, 0, 0)
    for j in range(1, ours.njnt):
        joint = ours.joint(j)
        q = rng.uniform(*joint.range)
        here.qpos[joint.qposadr[0]] = q
        there.qpos[read.joint(joint.name).qposadr[0]] = q
    mujoco.mj_kinematics(ours, here)
    mujoco.mj_kinematics(read, there)
    for body in range(2, ours.nbody):
        name = ours.body(body).name
        assert np.allclose(here.body(name).xpos, there.body(name).xpos, atol=1e-5), name
        assert np.allclose(here.body(name).xmat, there.body(name).xmat, atol=1e-5), name
