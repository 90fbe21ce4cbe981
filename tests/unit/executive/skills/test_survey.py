"""A survey looks where most is left, forgets nothing, and ends."""

import math

import numpy as np

from executive.skills.motions.survey import EYE_M, HEAD_RAD, SIGHT_M, Survey
from robot.messages import Place
from robot.se3 import SE3

HERE = SE3()


def place(name: str, x_m: float, y_m: float) -> Place:
    return Place(id=name, name=name, X_WP=SE3((x_m, y_m, 0.7)), size_m=(0.6, 1.0))


def test_every_view_is_within_the_heads_turn_and_sight_and_it_ends() -> None:
    survey = Survey([place("a", 1.2, 0.6), place("b", -1.5, 0.0), place("c", 9.0, 0.0)])
    looks = 0
    while (p_W := survey.next_point(HERE)) is not None:
        assert abs(math.atan2(p_W[1], p_W[0])) < HEAD_RAD
        assert math.dist(p_W, (0.0, 0.0, EYE_M)) < SIGHT_M
        survey.look(HERE, p_W)
        looks += 1
    assert 0 < looks <= 5
    assert (survey.left_at("a"), survey.left_at("b"), survey.left_at("c")) == (0, 5, 5)


def test_one_view_takes_all_that_is_near_its_line() -> None:
    survey = Survey([place("far", 2.5, 0.0)])
    p_W = survey.next_point(HERE)
    assert p_W is not None
    survey.look(HERE, p_W)
    assert survey.left_at("far") == 0


def test_it_turns_to_where_most_is_left_and_not_at_all_when_nothing_is() -> None:
    survey = Survey([place("behind", -1.5, 0.0), place("out of sight", 0.0, 9.0)])
    yaw_rad = survey.heading(HERE)
    assert yaw_rad is not None
    assert abs(yaw_rad) > math.pi / 2
    turned = SE3.from_xy_yaw(0.0, 0.0, yaw_rad)
    while (p_W := survey.next_point(turned)) is not None:
        survey.look(turned, p_W)
    assert survey.heading(turned) is None
    survey.again("behind")
    assert survey.heading(turned) is not None


def test_it_looks_at_the_floor_below_where_something_was() -> None:
    survey = Survey([], fallen_from=(1.0, 0.2, 0.75))
    p_W = survey.next_point(HERE)
    assert p_W is not None
    assert p_W[2] < 0.1
    assert np.hypot(p_W[0] - 1.0, p_W[1] - 0.2) <= 0.5 + 1e-9
