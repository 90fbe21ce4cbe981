"""The robot knows which pixels are its own: by its joints, and by how far away it is there."""

import mujoco
import numpy as np
import pytest

from robot.model import description
from robot.model.body import BodyModel
from robot.perception.sight.own_body import OwnBody
from robot.se3 import SE3
from tests.fakes.things_in_view import picture_of

SHAPE, DOWN_RAD = (60, 80), 1.05


@pytest.fixture(scope="module")
def body():
    return BodyModel(description.load("juno"))


def standing(body, posture: str, *, pitch_rad: float):
    """The body in a posture, its head turned down."""
    robot, data = body.description, body.data()
    q = np.array(robot.posture(posture))
    q[robot.indices("head")] = (0.0, pitch_rad)
    body.write_base(data, SE3((0.0, 0.0, robot.walking.base_height_m)))
    body.write_joints(data, q)
    mujoco.mj_kinematics(body.model, data)
    return data


def own(body, data, depth_m: float) -> np.ndarray:
    site = body.site_id(body.description.sensors.camera.site)
    return OwnBody(body, site).pixels(
        data, picture_of(np.full(SHAPE, depth_m, np.float32), focal_px=52.0)
    )


def test_who_looks_ahead_with_the_arms_down_sees_nothing_of_itself(body):
    assert not own(body, standing(body, "nominal", pitch_rad=0.0), 3.0).any()


def test_who_looks_down_at_its_hands_sees_them_at_both_sides(body):
    seen = own(body, standing(body, "nominal", pitch_rad=DOWN_RAD), 3.0)
    assert 0.02 < seen.mean() < 0.8
    left, right = seen[:, : SHAPE[1] // 2].sum(), seen[:, SHAPE[1] // 2 :].sum()
    assert min(left, right) > 0.5 * max(left, right)


def test_what_is_before_its_own_body_is_not_its_own(body):
    data = standing(body, "nominal", pitch_rad=DOWN_RAD)
    assert own(body, data, 0.0).sum() >= own(body, data, 3.0).sum() > 0
    assert not own(body, data, 0.1).any()
