"""Distances on the floor are those of the outlines."""

import math

import numpy as np
import pytest

from robot.planning import floor_field
from robot.planning.floor import Floor
from robot.planning.floor_ways import FloorWays
from robot.planning.solids import Solid
from robot.se3 import SE3

BOUNDS = (-3.0, -3.0, 3.0, 3.0)


def box(yaw: float = 0.0, z: float = 0.5) -> Solid:
    X_WG = SE3.from_xy_yaw(1.0, 0.0, yaw, z_m=z)
    return Solid(id="box", kind="box", size_m=(1.0, 0.4, 0.2), X_WG=X_WG)


@pytest.mark.parametrize(
    ("x", "y", "distance"), [(0.0, 0.0, 0.5), (1.0, 1.0, 0.8), (1.0, 0.0, -0.2), (0.2, 0.6, 0.5)]
)
def test_distance_to_a_box(x: float, y: float, distance: float) -> None:
    floor = Floor((box(),), BOUNDS)
    assert floor.clearance_m(x, y) == pytest.approx(distance, abs=0.015)


def test_a_turned_box_is_a_turned_rectangle() -> None:
    floor = Floor((box(math.pi / 2),), BOUNDS)
    assert floor.clearance_m(1.0, 1.0) == pytest.approx(0.5, abs=0.015)
    assert floor.clearance_m(0.3, 0.0) == pytest.approx(0.5, abs=0.015)


def test_a_cylinder_is_a_circle() -> None:
    post = Solid(id="post", kind="cylinder", size_m=(0.5, 0.5, 1.0), X_WG=SE3((0.0, 0.0, 0.5)))
    floor = Floor((post,), BOUNDS)
    for angle in np.linspace(0, 6, 7):
        assert floor.clearance_m(math.cos(angle), math.sin(angle)) == pytest.approx(0.75, abs=0.02)


def test_a_lamp_overhead_is_walked_under() -> None:
    assert Floor((box(z=2.0),), BOUNDS).clearance_m(1.0, 0.0) > 1.0


def test_outside_of_the_bounds_nothing_is_free() -> None:
    floor = Floor((), BOUNDS)
    assert floor.clearance_m(3.5, 0.0) < 0.0
    assert floor.clearance_m(2.9, 0.0) == pytest.approx(0.1, abs=0.01)


def test_one_and_many_points_agree() -> None:
    floor = Floor((box(0.4),), BOUNDS)
    xy = np.random.default_rng(0).uniform(-2.8, 2.8, (50, 2))
    assert np.allclose(floor.clearances_m(xy), [floor.clearance_m(x, y) for x, y in xy])


def test_the_nearest_is_named() -> None:
    assert Floor((box(),), BOUNDS).nearest(0.4, 0.0) == ("box", pytest.approx(0.1))
    assert Floor((), BOUNDS).nearest(2.5, 0.0)[0] == "the edge of the map"


def test_what_lies_on_a_table_changes_nothing() -> None:
    cup = Solid(
        id="cup", kind="cylinder", size_m=(0.08, 0.08, 0.1), X_WG=SE3((1.1, 0.05, 0.65))
    )  # fmt: skip
    bare, laid = Floor((box(0.4),), BOUNDS), Floor((box(0.4), cup), BOUNDS)
    assert np.array_equal(bare.field, laid.field)
    assert laid.solids == (box(0.4), cup)


def test_distances_are_those_to_the_nearest_of_all_solids() -> None:
    """Whatever is left out or measured in part only: large and small, within others, outside."""
    rng = np.random.default_rng(3)

    def solid(number: int) -> Solid:
        sides = (2.5, 1.8, 0.5, 0.1)[number % 4] * rng.uniform(0.6, 1.0, 2)
        x, y, yaw = rng.uniform(-3.5, 3.5, 3).tolist()
        return Solid(
            id=str(number), kind="cylinder" if number % 5 == 0 else "box",
            size_m=(*sides.tolist(), 0.4), X_WG=SE3.from_xy_yaw(x, y, yaw, z_m=0.4),
        )  # fmt: skip

    cells = np.array([[0, 0], [70, 3], [75, 75], [20, 140], [150, 150], [100, 40]])
    for _ in range(5):
        solids = tuple(solid(number) for number in range(12))
        floor = Floor(solids, BOUNDS)
        for cell, (x, y) in zip(cells.tolist(), floor.points(cells).tolist(), strict=True):
            edge = min(x + 3.0, 3.0 - x, y + 3.0, 3.0 - y)
            nearest = min([edge, *(Floor.distance_m(one, x, y) for one in solids)])
            assert floor.field[*cell] == pytest.approx(nearest, abs=1e-9)


def tables(side: int) -> tuple[Solid, ...]:
    """So many times so many of them, one every 3 m."""
    return tuple(
        Solid(
            id=f"t{row}-{column}", kind="box", size_m=(1.6, 0.8, 0.7),
            X_WG=SE3.from_xy_yaw(3.0 * column, 3.0 * row, 0.3 * row, z_m=0.35),
        )
        for row in range(side) for column in range(side)
    )  # fmt: skip


def test_a_hall_of_tables_costs_by_its_area_however_many_there_are(monkeypatch) -> None:
    """Every table was measured all over the hall: minutes, and gigabytes."""
    points: list[int] = []
    signed = floor_field.signed

    def counted(solid: Solid, xs, ys):
        found = signed(solid, xs, ys)
        points.append(found.size)
        return found

    monkeypatch.setattr(floor_field, "signed", counted)
    each: list[float] = []
    for side in (4, 12):
        points.clear()
        floor = Floor(tables(side), (-2.0, -2.0, 3.0 * side, 3.0 * side))
        each.append(sum(points) / floor.field.size)
    assert each[1] < 8
    assert each[1] < 1.5 * each[0]
    points.clear()
    Floor((*tables(12)[:-1],), (-2.0, -2.0, 36.0, 36.0))  # what stands as it did is not measured
    assert sum(points) < 0.1 * floor.field.size


def test_a_way_in_a_hall_is_the_same_when_it_is_searched_piece_by_piece(monkeypatch) -> None:
    floor = Floor(tables(8), (-2.0, -2.0, 24.0, 24.0))
    goals = np.random.default_rng(1).uniform(-1.0, 23.0, (40, 2))
    start = np.array([1.5, 1.5])
    whole = FloorWays(floor, start, least_m=0.25, wanted_m=0.5)
    known = [(whole.cost(goal), whole.corners(goal)) for goal in goals]
    monkeypatch.setattr("robot.planning.floor_ways.AROUND_NODES", 20)
    for goal, (cost, corners) in zip(goals, known, strict=True):
        ways = FloorWays(floor, start, least_m=0.25, wanted_m=0.5)
        assert ways.cost(goal) == pytest.approx(cost)
        assert np.array_equal(ways.corners(goal), corners)
