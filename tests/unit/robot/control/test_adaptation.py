"""What a DCM error asks of a step: nothing where the foot holds it, more the longer it grows."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from robot.control.walking.adaptation import (
    TIMES,
    cheapest_time,
    dcm_at_end,
    error_at_end,
    nearest_time,
)

OMEGA_1_S, GAIN_1_S = 4.2, 4.0
RATES = {"omega_1_s": OMEGA_1_S, "gain_1_s": GAIN_1_S}
errors = st.floats(-0.2, 0.2)
times = st.floats(0.0, 0.7)


@given(errors, times)
def test_with_the_zmp_free_an_error_decays(error, left_s):
    correction = (1.0 + GAIN_1_S / OMEGA_1_S) * error  # unclipped
    end = error_at_end(error, correction, left_s, **RATES)
    assert end == pytest.approx(error * math.exp(-GAIN_1_S * left_s), abs=1e-12)


@given(st.floats(0.03, 0.2), times, st.floats(0.0, 0.02), st.sampled_from([1.0, -1.0]))
def test_at_the_edge_of_the_foot_what_is_not_held_grows(error, left_s, edge, sign):
    end = error_at_end(sign * error, sign * edge, left_s, **RATES)
    assert sign * end >= error - 1e-12
    assert sign * end >= edge + (error - edge) * math.exp(OMEGA_1_S * left_s) - 1e-12


@given(errors, st.floats(-0.1, 0.1), times)
def test_left_and_right_are_alike(error, correction, left_s):
    there = error_at_end(error, correction, left_s, **RATES)
    back = error_at_end(-error, -correction, left_s, **RATES)
    if error != 0.0:
        assert there == pytest.approx(-back, abs=1e-12)


@given(st.tuples(errors, errors), st.tuples(errors, errors), times, times)
def test_the_dcm_runs_away_from_the_zmp_in_one_go_as_in_two(xi, zmp, first_s, then_s):
    there = dcm_at_end(xi, zmp, first_s, OMEGA_1_S)
    further = dcm_at_end(there, zmp, then_s, OMEGA_1_S)
    assert further == pytest.approx(dcm_at_end(xi, zmp, first_s + then_s, OMEGA_1_S), abs=1e-9)
    assert dcm_at_end(zmp, zmp, then_s, OMEGA_1_S) == pytest.approx(zmp)


@given(st.floats(0.1, 0.8), st.floats(0.2, 0.4), st.floats(0.0, 0.4))
def test_the_cheapest_time_is_near_the_best_and_between_the_bounds(best_s, shortest_s, span_s):
    longest_s = shortest_s + span_s
    time_s = cheapest_time(lambda t: (t - best_s) ** 2, shortest_s, longest_s)
    nearest_s = max(shortest_s, min(longest_s, best_s))
    assert shortest_s <= time_s <= longest_s + 1e-12
    assert abs(time_s - nearest_s) <= span_s / (TIMES - 1) / 2 + 1e-9


def test_with_no_time_left_it_is_the_soonest():
    assert cheapest_time(lambda t: -t, 0.5, 0.4) == 0.5


@given(st.floats(0.05, 0.1), st.floats(0.1, 0.3), st.floats(-0.1, 0.4))
def test_the_weight_is_shifted_in_the_time_that_suits_the_dcm(shortest_s, longest_s, x):
    """A plan that takes longer begins further back."""

    def begins(shift_s):
        return -shift_s, 0.0

    chosen_s = nearest_time(begins, (-x, 0.0), shortest_s, longest_s)
    assert shortest_s - 1e-12 <= chosen_s <= longest_s + 1e-12
    best_s = min(max(x, shortest_s), longest_s)
    assert abs(chosen_s - best_s) <= (longest_s - shortest_s) / (TIMES - 1)
