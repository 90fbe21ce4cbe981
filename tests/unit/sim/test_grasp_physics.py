"""Friction alone holds what the hand holds, and nothing creeps out of it."""

import mujoco
import numpy as np
import pytest

from robot.reality import faults
from robot.se3 import SE3
from sim.faults import apply
from sim.plant import Plant


def grasp_pose(plant: Plant) -> SE3:
    site = plant.data.site(plant.robot.hands["right"].grasp_site)
    return SE3.from_rotation(site.xmat.reshape(3, 3), site.xpos)


@pytest.fixture(params=[1, 2], ids=["1ms", "2ms"])
def holding(robot, kitchen, hold, request):
    """A plant that stands with the red cup in its right hand, and how to go on."""
    plant = Plant(kitchen, robot, seed=0, noisy=False, physics_ms=request.param)
    finger = robot.motor_names.index("right_gripper")

    def go(duration_s: float, opening: float, *, carry: bool = False) -> None:
        for _ in range(round(duration_s / 0.01)):
            command = hold(plant.time_s)
            command.q_des[finger], command.kp[finger] = opening, 1000.0
            plant.write(command)
            if carry:
                mujoco.mj_kinematics(plant.model, plant.data)
                plant.put("object/red_cup", grasp_pose(plant))
            plant.step(10)

    go(0.6, 0.05, carry=True)
    go(0.4, 0.0, carry=True)
    return plant, go


def test_a_cup_is_held_without_creep_and_falls_when_let_go(holding):
    plant, go = holding
    go(1.0, 0.0)
    before = grasp_pose(plant).inverse() @ plant.oracle.X_WO("red_cup")
    go(8.0, 0.0)
    after = grasp_pose(plant).inverse() @ plant.oracle.X_WO("red_cup")
    assert np.linalg.norm(np.subtract(after.p, before.p)) < 0.001
    opening_m = 2.0 * plant.data.joint("right_gripper").qpos[0]
    assert opening_m == pytest.approx(0.07, abs=0.003)
    go(1.0, 0.05)
    assert plant.oracle.X_WO("red_cup").p[2] < 0.1  # on the floor


def test_a_pull_takes_a_held_cup_away(holding):
    plant, go = holding
    go(0.5, 0.0)
    apply(plant, faults.Push(target="red_cup", impulse_n_s=(0.0, 0.0, -15.0), duration_s=0.3))
    go(1.0, 0.0)
    assert plant.oracle.X_WO("red_cup").p[2] < 0.1
