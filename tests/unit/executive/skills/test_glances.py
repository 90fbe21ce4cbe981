"""Eyes of one who looks for something are on what is beside the way every other time."""

import math

import msgspec
import pytest

from executive.skills.motions.body_access import Body
from executive.skills.motions.glances import NEAR_M, glance
from executive.skills.motions.survey import Prospect, Survey
from executive.skills.motions.walk import walk_near
from robot.messages import Look, Obstacle, Place, Shape
from robot.se3 import SE3
from tests.fakes.stage import Stage, distance_m

AWAY = SE3((9.0, 9.0, 0.0))


def shelf(y_m: float, *, x_m: float = 1.0, name: str = "shelf") -> Place:
    return Place(id=name, name=name, X_WP=SE3((x_m, y_m, 0.9)), size_m=(0.3, 0.3))


def wall(y_m: float, *, top_m: float = 2.0) -> Obstacle:
    shape = Shape(kind="box", size_m=(4.0, 0.1, top_m))
    return Obstacle(id="wall", name="wall", X_WO=SE3((1.0, y_m, 0.5 * top_m)), shapes=(shape,))


def standing(*obstacles: Obstacle) -> tuple[Stage, Body]:
    """A body at the origin that looks along x, and what stands about it."""
    stage = Stage()
    puppet = stage.puppet
    puppet.world_map = msgspec.structs.replace(puppet.world_map, obstacles=obstacles)
    puppet.X_WN = SE3()
    puppet.people["ann"] = AWAY
    puppet.tick()
    body = Body(stage.context)
    body.now_s = puppet.time_s
    return stage, body


@pytest.mark.parametrize(
    ("place", "obstacles", "shows"),
    [
        (shelf(1.2), (), True),
        (shelf(-1.2), (), True),
        (shelf(1.2), (wall(0.6),), False),
        (shelf(1.2), (wall(0.6, top_m=0.7),), True),
        (shelf(NEAR_M + 0.3, x_m=0.0), (), False),
        (shelf(0.6, x_m=-1.0), (), False),
    ],
    ids=["left", "right", "behind a wall", "over a low wall", "far", "behind the shoulder"],
)
def test_it_is_looked_at_what_shows_beside_the_way(place, obstacles, shows):
    _, body = standing(*obstacles)
    p_W = glance(body, Survey([Prospect(place=place)]))
    assert (p_W is not None) is shows
    if p_W is not None:
        assert math.dist(p_W, place.X_WP.p) < 0.3


def test_the_uprights_of_a_shelf_do_not_hide_what_is_on_it():
    shape = Shape(kind="box", size_m=(0.4, 0.4, 1.5))
    around = Obstacle(id="shelf", name="shelf", X_WO=SE3((1.0, 1.2, 0.75)), shapes=(shape,))
    _, body = standing(around)
    assert glance(body, Survey([Prospect(place=shelf(1.2))])) is not None


def test_of_two_sides_it_is_the_one_that_is_worth_more_then_the_other():
    _, body = standing()
    left, right = shelf(1.0, name="left"), shelf(-1.0, name="right")
    survey = Survey([Prospect(place=left), Prospect(place=right, worth=3.0)])
    first = glance(body, survey)
    assert first is not None
    assert first[1] < 0.0
    survey.give_up(survey.left[len(left.samples()) :])
    second = glance(body, survey)
    assert second is not None
    assert second[1] > 0.0
    survey.give_up(survey.left)
    assert glance(body, survey) is None


@pytest.mark.parametrize(("ann", "aside"), [(AWAY, True), (SE3((1.0, 2.0, 0.0)), False)])
def test_every_other_look_is_aside_where_nobody_is_about(ann, aside):
    stage, body = standing()
    stage.puppet.people["ann"] = ann
    there = (1.5, 1.5, 0.9)
    body.glance = lambda: there
    script = walk_near(body, (3.0, 0.0, 0.0))
    for _ in range(400):
        stage.puppet.tick()
        body.now_s = stage.puppet.time_s
        if next(script, "over") == "over":
            break
    looks = [distance_m(SE3(look.p_N), SE3(there)) < 1e-6 for look in stage.commands(Look)]
    assert len(looks) > 3
    assert looks[:4] == ([False, True] * 2 if aside else [False] * 4)
