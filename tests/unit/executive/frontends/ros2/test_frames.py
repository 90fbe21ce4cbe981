"""Links where the URDF has them, and stamps in one time."""

from __future__ import annotations

import math
import random

import mujoco
import numpy as np
import pytest

from executive.frontends.ros2.link_frames import BASE, LinkFrames
from executive.frontends.ros2.messages import frame_of, joint_names, positions
from executive.frontends.ros2.stamps import LATELY_S, Stamps, time_of
from robot.model import description
from robot.model.body import BodyModel
from robot.model.urdf import urdf
from robot.se3 import SE3


@pytest.fixture(scope="module")
def robot():
    return description.load("juno")


@pytest.fixture(scope="module")
def links(robot):
    return LinkFrames(urdf(robot))


def in_base(links, at):
    """X_BLink of every link, by following parents."""
    found = {BASE: SE3()}
    steps = [(one.parent, one.child, one.pose(at)) for one in links.moving] + list(links.still)
    while steps:
        known = [step for step in steps if step[0] in found]
        assert known, "a link hangs on nothing"
        for parent, child, X_PC in known:
            found[child] = found[parent] @ X_PC
        steps = [step for step in steps if step not in known]
    return found


def test_every_link_hangs_on_the_base_and_on_one_parent(links):
    children = [one.child for one in links.moving] + [child for _, child, _ in links.still]
    assert len(children) == len(set(children))
    assert BASE not in children
    in_base(links, {})


@pytest.mark.parametrize("seed", range(5))
def test_links_are_where_mujocos_kinematics_has_them(robot, links, seed):
    body = BodyModel(robot)
    model, data = body.model, mujoco.MjData(body.model)
    drawn = random.Random(seed)
    names = joint_names(robot)
    q = [
        drawn.uniform(*(float(one) for one in model.jnt_range[model.joint(name).id]))
        for name in names
    ]
    for name, value in zip(names, q, strict=True):
        data.qpos[model.joint(name).qposadr[0]] = value
    for joint in links.moving:  # fingers that follow
        at = joint.offset + joint.gain * q[names.index(joint.leader)]
        own = next(
            j for j in range(model.njnt) if model.body(model.jnt_bodyid[j]).name == joint.child
        )
        data.qpos[model.jnt_qposadr[own]] = at
    mujoco.mj_kinematics(model, data)
    pelvis = model.body(next(child for parent, child, _ in links.still if parent == BASE)).id
    R_WB, p_WB = data.xmat[pelvis].reshape(3, 3), data.xpos[pelvis]
    found = in_base(links, dict(zip(names, q, strict=True)))
    for site in range(model.nsite):
        X = found[frame_of(model.site(site).name)]
        p_B = R_WB.T @ (data.site_xpos[site] - p_WB)
        R_B = R_WB.T @ data.site_xmat[site].reshape(3, 3)
        assert np.allclose(X.p, p_B, atol=1e-6), model.site(site).name
        assert np.allclose(X.rotation(), R_B, atol=1e-6), model.site(site).name


def test_the_cameras_frame_is_optical_and_the_lidars_is_not(robot, links):
    """Pictures and scans are in these: z along the view there, x ahead and z up here."""
    found = in_base(links, {})
    camera = found[frame_of(robot.sensors.camera.site)].rotation()
    lidar = found[frame_of(robot.sensors.lidar.site)].rotation()
    assert camera[0, 2] > 0.5  # ahead
    assert camera[2, 1] < -0.5  # down
    assert np.allclose(lidar, np.eye(3), atol=1e-6)


def test_a_motor_that_the_body_lacks_moves_nothing(links):
    assert in_base(links, {"no_such_joint": 3.0}) == in_base(links, {})


def test_positions_are_by_the_names_of_the_urdf(robot):
    names = joint_names(robot)
    text = urdf(robot)
    assert all(f'name="{name}"' in text for name in names)

    class Body:
        q_rad = tuple(range(len(names)))

    assert positions(Body, names)[names[3]] == 3


# --- stamps ---


def test_a_stamp_is_the_walls_time_of_the_fastest_message_lately():
    stamps = Stamps()
    assert not stamps.known and stamps.wall_s(5.0) == 0.0
    stamps.saw(1.0, 1001.003)
    stamps.saw(1.02, 1001.021)
    stamps.saw(1.04, 1001.090)
    assert stamps.wall_s(1.04) == pytest.approx(1001.041)


def test_stamps_follow_a_simulation_that_is_slower_than_the_wall():
    stamps = Stamps()
    for tick in range(2000):
        wall_s = 1000.0 + 0.02 * tick
        stamps.saw(0.5 * 0.02 * tick, wall_s)
        late_s = wall_s - stamps.wall_s(0.5 * 0.02 * tick)
        assert 0.0 <= late_s <= LATELY_S


def test_a_clock_that_is_set_back_is_followed():
    stamps = Stamps()
    stamps.saw(1.0, 1001.0)
    stamps.saw(1.1, 501.1)
    assert stamps.wall_s(1.1) == pytest.approx(501.1)


@pytest.mark.parametrize("wall_s", [-1.0, math.nan, math.inf, 2.0**31])
def test_a_time_that_is_none_is_zero(wall_s):
    assert time_of(wall_s) == {"sec": 0, "nanosec": 0}


def test_a_time_is_whole_seconds_and_the_rest():
    assert time_of(12.25) == {"sec": 12, "nanosec": 250_000_000}
    assert time_of(1.9999999999)["nanosec"] < 1_000_000_000
