"""The whole-body programme: its answers obey physics, friction and torque limits in any state."""

import mujoco
import numpy as np
import pytest
from scipy.optimize import nnls

from robot.control.whole_body import COP_MARGIN_M, FRICTION, Task, WholeBody
from robot.kinematics.dynamics import Dynamics
from robot.model.body import SIDES, as_index
from robot.physics import GRAVITY_M_S2
from robot.se3 import SE3

TOLERANCE = 1e-4
CONTACTS = [[True, True], [True, False], [False, True]]


@pytest.fixture(scope="module")
def whole(body):
    return WholeBody(body)


def random_state(body, rng):
    """Near standing, moving, leaning a little."""
    dynamics = Dynamics(body)
    data = dynamics.data
    roll, pitch, yaw = rng.uniform(-0.15, 0.15, 3)
    body.write_base(data, SE3.from_rpy(roll, pitch, 5.0 * yaw, (0.1, -0.2, 0.58)))
    q = np.array(body.description.posture("nominal")) + rng.uniform(-0.15, 0.15, body.count)
    q = np.clip(q, body.lower_rad + 0.01, body.upper_rad - 0.01)
    body.write_joints(data, q, rng.uniform(-0.5, 0.5, body.count))
    data.qvel[:6] = rng.uniform(-0.3, 0.3, 6)
    dynamics.kinematics()
    dynamics.dynamics()
    return dynamics


def random_task(body, whole, rng, contact):
    weight_n = body.mass_kg * GRAVITY_M_S2
    rest = np.zeros(body.model.nv)
    arms = body.dof_of[body.description.indices("left_arm")]
    rest[arms] = rng.uniform(-5.0, 5.0, len(arms))
    return Task(
        com_acc=rng.uniform(-2.0, 2.0, 3),
        own_acc=rng.uniform(-8.0, 8.0, 3 + whole.active_count),
        sole_acc=rng.uniform(-3.0, 3.0, 12),
        contact=contact,
        max_force_n=[float(rng.uniform(0.8, 2.0)) * weight_n for _ in SIDES],
        rest_acc=rest,
    )


def solved(body, whole, seed, contact, effort=1.0):
    rng = np.random.default_rng(seed)
    dynamics = random_state(body, rng)
    task = random_task(body, whole, rng, contact)
    task.com_acc *= effort
    task.sole_acc *= effort
    solution = whole.solve(dynamics, task)
    assert solution.ok
    return dynamics, task, solution


def sole_wrench(dynamics, solution, i):
    """The wrench [N, N m] about the sole in the sole's own axes."""
    rotation = dynamics.sole_rotation[i].T
    wrench = solution.wrench[i]
    return np.concatenate([rotation @ wrench[:3], rotation @ wrench[3:]])


@pytest.mark.parametrize("contact", CONTACTS)
@pytest.mark.parametrize("seed", range(6))
def test_mujoco_moves_as_the_solution_says(body, whole, seed, contact):
    """Its torques and wrenches, applied in forward dynamics, give its accelerations."""
    dynamics, _, solution = solved(body, whole, seed, contact)
    model, data = body.model, dynamics.data
    free = mujoco.MjData(model)
    free.qpos[:], free.qvel[:] = data.qpos, data.qvel
    free.qfrc_applied[:] = solution.tau
    for i in range(2):
        free.qfrc_applied[:] += dynamics.jac_sole[i].T @ solution.wrench[i]
    before = int(model.opt.disableflags)
    bit = mujoco.mjtDisableBit
    try:
        model.opt.disableflags = before | bit.mjDSBL_CONSTRAINT | bit.mjDSBL_ACTUATION
        mujoco.mj_forward(model, free)
    finally:
        model.opt.disableflags = before
    scale = 1.0 + np.abs(solution.acc).max()
    np.testing.assert_allclose(free.qacc / scale, solution.acc / scale, atol=1e-5)


def corner_forces(foot):
    """Wrenches of the edges of the friction pyramids at a sole's corners, as columns."""
    x, y = foot.half_length_m - COP_MARGIN_M, foot.half_width_m - COP_MARGIN_M
    columns = []
    for corner in ((x, y, 0.0), (x, -y, 0.0), (-x, y, 0.0), (-x, -y, 0.0)):
        for along in (FRICTION, -FRICTION):
            for across in (FRICTION, -FRICTION):
                force = np.array([along, across, 1.0])
                columns.append(np.concatenate([force, np.cross(corner, force)]))
    return np.column_stack(columns)


@pytest.mark.parametrize("contact", CONTACTS)
@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("effort", [1.0, 5.0])
def test_wrenches_are_ones_that_a_floor_can_give(body, whole, seed, contact, effort):
    """A wrench is what forces inside the friction pyramids at the corners of the sole sum up to."""
    dynamics, task, solution = solved(body, whole, seed, contact, effort)
    for i, side in enumerate(SIDES):
        wrench = sole_wrench(dynamics, solution, i)
        if not contact[i]:
            assert not wrench.any()
            continue
        slack = TOLERANCE * max(1.0, wrench[2])
        assert -slack <= wrench[2] <= task.max_force_n[i] + slack
        _, missing = nnls(corner_forces(body.description.feet[side]), wrench)
        assert missing <= 4.0 * slack


@pytest.mark.parametrize("contact", CONTACTS)
@pytest.mark.parametrize("seed", range(6))
def test_torques_keep_the_limits_and_the_base_has_none(body, whole, seed, contact):
    _, _, solution = solved(body, whole, seed, contact)
    tau = solution.tau[body.dof_of[whole.active_motors]]
    limit = body.torque_limit_nm[whole.active_motors]
    assert (np.abs(tau) <= limit).all()
    assert not solution.tau[:6].any()


@pytest.mark.parametrize("seed", range(3))
def test_arms_accelerate_as_prescribed(body, whole, seed):
    _, task, solution = solved(body, whole, seed, [True, True])
    rest = np.setdiff1d(np.arange(body.model.nv), whole.dofs)
    np.testing.assert_array_equal(solution.acc[rest], task.rest_acc[rest])


def test_standing_still_carries_its_weight_evenly_and_stays(body, whole, dynamics):
    zero = np.zeros(3)
    weight_n = body.mass_kg * GRAVITY_M_S2
    task = Task(
        com_acc=zero, own_acc=np.zeros(3 + whole.active_count),
        sole_acc=np.zeros(12), contact=[True, True],
        max_force_n=[2.0 * weight_n, 2.0 * weight_n], rest_acc=np.zeros(body.model.nv),
    )  # fmt: skip
    solution = whole.solve(dynamics, task)
    forces = [wrench[2] for wrench in solution.wrench]
    assert sum(forces) == pytest.approx(weight_n, rel=1e-3)
    assert forces[0] == pytest.approx(forces[1], rel=0.02)
    assert np.abs(solution.acc).max() < 0.05


def test_a_planted_sole_does_not_accelerate_and_a_swinging_one_does(body, whole, dynamics):
    wanted = np.array([0.5, 0.0, 1.0, 0.0, 0.0, 0.0])
    task = Task(
        com_acc=np.zeros(3), own_acc=np.zeros(3 + whole.active_count),
        sole_acc=np.concatenate([np.zeros(6), wanted]),
        contact=[True, False], max_force_n=[1000.0, 1000.0], rest_acc=np.zeros(body.model.nv),
    )  # fmt: skip
    solution = whole.solve(dynamics, task)
    soles = (dynamics.jac @ solution.acc + dynamics.bias).reshape(2, 6)
    # friction and the small foot leave the rest to the weights: planted outweighs swinging by 100
    assert np.abs(soles[0]).max() < 0.1 * np.abs(soles[1]).max()
    assert soles[1][2] > 0.5 * wanted[2]


def test_indices_without_a_gap_become_a_view():
    assert as_index(np.array([3, 4, 5])) == slice(3, 6)
    gap = np.array([3, 5])
    assert as_index(gap) is gap


def test_under_strain_the_trunk_turns_to_move_the_centre_of_mass(body, whole, dynamics):
    """On one foot, asked for more than the sole can give: strain gives more of it, by turning."""
    sideways, turned = [], []
    for strain in (0.0, 0.5, 1.0):
        task = Task(
            com_acc=np.array([0.0, -2.5, 0.0]), own_acc=np.zeros(3 + whole.active_count),
            sole_acc=np.zeros(12), contact=[True, False], max_force_n=[1000.0, 1000.0],
            rest_acc=np.zeros(body.model.nv), strain=strain,
        )  # fmt: skip
        solution = whole.solve(dynamics, task)
        assert solution.ok
        sideways.append(float(dynamics.M[1] @ solution.acc) / body.mass_kg)
        turned.append(abs(float(solution.acc[3])))
    assert sideways[2] < sideways[1] < sideways[0]
    assert turned[2] > turned[1] > turned[0]


@pytest.mark.parametrize("seed", range(4))
def test_under_strain_the_foot_that_is_to_catch_it_still_comes_down(body, whole, seed):
    """However much is asked of the centre of mass."""
    rng = np.random.default_rng(seed)
    dynamics = random_state(body, rng)
    task = random_task(body, whole, rng, [True, False])
    task.com_acc = np.array([5.0, 0.0, 0.0])
    task.sole_acc[:] = 0.0
    task.sole_acc[8] = -10.0
    task.strain = 1.0
    solution = whole.solve(dynamics, task)
    assert solution.ok
    assert (dynamics.jac @ solution.acc + dynamics.bias)[8] < -7.5
