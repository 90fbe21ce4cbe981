"""A body is moved on by its velocity and by what was planned and is still to come."""

import numpy as np
import pytest

from robot.control.foresight import HOLD_SHARE, Foresight

KNEE = 9


def test_without_a_delay_it_stays_as_measured(dynamics):
    foresight, before = Foresight(), dynamics.data.qpos.copy()
    foresight.plan(0.0, np.ones(dynamics.body.model.nv))
    foresight.move_on(dynamics, 0.005, 0.0, hold_s=0.005)
    assert np.array_equal(dynamics.data.qpos, before)
    assert not dynamics.data.qvel.any()


def test_it_moves_as_was_planned(dynamics):
    model, foresight = dynamics.body.model, Foresight()
    dof, q = KNEE, int(model.jnt_qposadr[model.dof_jntid[KNEE]])
    start = float(dynamics.data.qpos[q])
    dynamics.data.qvel[dof] = 2.0
    acc = np.zeros(model.nv)
    acc[dof] = 30.0
    foresight.plan(0.0, acc)
    foresight.move_on(dynamics, 0.1, 0.010, hold_s=0.005)
    ahead_s = 0.010 + HOLD_SHARE * 0.005
    assert dynamics.data.qvel[dof] == pytest.approx(2.0 + 30.0 * ahead_s)
    moved = 2.0 * ahead_s + 0.5 * 30.0 * ahead_s**2
    assert dynamics.data.qpos[q] - start == pytest.approx(moved)


def test_only_what_is_still_to_come_counts(dynamics):
    """Of a plan that is in force already, and one that is not yet."""
    model, foresight = dynamics.body.model, Foresight()
    foresight.plan(0.0, np.full(model.nv, 100.0))
    foresight.plan(0.004, np.zeros(model.nv))
    foresight.move_on(dynamics, 0.010, 0.004, hold_s=0.0)
    assert not dynamics.data.qvel.any()
    foresight.move_on(dynamics, 0.010, 0.008, hold_s=0.0)
    assert not dynamics.data.qvel.any()


def test_what_is_forgotten_does_not_come(dynamics):
    foresight = Foresight()
    foresight.plan(0.0, np.ones(dynamics.body.model.nv))
    foresight.forget()
    foresight.move_on(dynamics, 0.010, 0.010, hold_s=0.005)
    assert not dynamics.data.qvel.any()
