"""The controlled sit: what is planned bears the body, and what is played begins where it is."""

import mujoco
import numpy as np
import pytest

from robot.drivers.motor_bus import MotorCommand
from robot.model import description
from robot.model.body import SIDES, BodyModel
from robot.owner.sit import LASTS_S, LOW_SHARE, STEPS, Sitting, plan
from robot.se3 import SE3

PERIOD_S = 0.002


def posed(body, squat, place: int):
    """A MjData at a posture of the squat, its left sole on the floor."""
    data = body.data()
    q = np.array(body.description.posture("nominal"))
    q[squat.legs] = squat.q_rad[place]
    body.write_base(data, SE3((0.0, 0.0, float(squat.height_m[place]))))
    body.write_joints(data, q)
    mujoco.mj_kinematics(body.model, data)
    mujoco.mj_comPos(body.model, data)
    return data


@pytest.mark.parametrize("place", range(0, STEPS, 4))
def test_every_posture_has_flat_soles_and_its_mass_over_their_middle(body, squat, place):
    data = posed(body, squat, place)
    soles = [data.site_xpos[body.sole_site[side]] for side in SIDES]
    for side, p in zip(SIDES, soles, strict=True):
        assert p[2] == pytest.approx(0.0, abs=1e-5)
        assert data.site_xmat[body.sole_site[side]].reshape(3, 3)[2, 2] > 1.0 - 1e-9
    middle = 0.5 * (soles[0] + soles[1])
    com = data.subtree_com[body.base_body]
    assert com[:2] == pytest.approx(middle[:2], abs=1e-4)


def test_it_goes_down_inside_all_limits_and_bears_the_body_with_half_of_the_torque(body, squat):
    walking = body.description.walking
    assert (np.diff(squat.height_m) < 0.0).all()
    assert squat.height_m[-1] == pytest.approx(LOW_SHARE * walking.base_height_m)
    assert (squat.q_rad >= body.lower_rad[squat.legs]).all()
    assert (squat.q_rad <= body.upper_rad[squat.legs]).all()
    assert (np.abs(squat.tau_nm) < 0.5 * body.torque_limit_nm[squat.legs]).all()


def test_the_torques_are_those_of_a_body_at_rest(body, squat):
    """With them and a wrench at each sole nothing accelerates."""
    data = posed(body, squat, STEPS // 2)
    model = body.model
    bias, jac = np.zeros(model.nv), np.zeros((12, model.nv))
    mujoco.mj_rne(model, data, 0, bias)
    for row, side in zip((0, 6), SIDES, strict=True):
        mujoco.mj_jacSite(model, data, jac[row : row + 3], jac[row + 3 : row + 6],
                          body.sole_site[side])  # fmt: skip
    rows = [*range(6), *body.dof_of[squat.legs]]
    tau = np.zeros(model.nv)
    tau[body.dof_of[squat.legs]] = squat.tau_nm[STEPS // 2]
    rest = (bias - tau)[rows]
    wrenches = np.linalg.lstsq(jac[:, rows].T, rest, rcond=None)[0]
    assert jac[:, rows].T @ wrenches == pytest.approx(rest, abs=1e-6)
    assert wrenches[2] == pytest.approx(wrenches[8], rel=1e-3)  # half of the weight each


@pytest.mark.parametrize("robot", ["g1", "t1"])
def test_other_robots_sit_as_deep_as_their_legs_reach(robot):
    try:
        other = BodyModel(description.load(robot))
    except Exception as error:
        pytest.skip(f"its model is not here: {error}")
    found = plan(other)
    assert found.height_m[-1] < other.description.walking.base_height_m


def standing(body, squat, *, off_rad: float = 0.0) -> tuple[MotorCommand, np.ndarray]:
    """What a controller sent last to a robot that stands, and where its motors are."""
    q = np.array(body.description.posture("nominal"))
    q[squat.legs] = squat.q_rad[8] + off_rad
    zero = np.zeros(body.count)
    return MotorCommand(0.0, q, zero, zero + 1.0, body.kp.copy(), body.kd.copy()), q


@pytest.mark.parametrize("off_rad", [-0.05, 0.0, 0.1])
def test_it_begins_where_the_motors_are_and_never_jumps(body, squat, off_rad):
    last, q = standing(body, squat, off_rad=off_rad)
    sitting = Sitting(body, squat, last, q, now_s=5.0)
    assert sitting.at(5.0).q_des == pytest.approx(last.q_des)
    assert sitting.at(5.0).tau_ff == pytest.approx(last.tau_ff)
    before, periods = sitting.at(5.0), round(LASTS_S / PERIOD_S)
    for period in range(1, periods + 1):
        now = sitting.at(5.0 + period * PERIOD_S)
        moved = np.abs(now.q_des - before.q_des) / PERIOD_S
        assert (moved <= 0.25 * body.velocity_limit_rad_s).all()
        assert np.isfinite(now.tau_ff).all()
        before = now
    assert sitting.is_over(5.0 + LASTS_S)
    low = np.clip(squat.q_rad[-1] + off_rad, body.lower_rad[squat.legs], body.upper_rad[squat.legs])
    assert before.q_des[squat.legs] == pytest.approx(low, abs=1e-6)


def test_the_speed_it_asks_for_is_that_of_its_positions(body, squat):
    last, q = standing(body, squat)
    sitting = Sitting(body, squat, last, q, now_s=0.0)
    for now_s in np.arange(0.1, 1.7, 0.0137):
        one, two = sitting.at(float(now_s) - 1e-5), sitting.at(float(now_s) + 1e-5)
        slope = (two.q_des - one.q_des) / 2e-5
        assert sitting.at(float(now_s)).qd_des == pytest.approx(slope, abs=0.1)


def test_a_robot_that_squats_already_goes_the_rest_of_the_way_in_less_time(body, squat):
    last, q = standing(body, squat)
    q[squat.legs] = squat.q_rad[-5]
    sitting = Sitting(body, squat, last, q, now_s=0.0)
    assert sitting.is_over(0.2 * LASTS_S)
    assert not sitting.is_over(0.1 * LASTS_S)


def test_arms_and_head_stay_where_they_were_sent(body, squat):
    last, q = standing(body, squat)
    others = [index for index in range(body.count) if index not in squat.legs]
    low = Sitting(body, squat, last, q, now_s=0.0).at(LASTS_S)
    assert low.q_des[others] == pytest.approx(last.q_des[others])
    assert low.qd_des[others] == pytest.approx(0.0)
