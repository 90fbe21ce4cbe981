"""Where on a place a thing is put down: free, as wanted, as high as it may be."""

import math

import msgspec
import numpy as np
import pytest

from robot.failures import Failure
from robot.messages import Shape
from robot.planning.requests import (
    Held,
    PickPlan,
    PlacePlan,
)
from robot.planning.solve import Solver
from robot.se3 import SE3
from tests.fakes.handling_plans import BOARD, TABLE, check_standing, pick, place
from tests.fakes.planning_room import (
    BOARDS_M,
    held_cup,
    on_table,
    surroundings,
)


@pytest.mark.parametrize("y", [-0.3, 0.0, 0.3])
def test_of_a_place_only_the_spots_that_were_asked_for(solver: Solver, y: float) -> None:
    on = [TABLE.X_WP.apply((0.02 * n, y, 0.0)) for n in range(-4, 5)]
    spots = tuple((float(p[0]), float(p[1])) for p in on)
    plan = place(solver, TABLE, surroundings(), spots=spots)
    assert isinstance(plan, PlacePlan), plan
    assert min(math.dist(plan.X_WO.p[:2], spot) for spot in spots) < 1e-6


def test_spots_that_are_all_off_the_place_are_none(solver: Solver) -> None:
    off = TABLE.X_WP.apply((5.0, 0.0, 0.0))
    plan = place(solver, TABLE, surroundings(), spots=((float(off[0]), float(off[1])),))
    assert isinstance(plan, Failure)
    assert plan.code == "no_free_spot"
    assert "where it is wanted" in plan.cause


@pytest.mark.parametrize("lower_m", [0.0, 0.004, 0.008])
def test_what_lies_flat_is_put_down_though_the_hand_was_lower_than_meant(
    solver: Solver, lower_m: float
) -> None:
    """A hand is a few millimetres off, and its fingertips had eight above the table."""
    flat = Shape(kind="box", size_m=(0.07, 0.14, 0.03))
    thing = on_table(-0.1, 0.2, shape=flat)
    taken = pick(solver, surroundings(thing))
    assert isinstance(taken, PickPlan)
    higher = SE3((0.0, 0.0, lower_m)) @ thing.X_WO  # than it is, seen from that hand
    held = Held(id="cup", shape=flat, X_GO=taken.X_WG_grasp.inverse() @ higher)
    plan = place(solver, TABLE, surroundings(), held=held, side=taken.side)
    assert isinstance(plan, PlacePlan), plan
    foot_m = plan.X_WO.p[2] - 0.5 * flat.size_m[2]
    assert 0.0 <= foot_m - TABLE.X_WP.p[2] <= 0.011


def test_what_was_taken_from_above_goes_on_a_high_board_when_taken_with_a_leveller_hand(
    solver: Solver,
) -> None:
    low = Shape(kind="box", size_m=(0.05, 0.17, 0.035))
    remote = on_table(-0.1, 0.3, shape=low)  # first taken from above there
    board = BOARD[BOARDS_M[2]]
    high = msgspec.structs.replace(board, X_WP=SE3((0.0, 0.0, 0.06)) @ board.X_WP)
    reached: dict[bool, bool] = {}
    for most_tilt_rad in (math.inf, 0.4):
        plan = pick(solver, surroundings(remote), most_tilt_rad=most_tilt_rad)
        assert isinstance(plan, PickPlan), plan
        assert plan.tilt_rad <= most_tilt_rad
        held = Held(id="cup", shape=low, X_GO=plan.X_OG.inverse())
        put = place(solver, high, surroundings(), side=plan.side, held=held)
        reached[plan.tilt_rad > 0.4] = isinstance(put, PlacePlan)
    assert reached == {True: False, False: True}


@pytest.mark.parametrize("height", BOARDS_M)
def test_a_free_spot_on_every_board(solver: Solver, height: float) -> None:
    around = surroundings()
    plan = place(solver, BOARD[height], around)
    assert isinstance(plan, PlacePlan), plan
    check_standing(solver.body, around, plan)
    assert plan.X_WO.p[2] == pytest.approx(height + 0.05)
    assert plan.X_WO.rotation()[2, 2] == pytest.approx(1.0)
    assert np.allclose((plan.X_WG_release @ held_cup().X_GO).matrix(), plan.X_WO.matrix())
    assert 0.015 < plan.X_WG_pre.p[2] - plan.X_WG_release.p[2] < 0.06
    on = BOARD[height].X_WP.inverse().apply(plan.X_WO.p)
    assert abs(on[0]) < 0.14 - 0.035
    assert abs(on[1]) < 0.43 - 0.035


def test_other_things_are_left_room(solver: Solver) -> None:
    others = tuple(on_table(0.0, y, name=f"cup {y}") for y in (-0.4, -0.2, 0.0, 0.2))
    plan = place(solver, TABLE, surroundings(*others))
    assert isinstance(plan, PlacePlan)
    gaps = [math.dist(plan.X_WO.p[:2], other.X_WO.p[:2]) for other in others]
    assert min(gaps) > 0.14


def test_a_wanted_spot_is_kept_to(solver: Solver) -> None:
    target = on_table(-0.15, 0.3).X_WO
    plan = place(solver, TABLE, surroundings(), target=target)
    assert isinstance(plan, PlacePlan)
    assert plan.X_WO.p == pytest.approx(target.p)


def test_a_full_place_has_no_spot(solver: Solver) -> None:
    full = tuple(
        on_table(x, y, name=f"cup {x} {y}")
        for x in (-0.2, 0.0, 0.2)
        for y in np.arange(-0.5, 0.51, 0.2)
    )
    failed = place(solver, TABLE, surroundings(*full))
    assert isinstance(failed, Failure)
    assert failed.code == "no_free_spot"


def test_a_thing_too_high_for_a_board_is_refused(solver: Solver) -> None:
    tall = held_cup().__class__(
        id="cup", shape=Shape(kind="cylinder", size_m=(0.06, 0.06, 0.3)), X_GO=SE3()
    )
    failed = place(solver, BOARD[0.60], surroundings(), held=tall)
    assert isinstance(failed, Failure)
    assert (failed.code, failed.evidence["height_m"]) == ("no_free_spot", 0.3)
