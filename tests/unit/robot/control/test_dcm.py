"""The DCM plan obeys xidot = omega (xi - p), is continuous, and ends where it should."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from robot.control.walking.dcm import DcmPlan, Segment

OMEGA_1_S = 4.2
points = st.tuples(st.floats(-1.0, 1.0), st.floats(-1.0, 1.0))


@st.composite
def plans(draw):
    """Segments that hang together, as feet do, and the last point as the end."""
    corners = draw(st.lists(points, min_size=2, max_size=7))
    durations = draw(
        st.lists(st.floats(0.05, 0.8), min_size=len(corners) - 1, max_size=len(corners) - 1)
    )
    segments = [Segment(a, b, t) for a, b, t in zip(corners, corners[1:], durations, strict=False)]
    return DcmPlan(segments, corners[-1], OMEGA_1_S)


def span_s(plan):
    return sum(segment.duration_s for segment in plan.segments)


@given(plans(), st.floats(0.0, 1.0))
def test_the_dcm_diverges_from_the_zmp_at_omega(plan, share):
    h = 1e-5
    t = h + share * (span_s(plan) - 2 * h)
    ends = [sum(s.duration_s for s in plan.segments[: k + 1]) for k in range(len(plan.segments))]
    if any(abs(t - end) < 2 * h for end in ends):
        return
    (before, _), (xi, zmp), (after, _) = plan.at(t - h), plan.at(t), plan.at(t + h)
    for k in (0, 1):
        rate = (after[k] - before[k]) / (2 * h)
        assert rate == pytest.approx(OMEGA_1_S * (xi[k] - zmp[k]), abs=1e-4)


@given(plans())
def test_it_is_continuous_across_segments(plan):
    t = 0.0
    for segment in plan.segments:
        t += segment.duration_s
        (xi_before, p_before), (xi_after, p_after) = plan.at(t - 1e-9), plan.at(t + 1e-9)
        assert xi_before == pytest.approx(xi_after, abs=1e-6)
        assert p_before == pytest.approx(p_after, abs=1e-6)


@given(plans(), st.floats(0.0, 5.0))
def test_it_ends_and_stays_at_the_terminal(plan, later_s):
    xi, zmp = plan.at(span_s(plan) + 1e-6 + later_s)
    assert xi == plan.terminal
    assert zmp == plan.segments[-1].end
    assert plan.at(span_s(plan) - 1e-9)[0] == pytest.approx(plan.terminal, abs=1e-6)


@given(points, st.floats(0.0, 3.0))
def test_resting_over_a_point_stays_there(point, time_s):
    plan = DcmPlan([Segment(point, point, 1.0)], point, OMEGA_1_S)
    xi, zmp = plan.at(time_s)
    assert xi == pytest.approx(point, abs=1e-12)
    assert zmp == pytest.approx(point, abs=1e-12)


def test_an_empty_plan_rests_at_its_terminal():
    assert DcmPlan([], (0.3, -0.2), OMEGA_1_S).at(1.0) == ((0.3, -0.2), (0.3, -0.2))


@given(plans())
def test_a_later_end_matters_less_the_further_away_it_is(plan):
    """The recursion contracts: what the terminal changes shrinks by exp(-omega T)."""
    moved = DcmPlan(plan.segments, (plan.terminal[0] + 1.0, plan.terminal[1]), OMEGA_1_S)
    difference = moved.starts[0][0] - plan.starts[0][0]
    assert difference == pytest.approx(math.exp(-OMEGA_1_S * span_s(plan)), rel=1e-9)
