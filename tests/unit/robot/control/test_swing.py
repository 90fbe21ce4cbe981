"""The swing foot: smooth, up and down again, at its landing when time is up, however retimed."""

import math
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace

from robot.control.walking.footsteps import Sole
from robot.control.walking.swing import Swing, minimum_jerk
from robot.model import description

DT_S = 0.004
WALKING = description.load("juno").walking
HEIGHT_M, FOOT = WALKING.step_height_m, WALKING.swing_foot
START = Sole(0.0, 0.1, 0.0)

landings = st.builds(Sole, st.floats(-0.3, 0.4), st.floats(0.0, 0.3), st.floats(-0.5, 0.5))
durations = st.floats(0.3, 0.8)


def fly(swing, *, until_s, retime=()):
    """Advance to a time; `retime` are (time, new duration). Yields after every tick."""
    changes = list(retime)
    while swing.time_s < until_s - 1e-9:
        if changes and swing.time_s >= changes[0][0]:
            swing.duration_s = changes.pop(0)[1]
        swing.advance(DT_S)
        yield swing


@given(landings, durations)
def test_it_ends_at_rest_on_its_landing(landing, duration_s):
    swing = Swing(START, landing, duration_s, WALKING)
    for _ in fly(swing, until_s=duration_s + DT_S):
        pass
    assert swing.position == pytest.approx([landing.x, landing.y, landing.yaw], abs=2e-3)
    assert swing.velocity == [0.0, 0.0, 0.0]


@given(landings, durations)
def test_it_moves_without_jumps(landing, duration_s):
    """No tick moves further than the fastest point of a minimum-jerk curve, 1.875 d / T."""
    swing = Swing(START, landing, duration_s, WALKING)
    before = [START.x, START.y, START.yaw]
    goal = [landing.x, landing.y, landing.yaw]
    fastest = [1.9 * abs(g - b) / duration_s for g, b in zip(goal, before, strict=True)]
    for _ in fly(swing, until_s=duration_s - 0.03):
        for k in range(3):
            assert abs(swing.position[k] - before[k]) <= fastest[k] * DT_S + 1e-9
        before = list(swing.position)


@given(landings, durations, st.booleans())
def test_it_clears_the_floor_then_comes_down_a_little_below_it(landing, duration_s, urgent):
    swing = Swing(START, landing, duration_s, WALKING)
    swing.urgent = urgent
    heights = [one.z for one in fly(swing, until_s=duration_s)]
    assert max(heights) == pytest.approx(HEIGHT_M, abs=0.004)
    middle = heights[int(0.25 * len(heights)) : int(0.75 * len(heights))]
    assert min(middle) > 0.2 * HEIGHT_M
    assert heights[-1] == pytest.approx(-FOOT.press_m if urgent else -FOOT.touch_m, abs=0.002)
    steps = [abs(b - a) for a, b in pairwise(heights)]
    assert max(steps) < 2.2 * HEIGHT_M / (0.45 * duration_s) * DT_S


@given(landings, st.floats(0.4, 0.8))
def test_it_meets_the_floor_slowly_when_it_should_and_sooner_if_urgent(landing, duration_s):
    meets = []
    for urgent in (False, True):
        swing = Swing(START, landing, duration_s, WALKING)
        swing.urgent = urgent
        next(one for one in fly(swing, until_s=1.0) if one.z <= 0.0 and one.vz < 0.0)
        assert -swing.vz <= (0.3 if urgent else 1.3 * FOOT.touch_m_s)
        meets.append(swing.time_s)
    assert duration_s - 0.03 <= meets[0] <= duration_s + DT_S
    assert meets[1] < meets[0] - 0.02


@given(durations)
def test_a_late_foot_keeps_going_down_slowly(duration_s):
    swing = Swing(START, START, duration_s, WALKING)
    for _ in fly(swing, until_s=duration_s + DT_S):
        pass
    before = swing.z
    for _ in fly(swing, until_s=swing.time_s + 0.1):
        pass
    assert (before - swing.z) == pytest.approx(0.1 * FOOT.touch_m_s, abs=1.5e-3)


@given(landings, st.lists(st.tuples(st.floats(0.05, 0.3), st.floats(0.4, 0.7)), max_size=4))
def test_retimed_in_flight_it_still_lands_where_it_should_when_it_should(landing, changes):
    swing = Swing(START, landing, 0.45, WALKING)
    changes = sorted(changes)
    before, largest = list(swing.position), 0.0
    for _ in fly(swing, until_s=0.31, retime=changes):
        largest = max(largest, math.dist(swing.position[:2], before[:2]))
        before = list(swing.position)
    for _ in fly(swing, until_s=swing.duration_s + DT_S):
        largest = max(largest, math.dist(swing.position[:2], before[:2]))
        before = list(swing.position)
    assert swing.position == pytest.approx([landing.x, landing.y, landing.yaw], abs=3e-3)
    assert largest < 0.03  # 7.5 m/s would be a jump


@given(landings)
def test_a_landing_that_moves_is_followed_smoothly(landing):
    swing = Swing(START, Sole(0.1, 0.1, 0.0), 0.45, WALKING)
    before, largest = list(swing.position), 0.0
    for k, _ in enumerate(fly(swing, until_s=0.45 + DT_S)):
        if k >= 30:
            swing.aim(landing, DT_S)
        largest = max(largest, math.dist(swing.position[:2], before[:2]))
        before = list(swing.position)
    assert swing.position[:2] == pytest.approx([landing.x, landing.y], abs=0.01)
    assert largest < 0.02


def test_a_landing_is_frozen_shortly_before_touchdown():
    swing = Swing(START, Sole(0.1, 0.1, 0.0), 0.45, WALKING)
    for _ in fly(swing, until_s=0.40):
        pass
    swing.aim(Sole(0.3, 0.1, 0.0), DT_S)
    assert swing.landing == [0.1, 0.1, 0.0]


small = st.floats(-1.0, 1.0)


@given(small, small, small, small, small, st.floats(0.05, 1.0))
def test_one_whole_step_of_the_quintic_is_its_end(p, v, a, goal, rate, left_s):
    end = minimum_jerk(p, v, a, goal=goal, left_s=left_s, dt_s=left_s, rate=rate)
    assert end == pytest.approx((goal, rate, 0.0), abs=1e-6)


@given(small, small, small, small, small, st.floats(0.2, 1.0))
def test_replanning_on_the_way_stays_on_the_same_curve(p, v, a, goal, rate, left_s):
    half, end = 0.5 * left_s, {"goal": goal, "rate": rate}
    once = minimum_jerk(p, v, a, **end, left_s=left_s, dt_s=half)
    first = minimum_jerk(p, v, a, **end, left_s=left_s, dt_s=0.5 * half)
    twice = minimum_jerk(*first, **end, left_s=left_s - 0.5 * half, dt_s=0.5 * half)
    assert twice == pytest.approx(once, rel=1e-6, abs=1e-6)


def test_how_it_comes_down_is_the_bodys():
    foot = replace(FOOT, touch_m=0.004, touch_m_s=0.2)
    swing = Swing(START, START, 0.5, replace(WALKING, swing_foot=foot))
    for _ in fly(swing, until_s=0.5):
        pass
    assert swing.z == pytest.approx(-0.004, abs=0.002)
    assert swing.vz == pytest.approx(-0.2, abs=0.02)
