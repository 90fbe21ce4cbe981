"""What lies too deep is refused with the figures; arms have room for what steps sway them by."""

import itertools
import math

import msgspec
import numpy as np
import pytest

from robot.failures import Failure
from robot.planning.requests import BodyPosture, ObjectPose, PickPlan, PickRequest, Surroundings
from robot.planning.solids import solids_of
from robot.planning.solve import Solver
from robot.se3 import SE3
from tests.fakes.handling_plans import LYING, on_a_counter, pick
from tests.fakes.planning_room import CUP, block, room


def test_what_lies_too_deep_is_refused_with_the_figures(solver: Solver) -> None:
    """Where it lies its lowest point is half of its width below its middle, not of its length."""
    around = on_a_counter(1.15, 0.30)
    (cup,) = around.objects
    low = SE3((*cup.X_WO.p[:2], 1.15 + 0.5 * CUP.size_m[0]), LYING.quat_wxyz)
    around = msgspec.structs.replace(around, objects=(msgspec.structs.replace(cup, X_WO=low),))
    refused = pick(solver, around)
    assert isinstance(refused, Failure)
    assert refused.code == "out_of_reach"
    assert "30 cm from the edge, 1.15 m up; a hand comes 15 cm deep there" in refused.cause


@pytest.mark.parametrize(("deep_m", "seed"), [(0.19, 1), (0.26, 0)])
def test_what_is_reached_in_a_corner_leaves_room_to_sway_from_rest(
    solver: Solver, deep_m: float, seed: int
) -> None:
    """Steps that begin standing sway by 9 cm: beside a wall and a cabinet the arm has that room."""
    cabinet = block("cabinet", 0.55, 2.65, (1.10, 0.50, 0.93))
    cup = ObjectPose(id="cup", shape=CUP, X_WO=SE3((deep_m, 2.76, 0.93 + 0.5 * CUP.size_m[2])))
    around = Surroundings(map=room(cabinet), objects=(cup,))
    plan = solver.solve(
        PickRequest(object_id="cup", around=around, start=(-0.9, 1.9, 0.5), seed=seed)
    )
    assert isinstance(plan, PickPlan)
    body, side = solver.body, plan.side
    standing, hand = body.standing(BodyPosture(), side), body.description.hands[side]
    scene = body.scenes.get(solids_of(around))
    scene.set_clearance(0.0)
    hands = {hand.body, *hand.finger_bodies}
    links = np.array([name not in hands for name in scene.names]) & ~scene.solid_geoms
    q = standing.q.copy()
    q[body.arms[side].motors] = plan.ready_rad
    X_WS = SE3.from_xy_yaw(*plan.stance)
    step_m = math.dist(plan.stance[:2], plan.standoff[:2])
    for back_m, aside_m in itertools.product((0.0, 0.5 * step_m, step_m), (-0.09, 0.09)):
        scene.pose(X_WS @ SE3((-back_m, aside_m, 0.0)) @ standing.X_SB, q)
        scene.update()
        assert not scene.touches(links, solids_only=True)
