"""Picks and places that are planned for tests, and whether a body stands and reaches so."""

import math

import numpy as np
import pytest

from robot.failures import Failure
from robot.planning.floor import Floor
from robot.planning.requests import (
    ObjectPose,
    PickPlan,
    PickRequest,
    PlacePlan,
    PlaceRequest,
    Stance,
    Surroundings,
)
from robot.planning.robot_body import Body
from robot.planning.solids import solids_of
from robot.planning.solve import Solver
from robot.se3 import SE3
from tests.fakes.planning_room import (
    BOARDS_M,
    CUP,
    START,
    block,
    held_cup,
    room,
)

LYING = SE3.from_rpy(0.0, math.pi / 2, 0.0, (0.0, 0.0, 0.0))


BOARD = {board: room().places[1 + i] for i, board in enumerate(BOARDS_M)}


TABLE = room().places[0]


def pick(solver: Solver, around: Surroundings, **more) -> PickPlan | Failure:
    answer = solver.solve(PickRequest(object_id="cup", around=around, start=START, **more))
    assert isinstance(answer, PickPlan | Failure)
    return answer


def place(solver: Solver, on, around: Surroundings, **more) -> PlacePlan | Failure:
    fields = {"place": on, "side": "right", "held": held_cup(), "around": around, "start": START}
    answer = solver.solve(PlaceRequest(**{**fields, **more}))
    assert isinstance(answer, PlacePlan | Failure)
    return answer


def on_a_counter(height: float, deep: float) -> Surroundings:
    """A cup so deep on a counter against a wall, solid to the floor."""
    counter = block("counter", 1.65, -2.0, (0.90, 1.40, height))
    wall = block("wall", 2.13, -2.0, (0.04, 1.40, 1.5))
    cup = ObjectPose(id="cup", shape=CUP, X_WO=SE3((1.2 + deep, -2.0, height + 0.05)))
    return Surroundings(map=room(counter, wall), objects=(cup,))


def check_standing(body: Body, around: Surroundings, plan: PickPlan | PlacePlan) -> None:
    """The stance is free, the standoff has room, the step in between is straight ahead."""
    solids = solids_of(around)
    floor = Floor(solids, around.map.bounds_m)
    assert body.trunk_touch(solids, plan.stance, clearance_m=0.02) is None
    assert floor.clearance_m(*plan.standoff[:2]) >= body.description.body_radius_m
    (x0, y0, yaw0), (x1, y1, yaw1) = plan.standoff, plan.stance
    assert yaw0 == yaw1
    assert math.atan2(y1 - y0, x1 - x0) == pytest.approx(yaw0, abs=1e-6)


def reaches(body: Body, plan: PickPlan | PlacePlan, X_WG: SE3, stance: Stance) -> float:
    """How far the hand stays short of a pose, from joints near the pre-grasp [m]."""
    arm = body.arms[plan.side]
    X_WT = SE3.from_xy_yaw(*stance) @ body.standing(plan.posture, plan.side).X_ST[plan.side]
    X_TG = X_WT.inverse() @ X_WG
    start = np.array([plan.pre_rad])
    solved = arm.chain.solve(X_TG.rotation()[None], np.array([X_TG.p]), start, iterations=60)
    return float(solved.position_error_m[0])
