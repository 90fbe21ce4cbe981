import pytest
from hypothesis import given
from hypothesis import strategies as st

from robot.bus.timing import (
    BIN_S,
    PRESSED_REPORTS,
    WELL_REPORTS,
    Lateness,
)

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


def test_the_pace_is_that_of_the_last_reports():
    lateness = Lateness("x", PERIOD_S)
    for second in range(20):
        lateness.report(min(second, 9), second)
    report = lateness.report(9.0 + 5.0, 20.0)
    assert report.pace == pytest.approx(0.5)
    assert report.real_time_factor == pytest.approx(14 / 20)


DELAYS = st.lists(
    st.floats(0.0, 0.05).filter(lambda late_s: abs(late_s - PERIOD_S / 2) > 1e-6),
    min_size=1,
    max_size=200,
)


@given(lates=DELAYS)
def test_a_body_that_waits_for_nobody_misses_every_late_period(lates):
    lateness, now_s = Lateness("x", PERIOD_S), 0.0
    lateness.tick(now_s)
    for late_s in lates:
        now_s += PERIOD_S + late_s
        lateness.tick(now_s)
    report = lateness.report(now_s, now_s)
    assert not report.waited_for
    assert (report.missed, report.missed_share) == (report.late, report.late_share)


@given(lates=DELAYS, skipped=st.lists(st.integers(0, 3), min_size=200, max_size=200))
def test_a_body_that_waits_misses_the_periods_that_it_lived_without_a_command(lates, skipped):
    lateness, now_s, periods = Lateness("x", PERIOD_S), 0.0, 0
    lateness.tick(now_s, body_s=0.0)
    for late_s, more in zip(lates, skipped, strict=False):
        now_s += PERIOD_S + late_s
        periods += 1 + more
        lateness.tick(now_s, body_s=periods * PERIOD_S)
    report = lateness.report(periods * PERIOD_S, now_s)
    assert report.waited_for
    assert report.missed == sum(more > 0 for more in skipped[: len(lates)])
    assert report.late == sum(late_s > PERIOD_S / 2 for late_s in lates)


def test_a_loop_that_is_waited_for_is_late_and_not_pressed():
    lateness = Lateness("x", PERIOD_S)
    for tick in range(4000):
        lateness.tick(tick * 2.0 * PERIOD_S, body_s=tick * PERIOD_S)
        if tick % 250 == 0:
            report = lateness.report(tick * PERIOD_S, tick * 2.0 * PERIOD_S)
            assert not report.pressed
    assert (report.late_share, report.missed) == (1.0, 0)
    assert report.pace == pytest.approx(0.5)


def test_long_delays_do_not_overflow():
    lateness = Lateness("x", PERIOD_S)
    lateness.tick(0.0)
    assert lateness.tick(100.0) == pytest.approx(100.0 - PERIOD_S)
    assert lateness.percentile_s(0.5) <= lateness.max_s


class Loop:
    """A loop that reports every 250 periods, a part of them late."""

    def __init__(self):
        self.lateness, self.now_s = Lateness("x", PERIOD_S), 0.0
        self.lateness.tick(0.0)

    def report(self, late: float):
        for k in range(250):
            self.now_s += PERIOD_S + (0.0015 if k < 250 * late else 0.0)
            self.lateness.tick(self.now_s)
        return self.lateness.report(self.now_s, self.now_s)


def test_lateness_is_told_of_the_last_half_second_not_of_all_time():
    loop = Loop()
    shares = [loop.report(late).late_share for late in (0.0, 0.4, 0.02, 0.0)]
    assert shares == pytest.approx([0.0, 0.4, 0.02, 0.0])


def test_a_loop_is_pressed_when_it_stays_late_and_until_it_stays_well():
    loop = Loop()
    assert not any(loop.report(late).pressed for late in (0.04, 0.3, 0.0, 0.3, 0.04) * 5)
    reports = [loop.report(0.06).pressed for _ in range(PRESSED_REPORTS)]
    assert reports == [False] * (PRESSED_REPORTS - 1) + [True]
    assert all(loop.report(late).pressed for late in (0.0, 0.03, 0.0, 0.1) * 5)
    reports = [loop.report(0.0).pressed for _ in range(WELL_REPORTS)]
    assert reports == [True] * (WELL_REPORTS - 1) + [False]
