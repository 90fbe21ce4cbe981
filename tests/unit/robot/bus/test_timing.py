import pytest
from hypothesis import given
from hypothesis import strategies as st

from robot.bus.timing import BIN_S, Lateness

PERIOD_S = 0.002


def test_a_loop_in_time_is_never_late():
    lateness = Lateness("x", PERIOD_S)
    for tick in range(1000):
        assert lateness.tick(5.0 + tick * PERIOD_S) < 1e-9
    report = lateness.report(2.0, 2.0)
    assert (report.count, report.late) == (999, 0)
    assert report.p999_s < 2 * BIN_S


@given(lates=st.lists(st.floats(0.0, 0.05), min_size=1, max_size=200))
def test_figures_are_those_of_the_delays(lates):
    lateness, now_s = Lateness("x", PERIOD_S), 0.0
    lateness.tick(now_s)
    for late_s in lates:
        now_s += PERIOD_S + late_s
        lateness.tick(now_s)
    assert lateness.count == len(lates)
    assert lateness.max_s == pytest.approx(max(lates), abs=1e-9)
    ordered = sorted(lates)
    median = ordered[(len(ordered) + 1) // 2 - 1]
    assert lateness.percentile_s(0.5) == pytest.approx(median, abs=2 * BIN_S)
    assert lateness.percentile_s(1.0) == pytest.approx(max(lates), abs=2 * BIN_S)
    assert abs(lateness.late - sum(late > PERIOD_S / 2 for late in lates)) <= sum(
        abs(late - PERIOD_S / 2) < 1e-9 for late in lates
    )


def test_the_real_time_factor_is_simulated_over_wall_time():
    lateness = Lateness("x", PERIOD_S)
    lateness.report(10.0, 100.0)
    assert lateness.report(15.0, 110.0).real_time_factor == pytest.approx(0.5)


def test_long_delays_do_not_overflow():
    lateness = Lateness("x", PERIOD_S)
    lateness.tick(0.0)
    assert lateness.tick(100.0) == pytest.approx(100.0 - PERIOD_S)
    assert lateness.percentile_s(0.5) <= lateness.max_s
