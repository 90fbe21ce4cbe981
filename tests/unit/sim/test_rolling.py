"""What is round rolls, and comes to rest."""

import mujoco
import pytest

from robot.se3 import SE3
from sim.assembly import set_physics
from sim.bodies import add_object
from sim.paint import Paint
from sim.world_schema import Object

RADIUS_M = 0.035
SPEED_M_S = 0.1


@pytest.fixture
def lying():
    """A cup on its side on a floor, rolling along x."""
    spec = mujoco.MjSpec()
    set_physics(spec)
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[5, 5, 0.1])
    cup = Object(
        id="cup", category="cup", color="red", shape="cylinder", on="floor",
        size_m=(2 * RADIUS_M, 2 * RADIUS_M, 0.1), mass_kg=0.25,
    )  # fmt: skip
    add_object(spec, cup, SE3((0, 0, RADIUS_M), (0.5**0.5, 0.5**0.5, 0, 0)), Paint(spec))
    model = spec.compile()
    data = mujoco.MjData(model)
    data.qvel[0], data.qvel[5] = SPEED_M_S, -SPEED_M_S / RADIUS_M
    return model, data


def test_a_cup_on_its_side_rolls_some_way_and_comes_to_rest(lying):
    model, data = lying
    for _ in range(round(3.0 / model.opt.timestep)):
        mujoco.mj_step(model, data)
    assert abs(data.qvel[0]) < 0.001
    assert 0.01 < data.qpos[0] < 0.2
