"""The last clamp: whatever comes in, what goes out is finite and inside the limits, and counted."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from robot.control.limits import OVERSPEED, OVERSPEED_CYCLES, REFUSALS_TO_DAMP, Limits
from robot.drivers.motor_bus import MotorCommand
from tests.fakes.motors import motor_state


@pytest.fixture
def limits(body):
    return Limits(body)


def at_rest(body):
    """Motors in the middle of their ranges."""
    middle = 0.5 * (body.lower_rad + body.upper_rad)
    return motor_state(middle, stamp_s=1.0, command_stamp_s=1.0)


def hold(body, state):
    zero = np.zeros(body.count)
    return MotorCommand(
        1.0, state.q.copy(), zero.copy(), zero.copy(), body.kp.copy(), body.kd.copy()
    )


def torque(command, state):
    """What the firmware would apply."""
    feedback = command.kp * (command.q_des - state.q) + command.kd * (command.qd_des - state.qd)
    return feedback + command.tau_ff


def damps(command):
    return not command.kp.any() and not command.qd_des.any() and not command.tau_ff.any()


def test_a_command_within_limits_passes_unchanged_and_uncounted(body, limits):
    state = at_rest(body)
    command = hold(body, state)
    before = [a.copy() for a in (command.q_des, command.qd_des, command.tau_ff)]
    out = limits.apply(command, state)
    assert out is command
    for value, expected in zip((out.q_des, out.qd_des, out.tau_ff), before, strict=True):
        np.testing.assert_array_equal(value, expected)
    assert (limits.clamped, limits.refused, limits.tripped) == (0, 0, "")


huge = st.floats(-1e6, 1e6)


@given(st.integers(0, 32), huge, huge, huge)
def test_whatever_is_asked_stays_inside_the_limits(body, motor, q, qd, tau):
    limits, state = Limits(body), at_rest(body)
    command = hold(body, state)
    command.q_des[motor], command.qd_des[motor], command.tau_ff[motor] = q, qd, tau
    out = limits.apply(command, state)
    assert (out.q_des >= body.lower_rad - 1e-12).all()
    assert (out.q_des <= body.upper_rad + 1e-12).all()
    assert (np.abs(out.qd_des) <= body.velocity_limit_rad_s).all()
    applied = np.abs(torque(out, state))
    assert (applied <= body.torque_limit_nm * (1.0 + 1e-9)).all()


@pytest.mark.parametrize(("field", "value"), [("q_des", 99.0), ("qd_des", 99.0), ("tau_ff", 999.0)])
def test_what_is_clamped_is_counted(body, limits, field, value):
    state = at_rest(body)
    command = hold(body, state)
    getattr(command, field)[3] = value
    limits.apply(command, state)
    assert limits.clamped >= 1
    assert limits.refused == 0


def test_the_limit_that_was_in_the_way_most_is_named(body, limits):
    for motor, tau_nm in ((0, 999.0), (3, 999.0), (3, -999.0)):
        command = hold(body, at_rest(body))
        command.tau_ff[motor] = tau_nm
        limits.apply(command, at_rest(body))
    assert limits.most_clamped == f"{body.description.motor_names[3]}'s torque, 2 times"


@pytest.mark.filterwarnings("ignore:invalid value encountered:RuntimeWarning")  # inf x 0
@pytest.mark.parametrize("field", ["q_des", "qd_des", "tau_ff", "kp", "kd"])
@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_what_is_not_finite_is_refused_and_the_last_good_command_held(body, limits, field, value):
    state = at_rest(body)
    state.qd = np.full(body.count, 0.01)
    good = limits.apply(hold(body, state), state)
    kept = good.q_des.copy()
    bad = hold(body, state)
    bad.stamp_s = 1.002
    if field == "kp":
        bad.q_des = bad.q_des + 0.01  # a gain shows only where there is an error
    getattr(bad, field)[5] = value
    out = limits.apply(bad, state)
    np.testing.assert_array_equal(out.q_des, kept)
    assert out.stamp_s == 1.002
    assert np.isfinite(torque(out, state)).all()
    assert limits.refused == 1
    assert not limits.tripped


def test_three_refusals_in_a_row_damp_for_good(body, limits):
    state = at_rest(body)
    limits.apply(hold(body, state), state)
    for _ in range(REFUSALS_TO_DAMP):
        bad = hold(body, state)
        bad.tau_ff[0] = np.nan
        out = limits.apply(bad, state)
    assert damps(out)
    assert "not finite" in limits.tripped
    assert damps(limits.apply(hold(body, state), state))


def test_refusals_that_are_not_in_a_row_do_not_damp(body, limits):
    state = at_rest(body)
    for k in range(12):
        command = hold(body, state)
        if k % 3:
            command.tau_ff[0] = np.nan
        out = limits.apply(command, state)
        assert not damps(out)
    assert limits.refused == 8
    assert not limits.tripped


def test_with_nothing_good_yet_the_first_refusal_damps(body, limits):
    state = at_rest(body)
    bad = hold(body, state)
    bad.q_des[:] = np.nan
    assert damps(limits.apply(bad, state))


@pytest.mark.parametrize("motor", [0, 3, 15, 25])
def test_overspeed_trips_by_name_and_is_latched_until_reset(body, limits, motor):
    state = at_rest(body)
    state.qd = np.zeros(body.count)
    state.qd[motor] = -1.01 * OVERSPEED * body.velocity_limit_rad_s[motor]
    for _ in range(OVERSPEED_CYCLES - 1):  # one bad reading is noise
        assert not damps(limits.apply(hold(body, state), state))
    assert damps(limits.apply(hold(body, state), state))
    assert limits.tripped.startswith(body.description.motor_names[motor])
    calm = at_rest(body)
    assert damps(limits.apply(hold(body, calm), calm))
    limits.reset()
    assert not damps(limits.apply(hold(body, calm), calm))


def test_fast_but_allowed_does_not_trip(body, limits):
    state = at_rest(body)
    state.qd = 0.99 * OVERSPEED * body.velocity_limit_rad_s
    limits.apply(hold(body, state), state)
    assert not limits.tripped


def test_a_repeated_command_is_clamped_for_the_newest_state(body, limits):
    state = at_rest(body)
    command = limits.apply(hold(body, state), state)
    assert limits.clamped == 0
    moved = at_rest(body)
    moved.q = state.q + 3.0  # where the springs would pull harder than the motors can
    out = limits.apply(command, moved)
    assert limits.clamped > 0
    assert (np.abs(torque(out, moved)) <= body.torque_limit_nm * (1.0 + 1e-9)).all()


def test_the_command_held_after_a_refusal_is_clamped_for_the_newest_state(body, limits):
    state = at_rest(body)
    limits.apply(hold(body, state), state)
    bad = hold(body, state)
    bad.tau_ff[0] = np.nan
    held = limits.apply(bad, state)
    moved = at_rest(body)
    moved.q = state.q + 3.0
    out = limits.apply(held, moved)
    assert np.isfinite(torque(out, moved)).all()
    assert (np.abs(torque(out, moved)) <= body.torque_limit_nm * (1.0 + 1e-9)).all()
