"""Where to stand: before surfaces facing them, around people, where there is room."""

import math

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from executive.skills.motions.body_access import Body
from executive.skills.motions.standpoints import (
    has_room,
    stances_around,
    stances_at,
    stances_before,
)
from executive.skills.navigate import NavigateParams
from robot.messages import Obstacle, Place, Shape
from robot.planning.requests import BasePath, BasePathRequest
from robot.se3 import SE3, wrap_angle
from tests.fakes.stage import Stage

coordinate = st.floats(-5.0, 5.0)
angle = st.floats(-math.pi, math.pi)


@given(coordinate, coordinate, angle, st.floats(0.2, 2.0), st.floats(0.2, 2.0))
def test_at_a_surface_one_stands_before_an_edge_and_faces_it(x, y, yaw, size_x, size_y):
    X_WP = SE3.from_xy_yaw(x, y, yaw, z_m=0.7)
    place = Place(id="desk", name="desk", X_WP=X_WP, size_m=(size_x, size_y))
    stances = stances_at(place, SE3(), before_edge_m=0.4)
    assert len(stances) == 4
    for stance in stances:
        px, py, _ = X_WP.inverse().apply((stance[0], stance[1], 0.7))
        outside = (abs(px) - size_x / 2, abs(py) - size_y / 2)
        assert max(outside) == pytest.approx(0.4)
        bearing = math.atan2(y - stance[1], x - stance[0])
        assert abs(wrap_angle(bearing - stance[2])) < 1e-6
    away = [math.dist(stance[:2], (0.0, 0.0)) for stance in stances]
    assert away == sorted(away)


@given(coordinate, coordinate, coordinate, coordinate, st.floats(0.5, 2.0))
def test_around_a_person_one_faces_them_at_a_distance(px, py, x, y, distance):
    stances = stances_around((px, py, 0.0), SE3((x, y, 0.0)), distance_m=distance)
    for stance in stances:
        assert math.dist(stance[:2], (px, py)) == pytest.approx(distance)
        bearing = math.atan2(py - stance[1], px - stance[0])
        assert abs(wrap_angle(bearing - stance[2])) < 1e-6


def walled_in():
    """The test kitchen with a wall close to the table's near side."""
    stage = Stage()
    shape = Shape(kind="box", size_m=(0.1, 4.0, 2.0))
    wall = Obstacle(id="wall", name="wall", X_WO=SE3((1.05, 0.0, 1.0)), shapes=(shape,))
    world_map = msgspec.structs.replace(stage.puppet.world_map, obstacles=(wall,))
    stage.puppet.world_map = world_map
    return stage


def test_room_is_measured_to_the_nearest_outline():
    body = Body(walled_in().context)
    assert not has_room(body, (1.3, 0.0, 0.0))
    assert has_room(body, (1.5, 0.0, 0.0))


def test_a_narrow_side_is_left_for_a_roomy_one():
    stage = walled_in()
    assert stage.run(NavigateParams(place_id="table")).status == "succeeded"
    assert math.dist(stage.puppet.X_WS.p[:2], (1.3, 0.0)) > 0.5


def test_in_a_room_one_stands_where_there_is_room_however_far_from_its_middle():
    stage = Stage()
    shape = Shape(kind="box", size_m=(2.4, 2.4, 0.7))
    desk = Obstacle(id="desk", name="desk", X_WO=SE3((0.0, -2.0, 0.35)), shapes=(shape,))
    hall = Place(id="hall", name="hall", X_WP=SE3((0.0, -2.0, 0.0)), size_m=(5.0, 5.0), floor=True)
    world_map = stage.puppet.world_map
    stage.puppet.world_map = msgspec.structs.replace(
        world_map, obstacles=(desk,), places=(*world_map.places, hall)
    )
    assert stage.run(NavigateParams(place_id="hall")).status == "succeeded"
    x_m, y_m, _ = stage.puppet.X_WS.p
    assert has_room(Body(stage.context), (x_m, y_m, 0.0))
    assert max(abs(x_m), abs(y_m + 2.0)) <= 2.5, "in the room"


def test_a_place_that_a_narrow_way_leads_to_is_left_for_one_with_a_wide_way():
    stage = Stage()
    hall = Place(id="hall", name="hall", X_WP=SE3((0.0, 0.0, 0.0)), size_m=(5.0, 5.0), floor=True)
    world_map = stage.puppet.world_map
    stage.puppet.world_map = msgspec.structs.replace(world_map, places=(*world_map.places, hall))

    def path(request: BasePathRequest) -> BasePath:
        """A gap leads to everything on this side of the room."""
        (x, y, _), clear_m = request.start, 0.29 if request.goal[1] < 1.0 else 0.5
        return BasePath(
            waypoints=((x, y, 0.0), (*request.goal[:2], 0.0), request.goal),
            length_m=math.dist((x, y), request.goal[:2]),
            clearance_m=clear_m,
            clearances_m=(0.5, clear_m, 0.5),
        )

    stage.planner.path = path
    assert stage.run(NavigateParams(place_id="hall")).status == "succeeded"
    assert stage.puppet.X_WS.p[1] > 0.95
    asked = [r.goal for r in stage.planner.requests if isinstance(r, BasePathRequest)]
    assert len(asked) <= 6, "what is beside a place with a narrow way is not tried"


@pytest.mark.parametrize(("height_m", "through"), [(2.0, False), (0.7, True)])
def test_nobody_is_served_through_a_wall_and_anybody_over_a_table(height_m, through):
    stage = Stage()
    shape = Shape(kind="box", size_m=(4.0, 0.1, height_m))
    screen = Obstacle(
        id="screen", name="screen", X_WO=SE3((0.0, 2.4, height_m / 2)), shapes=(shape,)
    )
    stage.puppet.world_map = msgspec.structs.replace(stage.puppet.world_map, obstacles=(screen,))
    ann = stage.puppet.world_map.people[0]
    stances = stances_before(Body(stage.context), ann, distance_m=1.0)
    assert stances
    assert any(y < 2.4 for _, y, _ in stances) == through


def test_before_somebody_between_a_doorway_and_a_sofa_there_is_somewhere_with_room():
    """As it was where the torso touched the jamb: walls x0, y0, x1, y1 and the sofa [m]."""
    boxes = [(-3.2, -2.08, 0.72, -2.0), (1.68, -2.08, 3.2, -2.0), (-0.08, -4.1, 0.0, -2.0),
             (0.2, -4.05, 1.8, -3.25)]  # fmt: skip
    things = tuple(
        Obstacle(
            id=f"box_{n}",
            name="box",
            X_WO=SE3((0.5 * (x0 + x1), 0.5 * (y0 + y1), 1.0)),
            shapes=(Shape(kind="box", size_m=(x1 - x0, y1 - y0, 2.0)),),
        )
        for n, (x0, y0, x1, y1) in enumerate(boxes)
    )
    stage = Stage()
    ann = msgspec.structs.replace(stage.puppet.world_map.people[0], X_WO=SE3((0.45, -2.7, 0.0)))
    stage.puppet.world_map = msgspec.structs.replace(
        stage.puppet.world_map, obstacles=things, people=(ann,)
    )
    stage.puppet.people["ann"] = ann.X_WO
    stage.puppet.X_WS = SE3.from_xy_yaw(1.5, -0.3, math.pi)
    body = Body(stage.context)
    assert any(has_room(body, one) for one in stances_before(body, ann, distance_m=1.25))
