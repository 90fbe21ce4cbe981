"""What a DCM error asks of a step: nothing where the foot holds it, more the longer it grows."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from robot.control.walking.adaptation import DCM_GAIN_1_S, error_at_end, time_to_reach

OMEGA_1_S = 4.2
errors = st.floats(-0.2, 0.2)
times = st.floats(0.0, 0.7)


@given(errors, times)
def test_with_the_zmp_free_an_error_decays(error, left_s):
    correction = (1.0 + DCM_GAIN_1_S / OMEGA_1_S) * error  # unclipped
    end = error_at_end(error, correction, left_s, OMEGA_1_S)
    assert end == pytest.approx(error * math.exp(-DCM_GAIN_1_S * left_s), abs=1e-12)


@given(st.floats(0.03, 0.2), times, st.floats(0.0, 0.02), st.sampled_from([1.0, -1.0]))
def test_at_the_edge_of_the_foot_what_is_not_held_grows(error, left_s, edge, sign):
    end = error_at_end(sign * error, sign * edge, left_s, OMEGA_1_S)
    assert sign * end >= error - 1e-12
    assert sign * end >= edge + (error - edge) * math.exp(OMEGA_1_S * left_s) - 1e-12


@given(errors, st.floats(-0.1, 0.1), times)
def test_left_and_right_are_alike(error, correction, left_s):
    there = error_at_end(error, correction, left_s, OMEGA_1_S)
    back = error_at_end(-error, -correction, left_s, OMEGA_1_S)
    if error != 0.0:
        assert there == pytest.approx(-back, abs=1e-12)


@given(st.floats(0.005, 0.3), st.floats(0.005, 0.3))
def test_the_dcm_is_there_at_the_time_it_says(now, end):
    time_s = time_to_reach(now, end, OMEGA_1_S)
    assert now * math.exp(OMEGA_1_S * time_s) == pytest.approx(end)


@given(st.floats(-0.3, 0.0049), st.floats(-0.3, 0.3))
def test_a_dcm_on_the_other_side_never_gets_there(now, end):
    assert time_to_reach(now, end, OMEGA_1_S) == math.inf
    assert time_to_reach(end, now, OMEGA_1_S) == math.inf
