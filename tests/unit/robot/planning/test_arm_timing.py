"""Timed paths are inside velocity and acceleration limits, at rest at the ends, on the path."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from robot.planning.timing import rounded, time_path

VELOCITY, ACCELERATION = np.full(3, 2.0), np.full(3, 6.0)
corner = st.tuples(*[st.floats(-1.5, 1.5)] * 3)
STUBBORN = [
    (0.0, 0.125, 0.5), (0.0, -1.0, 0.0), (0.0, -1.5, 0.5), (0.0, -0.828125, 0.0),
    (0.0, 0.0, 0.494140625),
]  # fmt: skip
"""Slowing down does not bring it inside the limits in the tries there are: it is stretched."""

THERE_AND_BACK = [(0.875, 1.5, 1.0), (0.0, 0.0, 0.0), (0.875, 1.5, 1.0)]


@given(st.lists(corner, min_size=2, max_size=5))
@example(STUBBORN)
@example(THERE_AND_BACK)
def test_the_spline_is_inside_the_limits(corners: list[tuple[float, ...]]) -> None:
    points = np.array(corners)
    if np.linalg.norm(np.diff(points, axis=0), axis=1).min() < 0.05:
        return
    timed = time_path(
        rounded(points, np.full(len(points), 0.2)), velocity=VELOCITY, acceleration=ACCELERATION
    )
    speed = timed.sampled(400, derivative=1)
    assert (np.abs(speed) <= VELOCITY * 1.02).all()
    assert (np.abs(timed.sampled(400, derivative=2)) <= ACCELERATION * 1.05).all()
    assert np.allclose(speed[[0, -1]], 0.0, atol=1e-9)
    assert np.allclose(timed.positions_rad[0], points[0])
    assert np.allclose(timed.positions_rad[-1], points[-1])
    assert (np.diff(timed.times_s) > 0.0).all()


def test_a_straight_move_takes_about_as_long_as_it_must() -> None:
    points = np.array([[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]])
    timed = time_path(rounded(points, np.zeros(2)), velocity=VELOCITY, acceleration=ACCELERATION)
    shortest_s = 2.0 / 2.0 + 2.0 / 6.0
    assert shortest_s < timed.times_s[-1] < 1.35 * shortest_s


def test_corners_are_cut_no_more_than_allowed() -> None:
    points = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]])
    path = rounded(points, np.array([0.0, 0.2, 0.0]))
    off = [min(np.linalg.norm(q[:2] - [q[0], 0]), abs(q[0] - 1.0)) for q in path]
    assert max(off) == pytest.approx(0.05, abs=0.01)


def test_no_move_at_all_is_a_short_rest() -> None:
    timed = time_path(np.zeros((5, 3)), velocity=VELOCITY, acceleration=ACCELERATION)
    assert 0.0 < timed.times_s[-1] < 0.2
    assert (timed.positions_rad == 0.0).all()
