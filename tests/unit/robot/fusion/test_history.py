import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from robot.fusion.history import LENGTH, MAX_GAP_S, BodyHistory
from robot.se3 import SE3
from tests.fakes.messages_for_tests import body_state


def moving(count: int = 50, *, dt_s: float = 0.02) -> BodyHistory:
    """Walks along x at 1 m/s, turning at 1 rad/s."""
    history = BodyHistory()
    for k in range(count):
        t = k * dt_s
        history.add(body_state(t, SE3.from_xy_yaw(t, 0.0, t), q_rad=(t,)))
    return history


@given(stamp_s=st.floats(0.0, 0.98))
def test_the_pose_at_a_stamp_is_that_of_the_time(stamp_s):
    X_NB = moving().base_at(stamp_s)
    assert X_NB is not None
    assert X_NB.p[0] == pytest.approx(stamp_s, abs=1e-9)
    assert X_NB.yaw_rad == pytest.approx(stamp_s, abs=1e-6)
    assert moving().joints_at(stamp_s)[0] == pytest.approx(stamp_s, abs=0.0101)


def test_no_pose_where_no_state_is_near():
    history = moving()
    assert history.base_at(0.98 + 2 * MAX_GAP_S) is None
    assert history.base_at(-2 * MAX_GAP_S) is None
    assert BodyHistory().base_at(0.0) is None
    assert BodyHistory().joints_at(0.0) is None


def test_old_states_are_forgotten():
    history = moving(count=5 * LENGTH)
    assert history.base_at(0.0) is None
    assert history.covers(5 * LENGTH * 0.02 - 0.02)
    assert not history.covers(5 * LENGTH * 0.02)


def test_states_out_of_order_are_ignored():
    history = moving()
    history.add(body_state(0.5, SE3((9.0, 9.0, 9.0))))
    assert history.newest.stamp_s == pytest.approx(0.98)


def test_a_jump_of_the_base_is_a_new_odometry_frame():
    history = moving()
    history.add(body_state(1.0, SE3()))
    assert history.restarts == 1
    assert history.base_at(0.5) is None
    assert math.isclose(history.newest.stamp_s, 1.0)
