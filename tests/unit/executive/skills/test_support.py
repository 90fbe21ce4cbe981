"""Things stand on what they stand on."""

import math

import msgspec
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from executive.skills.motions.support import stands_on, supported, surface_under
from robot.messages import Shape
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
        SE3.from_rpy(math.pi / 4, 0.0, 0.0, (2.0, 0.0, TABLE_M + HALF_M)),  # about to fall
    ],
)
def test_anything_else_stays_where_it_was_seen(X_WO):
    assert supported(X_WO, CUP, MAP.places) is X_WO


NEWSPAPER = msgspec.structs.replace(
    CUP,
    shape=Shape(kind="cylinder", size_m=(0.055, 0.055, 0.28), X_BodyShape=SE3((0.0, 0.01, 0.0))),
)
BOOK = msgspec.structs.replace(CUP, shape=Shape(kind="box", size_m=(0.12, 0.04, 0.18)))


@pytest.mark.parametrize("info", [NEWSPAPER, BOOK])
@given(st.floats(-0.075, 0.018), st.floats(-3, 3), st.floats(-0.1, 0.1), st.floats(-0.1, 0.1))
def test_what_lies_is_level_on_the_surface_it_is_seen_in(info, off_m, yaw, nod, roll):
    """A newspaper that was seen 2 cm too low was sunk in its table: every grasp touched that."""
    shape = info.shape
    half_m = 0.5 * (shape.size_m[0] if shape.kind == "cylinder" else shape.size_m[1])
    lying = SE3.from_rpy(math.pi / 2, 0.0, 0.0, (0.0, 0.0, 0.0))
    middle = SE3.from_rpy(roll, nod, yaw, (2.0, 0.0, TABLE_M + half_m + off_m))
    seen = middle @ lying @ shape.X_BodyShape.inverse()
    result = supported(seen, info, MAP.places) @ shape.X_BodyShape
    up = result.rotation()[2]
    assert result.p == pytest.approx((2.0, 0.0, TABLE_M + half_m))
    assert abs(up[2]) < 1e-9 and (info is NEWSPAPER or abs(abs(up[1]) - 1.0) < 1e-9)
    turn = (seen @ shape.X_BodyShape).rotation().T @ result.rotation()
    assert np.trace(turn) > 1.0 + 2.0 * math.cos(0.15), "no further than it takes"


@pytest.mark.parametrize("sunk_m", [0.0, 0.03, 0.05, 0.079, 0.11])
def test_what_is_seen_sunk_from_afar_stands_on_the_surface(sunk_m: float) -> None:
    """The middle of a cup 2.6 m away was seen level with the table: every grasp touched that."""
    place = MAP.place("table")
    bottom_m = 0.5 * CUP.shape.size_m[2]
    x_m, y_m, z_m = place.X_WP.p
    seen = SE3((x_m, y_m, z_m + bottom_m - sunk_m))
    assert supported(seen, CUP, MAP.places).p == pytest.approx((x_m, y_m, z_m + bottom_m))
    if sunk_m < 0.1:
        assert stands_on(SE3((x_m, y_m, z_m + 0.01 - 0.5 * sunk_m)), place), "a flat thing as well"


def test_of_two_surfaces_the_nearer_one_counts() -> None:
    low = msgspec.structs.replace(MAP.place("table"), id="low")
    x_m, y_m, z_m = low.X_WP.p
    high = msgspec.structs.replace(low, id="high", X_WP=SE3((x_m, y_m, z_m + 0.07)))
    bottom_m = 0.5 * CUP.shape.size_m[2]
    for places in ((low, high), (high, low)):
        seen = SE3((x_m, y_m, z_m + 0.01 + bottom_m))
        assert supported(seen, CUP, places).p[2] == pytest.approx(z_m + bottom_m)


@given(st.floats(1.72, 2.28), st.floats(-0.48, 0.48), st.floats(-0.119, 0.29))
def test_what_is_seen_too_low_across_a_room_is_on_the_surface_over_it(x, y, above_m) -> None:
    """Two things on a desk, seen from 4.4 m, "did not stand on one surface"."""
    found = surface_under(SE3((x, y, TABLE_M + above_m)), MAP.places)
    assert found is not None
    assert found.id == "table"


@given(st.floats(0.0, 0.29), st.floats(0.14, 0.3))
def test_a_board_that_something_is_over_counts_before_the_one_above_it(above_m, gap_m) -> None:
    low = msgspec.structs.replace(MAP.place("table"), id="low", clearance_m=gap_m)
    x_m, y_m, z_m = low.X_WP.p
    high = msgspec.structs.replace(low, id="high", X_WP=SE3((x_m, y_m, z_m + gap_m)))
    for places in ((low, high), (high, low)):
        found = surface_under(SE3((x_m, y_m, z_m + min(above_m, gap_m - 0.06))), places)
        assert found is low


@pytest.mark.parametrize("p_WO", [(2.0, 0.0, 0.05), (3.0, 0.0, TABLE_M + 0.05), (2.0, 0.0, 2.0)])
def test_what_is_beneath_beside_or_far_above_is_on_no_surface(p_WO) -> None:
    assert surface_under(SE3(p_WO), MAP.places) is None
