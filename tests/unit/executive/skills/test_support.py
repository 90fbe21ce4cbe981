"""Things stand on what they stand on."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from executive.skills.motions.support import supported
from robot.se3 import SE3
from tests.fakes.stage import TABLE_M, kitchen

MAP = kitchen()
CUP = MAP.objects[0]
HALF_M = 0.05


@given(st.floats(1.72, 2.28), st.floats(-0.48, 0.48), st.floats(-0.019, 0.019), st.floats(-3, 3))
def test_an_upright_thing_near_a_surface_stands_on_it(x, y, off, yaw):
    X_WO = SE3.from_xy_yaw(x, y, yaw, z_m=TABLE_M + HALF_M + off)
    result = supported(X_WO, CUP, MAP.places)
    assert result.p == pytest.approx((x, y, TABLE_M + HALF_M))
    assert result.quat_wxyz == X_WO.quat_wxyz


@pytest.mark.parametrize(
    "X_WO",
    [
        SE3((2.0, 0.0, TABLE_M + HALF_M + 0.05)),  # in a hand above the table
        SE3((3.0, 0.0, TABLE_M + HALF_M + 0.005)),  # beside it
        SE3((-1.0, 1.0, HALF_M + 0.005)),  # on the floor: a floor place is no surface
        SE3.from_rpy(math.pi / 2, 0.0, 0.0, (2.0, 0.0, TABLE_M + HALF_M)),  # lying
    ],
)
def test_anything_else_stays_where_it_was_seen(X_WO):
    assert supported(X_WO, CUP, MAP.places) is X_WO
