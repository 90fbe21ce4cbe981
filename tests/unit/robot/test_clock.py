"""A simulated clock moves only when told, and never back."""

import pytest

from robot.clock import SimulatedClock, WallClock
from tests.fakes.waiting import HANG_S


def test_simulated_time_moves_when_set():
    clock = SimulatedClock(1.0)
    clock.set(1.5)
    assert clock.now_s() == 1.5


def test_simulated_time_never_goes_back():
    clock = SimulatedClock(2.0)
    with pytest.raises(ValueError, match=r"back from 2\.0 to 1\.0"):
        clock.set(1.0)
    clock.sleep_until(1.0)
    assert clock.now_s() == 2.0


def test_sleeping_in_simulated_time_arrives_at_once():
    clock = SimulatedClock()
    clock.sleep_until(1e6)
    assert clock.now_s() == 1e6


def test_wall_time_grows_and_a_past_time_is_not_slept_for():
    clock = WallClock()
    before = clock.now_s()
    clock.sleep_until(before - 2.0 * HANG_S)
    assert 0.0 <= clock.now_s() - before < HANG_S
