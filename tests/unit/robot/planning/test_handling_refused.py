"""What no hand reaches or holds is refused, with what is in the way."""

import pytest

from robot.failures import Failure
from robot.messages import Shape
from robot.planning import handling
from robot.planning.checks import END
from robot.planning.solve import Solver
from robot.se3 import SE3
from tests.fakes.handling_plans import pick
from tests.fakes.planning_room import (
    CUP,
    block,
    on_table,
    surroundings,
)


def test_an_object_nobody_has_seen(solver: Solver) -> None:
    failed = pick(solver, surroundings())
    assert isinstance(failed, Failure)
    assert failed.code == "object_not_seen"


def test_what_the_hand_cannot_hold(solver: Solver) -> None:
    crate = Shape(kind="box", size_m=(0.3, 0.3, 0.3))
    failed = pick(solver, surroundings(on_table(0.0, 0.0, shape=crate)))
    assert isinstance(failed, Failure)
    assert failed.code == "no_grasp"


def test_a_cup_too_high_is_out_of_reach_by_some_amount(solver: Solver) -> None:
    cup = on_table(0.0, 0.0)
    high = type(cup)(id="cup", shape=CUP, X_WO=SE3((1.25, 0.8, 1.7)))
    failed = pick(solver, surroundings(high))
    assert isinstance(failed, Failure)
    assert failed.code == "out_of_reach"
    assert float(failed.evidence["short_m"]) > 0.1


def test_a_cup_on_an_island_of_furniture_has_no_stance(solver: Solver) -> None:
    moat = tuple(
        block(f"crate {i}", 1.5 + dx, 0.8 + dy, size)
        for i, (dx, dy, size) in enumerate(
            [
                (-0.62, 0.0, (0.6, 2.4, 0.6)),
                (0.62, 0.0, (0.6, 2.4, 0.6)),
                (0.0, 0.92, (0.64, 0.6, 0.6)),
                (0.0, -0.92, (0.64, 0.6, 0.6)),
            ]
        )
    )
    failed = pick(solver, surroundings(on_table(0.0, 0.0), more=moat))
    assert isinstance(failed, Failure)
    assert failed.code == "no_stance"


def test_a_cup_in_a_cage_names_the_cage(solver: Solver) -> None:
    bars = tuple(
        on_table(dx, dy, name="cage", shape=Shape(kind="box", size_m=(sx, sy, 0.3)))
        for dx, dy, sx, sy in [
            (0.06, 0.0, 0.02, 0.16),
            (-0.06, 0.0, 0.02, 0.16),
            (0.0, 0.06, 0.16, 0.02),
            (0.0, -0.06, 0.16, 0.02),
        ]
    )
    failed = pick(solver, surroundings(on_table(0.0, 0.0), *bars))
    assert isinstance(failed, Failure)
    assert failed.code == "goal_in_collision"
    assert "cage" in str(failed.evidence["blocked_by"])


@pytest.mark.parametrize(
    ("blockers", "words"),
    [
        (["wall_shelf"], "touches wall shelf"),
        (["table", "in_view_5"], "touches table or something in the way"),
        (["unmapped_12", "in_view_5"], "touches something in the way"),
        ([END], "is at the end of its reach"),
        (["table", END], "touches table or is at the end of its reach"),
    ],
)
def test_what_is_in_a_hands_way_is_told_without_inner_names(blockers, words) -> None:
    assert handling._fails_by(blockers) == words
