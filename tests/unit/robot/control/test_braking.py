"""Braking: from any motion to rest, inside its bounds."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from ruckig import RuckigError

from robot.control.braking import Brake

ACCELERATION, JERK = 12.0, 200.0
joints = st.integers(1, 7).flatmap(
    lambda n: st.tuples(
        *[
            st.lists(st.floats(-most, most), min_size=n, max_size=n).map(np.array)
            for most in (3.0, 4.0, ACCELERATION)
        ]
    )
)


@given(joints)
def test_it_ends_at_rest_in_bounded_time(state):
    brake = Brake(*state, acceleration=ACCELERATION, jerk=JERK)
    fastest = np.abs(state[1]).max() + ACCELERATION**2 / JERK
    assert brake.duration_s <= fastest / ACCELERATION + 3 * ACCELERATION / JERK
    for after_s in (0.0, 1.0):
        _, qd, qdd = brake.at(brake.duration_s + after_s)
        np.testing.assert_allclose(qd, 0.0, atol=1e-9)
        np.testing.assert_allclose(qdd, 0.0, atol=1e-9)


@given(joints)
def test_it_begins_as_things_are_and_stays_inside_its_bounds(state):
    brake = Brake(*state, acceleration=ACCELERATION, jerk=JERK)
    for got, wanted in zip(brake.at(0.0), state, strict=True):
        np.testing.assert_allclose(got, wanted, atol=1e-9)
    dt_s = 0.002
    _, before, push = brake.at(0.0)
    for k in range(1, int(brake.duration_s / dt_s) + 2):
        _, qd, qdd = brake.at(k * dt_s)
        assert (np.abs(qdd) <= ACCELERATION + 1e-9).all()
        assert (np.abs(qd - before) <= ACCELERATION * dt_s + 1e-9).all()
        assert (np.abs(qdd - push) <= JERK * dt_s + 1e-6).all()
        before, push = qd, qdd


def test_what_rests_stays():
    brake = Brake(np.ones(3), np.zeros(3), np.zeros(3), acceleration=ACCELERATION, jerk=JERK)
    assert brake.duration_s == 0.0
    assert brake.at(0.5)[0].tolist() == [1.0, 1.0, 1.0]


def test_what_is_no_number_is_refused():
    with pytest.raises(RuckigError, match="nan"):
        Brake(np.ones(2), np.array([np.nan, 0.0]), np.zeros(2), acceleration=1.0, jerk=1.0)
