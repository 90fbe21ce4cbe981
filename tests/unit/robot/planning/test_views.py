"""Views are planned with what stands in the way: of the eyes, and of the feet."""

import math

import numpy as np
import pytest

from robot.messages import Obstacle, Place, Shape, WorldMap
from robot.planning.requests import LookPlan, LookRequest, ObjectPose, Surroundings
from robot.planning.sight import Screens
from robot.planning.solids import solid
from robot.planning.solve import Solver
from robot.se3 import SE3
from tests.fakes.planning_room import block, shelf

HIGH_M = 2.2


def wall(name: str, x0: float, y0: float, x1: float, y1: float) -> Obstacle:
    """A wall from corner to corner of its rectangle."""
    size = (x1 - x0, y1 - y0, HIGH_M)
    return block(name, 0.5 * (x0 + x1), 0.5 * (y0 + y1), size)


def table(name: str, x: float, y: float) -> tuple[Obstacle, Place]:
    place = Place(id=name, name=name, X_WP=SE3((x, y, 0.75)), size_m=(0.5, 0.5), of=name)
    return block(name, x, y, (0.5, 0.5, 0.74)), place


def rack(name: str, x: float, y: float, yaw_rad: float) -> tuple[Obstacle, tuple[Place, ...]]:
    """A rack with a back and two boards below the eyes, open along its +x."""
    body, boards = shelf()
    X = SE3.from_xy_yaw(x, y, yaw_rad) @ body.X_WO.inverse()
    return (
        Obstacle(id=name, name=name, X_WO=X @ body.X_WO, shapes=body.shapes),
        tuple(
            Place(id=f"{name}_{i}", name=f"{name} {i}", X_WP=X @ b.X_WP, size_m=b.size_m, of=name)
            for i, b in enumerate(boards[:2])
        ),
    )


def map_of(*obstacles: Obstacle, bounds_m: tuple[float, float, float, float]) -> WorldMap:
    return WorldMap(
        stamp_s=0.0,
        name="map",
        obstacles=obstacles,
        places=(),
        objects=(),
        people=(),
        categories={},
        bounds_m=bounds_m,
    )


def look(
    solver: Solver,
    world_map: WorldMap,
    *places: Place,
    start: tuple[float, float, float],
    worth: dict[str, float] | None = None,
    stay: bool = False,
    things: tuple[ObjectPose, ...] = (),
    vain_m: tuple[float, float] | None = None,
) -> tuple[LookPlan, list[str], list[str]]:
    """The plan, and which places it shows and which it calls cut off."""
    points = [(place.id, tuple(p)) for place in places for p in place.samples().tolist()]
    plan = solver.solve(
        LookRequest(
            start=start,
            points_W=tuple(p for _, p in points),  # pyright: ignore[reportArgumentType]
            worth=tuple((worth or {}).get(name, 1.0) for name, _ in points),
            around=Surroundings(map=world_map, objects=things),
            stay=stay,
            vain_m=dict.fromkeys(range(len(points)), vain_m) if vain_m else {},
        )
    )
    assert isinstance(plan, LookPlan), plan
    named = [sorted({points[i][0] for i in rows}) for rows in (plan.sees, plan.cut_off)]
    return plan, *named


def test_a_wall_hides_what_is_behind_it_and_a_low_table_does_not() -> None:
    eyes = np.array([[0.0, 0.0, 1.1], [0.0, 0.5, 1.1]])
    point = np.array([1.5, 0.0, 0.8])
    thin = wall("wall", 0.7, -2.0, 0.78, 0.1)
    low, _ = table("table", 0.8, 0.0)
    for thing, seen in ((thin, [False, True]), (low, [True, True])):
        screens = Screens(tuple(solid(thing.id, thing.X_WO, s) for s in thing.shapes))
        assert screens.in_sight(point, eyes).tolist() == seen


def test_what_stands_behind_a_box_is_seen_from_another_side(solver: Solver) -> None:
    body, place = table("table", 1.2, 0.0)
    world_map = map_of(body, bounds_m=(-2.0, -2.0, 4.0, 2.0))
    behind = Place(id="behind", name="behind", X_WP=SE3((1.38, 0.0, 0.75)), size_m=(0.1, 0.1))
    box = ObjectPose(
        id="box", X_WO=SE3((1.2, 0.0, 0.9)), shape=Shape(kind="box", size_m=(0.1, 0.3, 0.3))
    )
    before, _, _ = look(solver, world_map, behind, start=(0.0, 0.0, 0.0))
    plan, sees, _ = look(solver, world_map, behind, start=(0.0, 0.0, 0.0), things=(box,))
    assert before.stance == (0.0, 0.0, 0.0)
    assert plan.stance is not None
    assert sees == ["behind"]
    eye = np.array([[*plan.stance[:2], 1.1]])
    screens = Screens((solid("box", box.X_WO, box.shape),))
    assert screens.in_sight(np.array([1.38, 0.0, 0.79]), eye).all()
    _, sees, _ = look(solver, world_map, place, start=(0.0, 0.0, 0.0), things=(box,))
    assert sees == ["table"]  # what is under the box is seen by seeing the box


@pytest.mark.parametrize("start", [(1.0, 1.2, 0.0), (2.4, 0.9, -0.5), (4.4, 0.6, 2.0)])
def test_what_did_not_show_is_looked_at_from_elsewhere(
    solver: Solver, start: tuple[float, float, float]
) -> None:
    body, boards = rack("rack", 3.0, 0.16, math.pi / 2)
    world_map = map_of(body, bounds_m=(0.0, -0.2, 6.0, 2.5))
    first, seen, _ = look(solver, world_map, *boards, start=start)
    assert first.stance is not None
    at = first.stance[:2]
    again, sees, _ = look(solver, world_map, *boards, start=first.stance, vain_m=at)
    assert again.stance is not None
    assert math.dist(again.stance[:2], at) > 0.25
    assert seen
    assert sees


def test_a_view_that_is_the_only_one_is_tried_again(solver: Solver) -> None:
    body, place = table("table", 1.2, 0.0)
    room = (wall("left", -0.4, 0.35, 1.6, 0.43), wall("right", -0.4, -0.43, 1.6, -0.35))
    world_map = map_of(body, *room, bounds_m=(0.3, -0.35, 1.5, 0.35))
    first, seen, _ = look(solver, world_map, place, start=(0.6, 0.0, 0.0))
    assert first.stance is not None
    again, sees, _ = look(
        solver, world_map, place, start=first.stance, vain_m=first.stance[:2], stay=True
    )
    assert again.stance == pytest.approx(first.stance)
    assert sees == seen == ["table"]


def test_racks_that_stand_back_to_back_are_seen_from_their_own_aisles(solver: Solver) -> None:
    front, front_boards = rack("front", 3.0, 0.16, math.pi / 2)
    back, back_boards = rack("back", 3.0, -0.16, -math.pi / 2)
    world_map = map_of(front, back, bounds_m=(0.0, -2.5, 6.0, 2.5))
    boards = (*front_boards, *back_boards)
    plan, sees, _ = look(solver, world_map, *boards, start=(1.0, 1.2, 0.0))
    assert plan.stance is not None
    assert plan.stance[1] > 0.3
    assert sees == [place.id for place in front_boards]
    plan, sees, _ = look(solver, world_map, *boards, start=(1.0, -1.2, 0.0))
    assert plan.stance is not None
    assert plan.stance[1] < -0.3
    assert sees == [place.id for place in back_boards]


def test_what_is_near_through_a_wall_is_far_on_foot(solver: Solver) -> None:
    """The nearer table by the straight line is in the next room, whose door is far away."""
    behind, behind_place = table("behind", 1.0, 1.6)
    along, along_place = table("along", 4.0, -0.4)
    walls = (wall("wall", -1.0, 0.9, 5.0, 1.0), wall("end", -1.0, 0.0, -0.9, 3.0))
    world_map = map_of(behind, along, *walls, bounds_m=(-1.0, -2.0, 6.0, 3.0))
    places = (behind_place, along_place)
    plan, sees, cut_off = look(solver, world_map, *places, start=(0.5, -0.5, math.pi))
    assert sees == ["along"]
    assert cut_off == []
    plan, sees, _ = look(solver, world_map, behind_place, start=(0.5, -0.5, 0.0))
    assert sees == ["behind"]
    assert plan.length_m > 6.0


def test_a_room_without_a_door_is_cut_off(solver: Solver) -> None:
    inside, place = table("inside", 3.0, 0.0)
    walls = (wall("wall", 1.9, -1.5, 2.0, 1.5),)
    world_map = map_of(inside, *walls, bounds_m=(-1.0, -1.5, 4.0, 1.5))
    plan, _, cut_off = look(solver, world_map, place, start=(0.0, 0.0, 0.0))
    assert plan.stance is None
    assert cut_off == ["inside"]


def test_a_likely_place_is_worth_a_longer_way(solver: Solver) -> None:
    near, near_place = table("near", -2.5, 0.0)
    far, far_place = table("far", 4.0, 0.0)
    world_map = map_of(near, far, bounds_m=(-4.0, -2.0, 5.0, 2.0))
    places, start = (near_place, far_place), (0.0, 0.0, 0.0)
    assert look(solver, world_map, *places, start=start)[1] == ["near"]
    assert look(solver, world_map, *places, start=start, worth={"far": 6.0})[1] == ["far"]


def test_what_is_in_view_from_here_is_looked_at_without_a_step(solver: Solver) -> None:
    ahead, place = table("ahead", 1.2, 0.3)
    world_map = map_of(ahead, bounds_m=(-2.0, -2.0, 3.0, 2.0))
    plan, sees, _ = look(solver, world_map, place, start=(0.0, 0.0, 0.0))
    assert plan.stance == (0.0, 0.0, 0.0)
    assert plan.length_m == 0.0
    assert sees == ["ahead"]
    assert plan.gazes_W


def test_what_is_behind_is_turned_to_and_with_stay_nothing_is_walked_to(solver: Solver) -> None:
    behind, place = table("behind", -1.2, 0.0)
    far, far_place = table("far", 4.0, 0.0)
    world_map = map_of(behind, far, bounds_m=(-3.0, -2.0, 5.0, 2.0))
    plan, sees, _ = look(solver, world_map, place, far_place, start=(0.0, 0.0, 0.0), stay=True)
    assert plan.stance is not None
    assert plan.stance[:2] == (0.0, 0.0)
    assert abs(plan.stance[2]) > 2.0
    assert sees == ["behind"]
    plan, _, _ = look(solver, world_map, far_place, start=(0.0, 0.0, 0.0), stay=True)
    assert plan.stance is None


def test_one_does_not_stand_in_furniture_or_walls(solver: Solver) -> None:
    body, boards = rack("rack", 2.5, 0.0, math.pi)
    world_map = map_of(body, wall("wall", 0.2, -2.0, 0.3, 2.0), bounds_m=(-2.0, -2.0, 3.0, 2.0))
    plan, _, _ = look(solver, world_map, *boards, start=(1.0, 1.2, 0.0))
    assert plan.stance is not None
    radius_m = solver.body.description.body_radius_m
    assert 0.3 + radius_m <= plan.stance[0] <= 2.5 - 0.15 - radius_m


@pytest.mark.parametrize("z_m", [0.3, 0.75, 1.0])
def test_the_eyes_rest_on_points_that_are_to_be_seen(solver: Solver, z_m: float) -> None:
    place = Place(id="top", name="top", X_WP=SE3((2.0, 0.0, z_m)), size_m=(0.6, 1.6), of="top")
    world_map = map_of(block("top", 2.0, 0.0, (0.6, 1.6, z_m)), bounds_m=(-2, -2, 4, 2))
    plan, _, _ = look(solver, world_map, place, start=(0.0, 0.0, 0.0))
    samples = [tuple(p) for p in place.samples().tolist()]
    assert set(plan.gazes_W) <= {samples[i] for i in plan.sees}


def test_a_counter_at_the_height_of_the_eyes_is_seen(solver: Solver) -> None:
    place = Place(id="bar", name="bar", X_WP=SE3((2.0, 0.0, 1.1)), size_m=(0.9, 1.4), of="bar")
    world_map = map_of(block("bar", 2.0, 0.0, (0.9, 1.4, 1.1)), bounds_m=(-2, -2, 4, 2))
    plan, sees, _ = look(solver, world_map, place, start=(0.0, 0.0, 0.0))
    assert plan.stance is not None
    assert sees == ["bar"]


def test_what_did_not_show_from_afar_is_looked_at_from_nearer(solver: Solver) -> None:
    """A thing that is too small from 1.6 m is so from a step aside as well."""
    body, place = table("table", 3.0, 0.0)
    world_map = map_of(body, bounds_m=(-0.5, -2.5, 6.0, 2.5))
    spot = Place(id="spot", name="spot", X_WP=place.X_WP, size_m=(0.1, 0.1))
    middle = spot.X_WP.p[:2]
    vain = (middle[0] - 1.7, middle[1])
    plan, sees, _ = look(solver, world_map, spot, start=(*vain, 0.0), vain_m=vain)
    assert plan.stance is not None
    assert sees == ["spot"]
    assert math.dist(plan.stance[:2], middle) < 1.35
