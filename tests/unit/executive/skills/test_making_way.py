"""Stepping back from who stands in the way: not past what an arm or a load would meet."""

import math

import msgspec
import pytest

from executive.skills.motions.back_away import make_way
from executive.skills.motions.body_access import Body
from executive.skills.motions.obstructions import clearance_m
from robot.messages import Obstacle, Shape, WalkTo
from robot.se3 import SE3
from tests.fakes.stage import Stage

ANN = SE3((-0.55, 0.20, 0.0))
"""Behind the robot at the origin, to the left: straight away from her is ahead, to the right."""


def steps_back(*things: Obstacle) -> tuple[bool, SE3 | None]:
    """Whether it made way for Ann, and where to."""
    stage = Stage()
    puppet = stage.puppet
    puppet.world_map = msgspec.structs.replace(puppet.world_map, obstacles=things)
    puppet.people["ann"] = ANN
    body = Body(stage.context)
    puppet.tick()
    body.now_s = puppet.time_s
    script = make_way(body, body.person("ann"))
    for _ in range(600):
        body.now_s = puppet.time_s
        try:
            next(script)
        except StopIteration as end:
            sent = stage.commands(WalkTo)
            goal = None
            if sent:
                X_NS = SE3.from_xy_yaw(sent[-1].x_m, sent[-1].y_m, sent[-1].yaw_rad)
                goal = puppet.X_WN @ X_NS
            return end.value, goal
        puppet.tick()
    raise AssertionError("it does not end")


def cabinet(x_m: float, y_m: float, size_m: tuple[float, float]) -> Obstacle:
    shape = Shape(kind="box", size_m=(*size_m, 1.4))
    return Obstacle(id="cabinet", name="cabinet", X_WO=SE3((x_m, y_m, 0.7)), shapes=(shape,))


def test_it_steps_straight_away_where_there_is_room():
    made, goal = steps_back()
    assert made
    assert goal is not None
    assert goal.p[0] > 0.4
    assert goal.p[1] < -0.1


def test_it_does_not_step_aside_along_what_stands_beside_it():
    """Its steps aside come first: an upper arm met the cabinet's corner on the way."""
    beside = cabinet(-0.35, -0.63, (0.92, 0.34))
    made, goal = steps_back(beside)
    assert made, "there is room straight ahead"
    assert goal is not None
    assert clearance_m((0.0, goal.p[1]), beside) >= 0.43 - 1e-6, "where its steps aside lead"
    assert math.dist(goal.p[:2], ANN.p[:2]) > 0.85


@pytest.mark.parametrize("half_m", [0.40, 0.33])
def test_in_a_doorway_it_steps_straight_out_of_it(half_m):
    """Narrower than the room that it has at the end; no narrower than where it stands."""
    jamb = cabinet(-0.5, -half_m - 0.1, (1.0, 0.2))
    made, goal = steps_back(jamb)
    assert made
    assert goal is not None
    assert goal.p[1] >= -1e-6
