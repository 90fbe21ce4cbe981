"""The support polygon: clipping ends inside, at the nearest point, and changes nothing twice."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from robot.control.walking.footsteps import Sole
from robot.control.walking.support import SupportPolygon

HALF_LENGTH_M, HALF_WIDTH_M, MARGIN_M = 0.10, 0.045, 0.008
near = st.floats(-0.4, 0.4)
soles = st.lists(st.builds(Sole, near, near, st.floats(-math.pi, math.pi)), min_size=1, max_size=2)
points = st.tuples(st.floats(-1.0, 1.0), st.floats(-1.0, 1.0))


def polygon(planted):
    return SupportPolygon(planted, HALF_LENGTH_M, HALF_WIDTH_M, margin_m=MARGIN_M)


@given(soles, points)
def test_a_clipped_point_is_inside(planted, point):
    support = polygon(planted)
    assert support.margin_m(support.clip(point)) > -1e-9


@given(soles, points)
def test_clipping_twice_is_clipping_once(planted, point):
    support = polygon(planted)
    once = support.clip(point)
    assert support.clip(once) == pytest.approx(once, abs=1e-9)


@given(soles, points)
def test_a_point_inside_is_left_alone(planted, point):
    support = polygon(planted)
    if support.margin_m(point) > 1e-6:
        assert support.clip(point) == point


@given(soles, points, st.integers(0, 20))
def test_no_point_of_the_polygon_is_nearer(planted, point, pick):
    support = polygon(planted)
    clipped = support.clip(point)
    corners = support.vertices
    a, b = corners[pick % len(corners)], corners[(pick + 1) % len(corners)]
    for share in (0.0, 0.3, 0.7):
        rival = (a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]))
        assert math.dist(clipped, point) <= math.dist(rival, point) + 1e-9


@given(soles)
def test_the_centre_of_every_sole_is_inside_by_what_the_foot_allows(planted):
    support = polygon(planted)
    for sole in planted:
        assert support.margin_m((sole.x, sole.y)) >= HALF_WIDTH_M - MARGIN_M - 1e-9


def test_one_sole_is_its_rectangle_less_the_margin():
    support = polygon([Sole(0.0, 0.0, 0.0)])
    assert support.clip((1.0, 1.0)) == pytest.approx(
        (HALF_LENGTH_M - MARGIN_M, HALF_WIDTH_M - MARGIN_M)
    )


@given(soles, points, st.floats(0.001, 0.05))
def test_a_point_outside_may_stay_a_little_outside(planted, point, beyond_m):
    support = polygon(planted)
    edge, kept = support.clip(point), support.clip(point, beyond_m=beyond_m)
    assert math.dist(edge, kept) <= beyond_m + 1e-9
    assert math.dist(kept, point) == pytest.approx(
        max(0.0, math.dist(edge, point) - beyond_m), abs=1e-9
    )
