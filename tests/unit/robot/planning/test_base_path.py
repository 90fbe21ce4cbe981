"""Base paths are free, end at the goal, are repeated; failures name the cause."""

import math
from itertools import pairwise

import msgspec
import numpy as np
import pytest

from robot.failures import Failure
from robot.messages import PersonInfo, Track, WorldState
from robot.planning.floor import Floor
from robot.planning.requests import BasePath, BasePathRequest, Stance, Surroundings
from robot.planning.solids import solids_of
from robot.planning.solve import Solver
from robot.se3 import SE3, wrap_angle
from tests.fakes.planning_room import START, block, room, surroundings

BEFORE_TABLE = (1.05, 0.8, 0.0)
BEFORE_SHELF = (2.95, -1.2, 0.0)


def path(solver: Solver, start: Stance, goal: Stance, *, more=()) -> BasePath | Failure:
    around = surroundings(more=more)
    answer = solver.solve(BasePathRequest(start=start, goal=goal, around=around))
    assert isinstance(answer, BasePath | Failure)
    return answer


@pytest.mark.parametrize("goal", [BEFORE_TABLE, BEFORE_SHELF, (-1.0, -2.0, 3.0)])
def test_a_path_is_free_and_ends_at_the_goal(solver: Solver, goal: Stance) -> None:
    found = path(solver, START, goal)
    assert isinstance(found, BasePath)
    assert found.waypoints[-1] == pytest.approx(goal)
    floor = Floor(solids_of(surroundings()), surroundings().map.bounds_m)
    stops = [START, *found.waypoints]
    radius = solver.body.description.body_radius_m
    for a, b in pairwise(stops[:-1]):
        assert floor.segment_clearance_m(a[:2], b[:2]) >= radius - 0.02
    length = sum(math.dist(a[:2], b[:2]) for a, b in pairwise(stops))
    assert found.length_m == pytest.approx(length)


def test_the_last_steps_to_a_table_are_straight_ahead(solver: Solver) -> None:
    found = path(solver, START, BEFORE_TABLE)
    assert isinstance(found, BasePath)
    (x0, y0, yaw0), (x1, y1, yaw1) = found.waypoints[-2:]
    assert yaw0 == yaw1 == 0.0
    assert y0 == pytest.approx(y1)
    assert 0.05 < x1 - x0 < 0.8


def test_one_walks_forward_on_long_ways(solver: Solver) -> None:
    found = path(solver, START, BEFORE_SHELF)
    assert isinstance(found, BasePath)
    stops = [START, *found.waypoints]
    for a, b in pairwise(stops):
        if math.dist(a[:2], b[:2]) > 0.1:
            heading = math.atan2(b[1] - a[1], b[0] - a[0])
            assert abs(wrap_angle(heading - b[2])) < 0.6


def test_backing_off_keeps_the_heading(solver: Solver) -> None:
    found = path(solver, BEFORE_TABLE, (0.75, 0.8, 0.0))
    assert isinstance(found, BasePath)
    assert found.waypoints == ((0.75, 0.8, 0.0),)


def test_a_path_is_not_much_longer_than_it_must_be(solver: Solver) -> None:
    found = path(solver, START, BEFORE_SHELF)
    assert isinstance(found, BasePath)
    assert found.length_m < 1.15 * math.dist(START[:2], BEFORE_SHELF[:2])


def test_the_same_request_gives_the_same_path(solver: Solver) -> None:
    first = path(solver, START, BEFORE_SHELF)
    path(solver, START, BEFORE_TABLE)
    assert path(solver, START, BEFORE_SHELF) == first


def test_a_goal_inside_furniture_is_refused_by_name(solver: Solver) -> None:
    found = path(solver, START, (1.5, 0.8, 0.0))
    assert isinstance(found, Failure)
    assert (found.code, found.evidence["blocked_by"]) == ("goal_in_collision", "table")


def test_a_start_inside_furniture_is_refused_by_name(solver: Solver) -> None:
    found = path(solver, (0.8, -0.8, 0.0), START)
    assert isinstance(found, Failure)
    assert (found.code, found.evidence["blocked_by"]) == ("start_in_collision", "chair")


@pytest.mark.parametrize("beyond_m", [-0.1, 0.0, 0.5])
def test_one_who_got_up_beyond_the_edge_of_the_map_comes_back(
    solver: Solver, beyond_m: float
) -> None:
    inside = surroundings()
    furniture = tuple(one for one in inside.map.obstacles if "wall" not in one.name)
    open_map = msgspec.structs.replace(inside.map, obstacles=furniture)
    around = msgspec.structs.replace(inside, map=open_map)
    x0, y0, x1, _ = open_map.bounds_m
    for start in ((x0 - beyond_m, 0.0, 0.0), (0.5, y0 - beyond_m, 2.5), (x1 + 0.1, y0 - 0.1, 3.0)):
        found = solver.solve(BasePathRequest(start=start, goal=BEFORE_TABLE, around=around))
        assert isinstance(found, BasePath), found
        assert found.waypoints[-1] == pytest.approx(BEFORE_TABLE)


def test_a_wall_across_the_room_is_named(solver: Solver) -> None:
    found = path(solver, START, BEFORE_SHELF, more=(block("bar", 2.3, 0.0, (0.1, 6.0, 1.0)),))
    assert isinstance(found, Failure)
    assert (found.code, found.evidence["blocked_by"]) == ("no_path", "bar")


def test_a_gap_too_narrow_is_measured_and_named(solver: Solver) -> None:
    bars = (
        block("left bar", 2.3, 1.65, (0.1, 2.9, 1.0)),
        block("right bar", 2.3, -1.6, (0.1, 2.9, 1.0)),
    )
    found = path(solver, START, BEFORE_SHELF, more=bars)
    assert isinstance(found, Failure)
    assert found.code == "no_path"
    assert found.evidence["gap_m"] == pytest.approx(0.35, abs=0.06)
    assert set(str(found.evidence["blocked_by"]).split(", ")) == {"left bar", "right bar"}


@pytest.mark.parametrize("at_y_m", [-2.2, -1.3, -0.6])
def test_a_doorway_is_passed_in_its_middle_and_elsewhere_there_is_room(
    solver: Solver, at_y_m: float
) -> None:
    wide_m, least_m, most_m = 0.8, -3.0, 3.0
    low, high = at_y_m - wide_m / 2, at_y_m + wide_m / 2
    bars = (
        block("left bar", 2.0, (high + most_m) / 2, (0.1, most_m - high, 1.0)),
        block("right bar", 2.0, (low + least_m) / 2, (0.1, low - least_m, 1.0)),
    )
    around = surroundings(more=bars)
    request = BasePathRequest(start=START, goal=BEFORE_SHELF, around=around, clearance_m=0.16)
    found = solver.solve(request)
    assert isinstance(found, BasePath)
    stops = np.array([START[:2], *(stop[:2] for stop in found.waypoints)])
    through = np.interp(2.0, stops[:, 0], stops[:, 1])
    assert through == pytest.approx(at_y_m, abs=0.06)
    narrow = [clear_m < 0.33 for clear_m in found.clearances_m[:-1]]
    assert len(found.clearances_m) == len(found.waypoints)
    assert not any(narrow)


def test_who_has_just_come_through_a_doorway_does_not_go_back_through_it_for_more_room(
    solver: Solver,
) -> None:
    bars = (
        block("left bar", 2.0, 1.31, (0.1, 3.38, 1.0)),
        block("right bar", 2.0, -2.11, (0.1, 1.78, 1.0)),
    )
    somebody = PersonInfo(id="ada", name="Ada", X_WO=SE3((2.97, -0.7, 0.0)), radius_m=0.37)
    around = surroundings(more=bars)
    around = msgspec.structs.replace(
        around, map=msgspec.structs.replace(around.map, people=(somebody,))
    )
    request = BasePathRequest(
        start=(2.30, -1.0, -0.83), goal=(2.6, -2.3, 0.0), around=around, clearance_m=0.16
    )
    found = solver.solve(request)
    assert isinstance(found, BasePath)
    assert min(x for x, _, _ in found.waypoints) > 2.05


def test_a_gap_between_things_is_taken_only_if_the_way_round_is_long(solver: Solver) -> None:
    def way(*bars):
        request = BasePathRequest(
            start=(-1.0, -0.2, 0.0), goal=(-1.0, -2.2, 0.0), around=surroundings(more=bars),
            clearance_m=0.16,
        )  # fmt: skip
        found = solver.solve(request)
        assert isinstance(found, BasePath)
        return found

    def gap(length_m):
        """A bar across, with a gap of 0.56 m straight ahead, open at its right end."""
        far = -0.72 + length_m
        return (
            block("near bar", -1.88, -1.2, (1.2, 0.1, 1.0)),
            block("far bar", (far - 0.72) / 2, -1.2, (length_m, 0.1, 1.0)),
        )

    assert way(*gap(0.5)).clearance_m > 0.35
    assert way(*gap(2.6)).clearance_m < 0.30


def test_waypoints_are_near_enough_to_follow(solver: Solver) -> None:
    found = path(solver, START, BEFORE_SHELF)
    assert isinstance(found, BasePath)
    gaps = np.linalg.norm(np.diff([w[:2] for w in found.waypoints], axis=0), axis=1)
    assert gaps.max() < 0.8


def test_people_are_kept_clear_of_where_they_were_seen_and_not_where_they_began() -> None:
    ann = PersonInfo(id="ann", name="Ann", X_WO=SE3((0.0, 2.0, 0.0)))
    outline = block("ann", 0.0, 2.0, (0.5, 0.5, 1.7))
    began = msgspec.structs.replace(room(outline), people=(ann,))

    def around(**track) -> tuple[str, ...]:
        seen = Track(id="ann", **track)
        world = WorldState(
            stamp_s=1.0, X_WN=SE3(), X_WB=SE3(), fix_age_s=0.0, tracks=(), people=(seen,)
        )
        solids = solids_of(Surroundings.of(began, world))
        return tuple(f"{s.X_WG.p[0]:.0f} {s.X_WG.p[1]:.0f}" for s in solids if s.id == "ann")

    assert around(X_WO=SE3((2.0, 1.0, 0.0)), seen_s=1.0) == ("2 1",)
    assert around(X_WO=SE3((0.0, 2.0, 0.0)), seen_s=-math.inf) == ("0 2",)
    assert around(X_WO=SE3((2.0, 1.0, 0.0)), seen_s=0.0, missing=True) == ()
