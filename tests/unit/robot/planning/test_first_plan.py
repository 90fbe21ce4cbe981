"""The first plan of a process finds made what all plans need: nothing is loaded or posed for it."""

import sys

import pytest

from robot.model import mjcf
from robot.model.description import load
from robot.planning.requests import PickRequest, PlacePlan, PlaceRequest
from robot.planning.robot_body import Body
from robot.planning.solve import Solver
from tests.fakes.planning_room import START, held_cup, on_table, room, surroundings

ROBOT = load("juno")
PICK = PickRequest(object_id="cup", around=surroundings(on_table(0.1, 0.1)), start=START, seed=3)
PLACE = PlaceRequest(
    place=room().places[-1], side="right", held=held_cup(), around=surroundings(), start=START
)


@pytest.mark.parametrize("first", [PICK, PLACE])
def test_the_first_plan_waits_for_nothing_that_plans_share(
    monkeypatch: pytest.MonkeyPatch, first: PickRequest | PlaceRequest
) -> None:
    solver = Solver(ROBOT)
    solver.warm_up()
    made: list[str] = []
    stand, spec = Body.stand, mjcf.spec

    def noted_stand(self, posture, q):
        made.append(f"standing so: {posture}")
        return stand(self, posture, q)

    def noted_spec(source):
        made.append("the robot's form")
        return spec(source)

    monkeypatch.setattr(Body, "stand", noted_stand)
    monkeypatch.setattr(mjcf, "spec", noted_spec)
    loaded = set(sys.modules)
    warm = solver.solve(first)
    assert made == []
    assert set(sys.modules) == loaded
    cold = Solver(ROBOT).solve(first)
    assert len(made) > 2
    assert cold == warm
    assert not isinstance(first, PlaceRequest) or isinstance(warm, PlacePlan)


def test_a_robot_without_hands_has_nothing_to_warm_up_for_them() -> None:
    """It still plans ways."""
    courier = load("examples/robot_courier/courier.yaml")
    Solver(courier).warm_up()
