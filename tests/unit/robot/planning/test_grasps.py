"""Grasps are on the object, level, within the hand's opening."""

import math

import numpy as np
import pytest

from robot.failures import Failure
from robot.messages import Piece, Shape
from robot.planning.grasps import HandOption, held_option, pick_options
from robot.planning.robot_body import Body
from robot.se3 import SE3

AT = SE3((1.0, 2.0, 0.8))


def options(body: Body, shape: Shape, X_WO: SE3 = AT) -> list[HandOption]:
    robot = body.description
    hand, gripping = robot.hands["right"], robot.handy.gripping
    found = pick_options(shape, X_WO, hand=hand, gripping=gripping)
    assert isinstance(found, list)
    return found


@pytest.mark.parametrize(
    "shape",
    [
        Shape(kind="cylinder", size_m=(0.07, 0.07, 0.10)),
        Shape(kind="cylinder", size_m=(0.065, 0.065, 0.20)),
        Shape(kind="box", size_m=(0.06, 0.10, 0.12)),
        Shape(kind="box", size_m=(0.05, 0.05, 0.05)),
    ],
)
@pytest.mark.parametrize("yaw", [0.0, 0.7])
def test_every_grasp_holds_the_object(body: Body, shape: Shape, yaw: float) -> None:
    X_WO = SE3.from_xy_yaw(1.0, 2.0, yaw, z_m=0.8)
    for option in options(body, shape, X_WO):
        turn = SE3.from_xy_yaw(0.0, 0.0, (option.headings or (0.3,))[0])
        X_WG = SE3(X_WO.p) @ turn @ SE3.from_rotation(option.R0, option.offset)
        assert abs(X_WG.rotation()[2, 1]) < 1e-6  # closes level
        assert abs(X_WG.p[2] - X_WO.p[2]) <= shape.size_m[2] / 2
        assert option.opening_m <= 0.09
        centre = X_WG.inverse().apply(X_WO.p)
        assert abs(centre[1]) < 1e-6  # between the fingers
        if option.headings is not None:
            assert np.allclose((X_WG @ option.X_GO).matrix(), X_WO.matrix(), atol=1e-6)


def test_a_box_is_held_across_its_narrow_side(body: Body) -> None:
    found = options(body, Shape(kind="box", size_m=(0.06, 0.20, 0.10)))
    for option in found:
        assert option.opening_m == pytest.approx(0.06)
        assert all(abs(math.cos(heading)) < 1e-6 for heading in option.headings or ())


def test_a_lying_bottle_is_taken_from_above(body: Body) -> None:
    lying = SE3.from_rpy(math.pi / 2, 0.0, 0.0, AT.p)
    for option in options(body, Shape(kind="cylinder", size_m=(0.06, 0.06, 0.2)), lying):
        assert option.R0[2, 0] < -0.7


@pytest.mark.parametrize("diameter_m", [0.03, 0.045, 0.07])
def test_fingertips_stay_above_the_table_around_what_lies(body: Body, diameter_m: float) -> None:
    gripping = body.description.handy.gripping
    lying = SE3.from_rpy(0.0, math.pi / 2, 0.0, AT.p)
    shape = Shape(kind="cylinder", size_m=(diameter_m, diameter_m, 0.16))
    for option in options(body, shape, lying):
        tip_m = option.offset[2] + gripping.fingertip_m * option.R0[2, 0]
        assert tip_m + 0.5 * diameter_m >= 0.008
        assert tip_m <= 0.0  # below the axis


@pytest.mark.parametrize(
    "shape",
    [
        Shape(kind="box", size_m=(0.05, 0.16, 0.03)),
        Shape(kind="cylinder", size_m=(0.06, 0.06, 0.04)),
    ],
)
def test_what_lies_flat_is_taken_with_the_fingertips_just_above_the_table(
    body: Body, shape: Shape
) -> None:
    gripping = body.description.handy.gripping
    down = [option for option in options(body, shape) if option.R0[2, 0] < -0.6]
    assert down
    for option in down:
        tip_m = option.offset[2] + gripping.fingertip_m * option.R0[2, 0]
        assert 0.008 <= tip_m + 0.5 * shape.size_m[2] <= 0.02
        assert np.hypot(*option.offset[:2]) < 0.01


def test_what_is_too_wide_has_no_grasp(body: Body) -> None:
    hand, gripping = body.description.hands["right"], body.description.handy.gripping
    box = Shape(kind="box", size_m=(0.2, 0.3, 0.1))
    found = pick_options(box, AT, hand=hand, gripping=gripping)
    assert isinstance(found, Failure)
    assert (found.code, found.evidence["width_m"]) == ("no_grasp", pytest.approx(0.2))


def test_how_wide_a_book_is_that_lies_is_not_how_thick_it_is(body: Body) -> None:
    """It said "it is 4 cm wide and the hand opens 9 cm for it"."""
    hand, gripping = body.description.hands["right"], body.description.handy.gripping
    book = Shape(kind="box", size_m=(0.12, 0.18, 0.04))
    found = pick_options(book, AT, hand=hand, gripping=gripping)
    assert isinstance(found, Failure)
    assert (found.code, found.evidence["width_m"]) == ("no_grasp", pytest.approx(0.12))
    assert "12 cm wide" in found.cause


def test_a_held_thing_is_put_down_as_it_is_held(body: Body) -> None:
    X_GO = SE3.from_rpy(0.1, -0.2, 0.4, (0.01, 0.0, 0.02))
    box, gripping = Shape(kind="box", size_m=(0.06, 0.06, 0.1)), body.description.handy.gripping
    option = held_option(X_GO, box, yaws=(0.5,), gripping=gripping)
    assert option.headings is not None
    turn = SE3.from_xy_yaw(0.0, 0.0, option.headings[0])
    X_OG = turn @ SE3.from_rotation(option.R0, option.offset)
    assert np.allclose((X_OG @ X_GO).matrix(), SE3.from_xy_yaw(0, 0, 0.5).matrix(), atol=1e-9)


MUG = Shape(
    kind="cylinder",
    size_m=(0.08, 0.08, 0.10),
    pieces=(
        Piece(kind="cylinder", size_m=(0.08, 0.08, 0.10)),
        Piece(
            kind="box", size_m=(0.03, 0.01, 0.06), X_ShapePiece=SE3((0.055, 0, 0)), is_held=False
        ),
    ),
)
BOTTLE = Shape(
    kind="cylinder",
    size_m=(0.08, 0.08, 0.30),
    pieces=(
        Piece(kind="cylinder", size_m=(0.08, 0.08, 0.20), X_ShapePiece=SE3((0, 0, -0.05))),
        Piece(kind="cylinder", size_m=(0.03, 0.03, 0.10), X_ShapePiece=SE3((0, 0, 0.10))),
    ),
)


@pytest.mark.parametrize("yaw", [0.0, 2.0])
def test_no_finger_comes_where_a_handle_is(body: Body, yaw: float) -> None:
    """The hand is never across from it; beyond the fingertips it may be, or below the palm."""
    X_WO = SE3.from_xy_yaw(1.0, 2.0, yaw, z_m=0.8)
    found = options(body, MUG, X_WO)
    headings = {
        round(math.remainder(o.headings[0] - yaw, math.tau), 2) for o in found if o.headings
    }
    assert all(option.headings for option in found)
    assert headings
    assert all(abs(math.cos(heading)) > 0.7 for heading in headings)
    for option in found:
        turn = SE3.from_xy_yaw(0.0, 0.0, (option.headings or (0.0,))[0])
        X_WG = SE3(X_WO.p) @ turn @ SE3.from_rotation(option.R0, option.offset)
        assert np.allclose((X_WG @ option.X_GO).matrix(), X_WO.matrix(), atol=1e-6)


def test_over_the_rim_the_hand_comes_where_a_handle_is_at_its_palm(body: Body) -> None:
    """And nowhere else: what is taken from above is hard to put on a high board."""
    over = [option for option in options(body, MUG) if -option.R0[2, 0] > math.sin(0.8)]
    assert {round(math.cos(option.headings[0]), 1) for option in over if option.headings} == {
        -0.7,
        -0.9,
        -1.0,
    }
    assert all(0.0 < option.offset[2] < 0.5 * MUG.size_m[2] for option in over)


def test_a_bottle_is_held_by_its_belly_or_its_neck(body: Body) -> None:
    found = options(body, BOTTLE)
    heights = {option.piece: [] for option in found}
    for option in found:
        assert option.headings is None  # it is round
        heights[option.piece].append(option.offset[2])
        assert option.opening_m == (0.08, 0.03)[option.piece or 0]
    assert set(heights) == {0, 1}
    assert max(heights[0]) <= 0.05
    assert min(heights[1]) >= 0.05
    assert min(min(found_m) for found_m in heights.values()) >= -0.15 + 0.035 - 1e-9


def test_a_plate_has_nothing_to_hold(body: Body) -> None:
    robot = body.description
    flat = Piece(kind="cylinder", size_m=(0.26, 0.26, 0.02), is_held=False)
    plate = Shape(kind="cylinder", size_m=(0.26, 0.26, 0.02), pieces=(flat,))
    found = pick_options(plate, AT, hand=robot.hands["right"], gripping=robot.handy.gripping)
    assert isinstance(found, Failure)
    assert found.code == "no_grasp"


def test_a_piece_is_held_as_a_shape_of_its_size_would_be(body: Body) -> None:
    plain = Shape(kind="cylinder", size_m=(0.07, 0.07, 0.12))
    whole = Piece(kind="cylinder", size_m=(0.07, 0.07, 0.12))
    pieced = Shape(kind="cylinder", size_m=(0.07, 0.07, 0.12), pieces=(whole,))
    for one, other in zip(options(body, plain), options(body, pieced), strict=True):
        assert np.allclose(one.offset, other.offset)
        assert np.allclose(one.R0, other.R0)
        assert (one.headings, one.opening_m, one.cost) == pytest.approx(
            (other.headings, other.opening_m, other.cost)
        )
