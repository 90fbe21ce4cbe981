"""One compiled robot for all tests of planning."""

import pytest

from robot.model.description import load
from robot.planning.robot_body import Body
from robot.planning.solve import Solver


@pytest.fixture(scope="session")
def solver() -> Solver:
    return Solver(load("juno"))


@pytest.fixture(scope="session")
def body(solver: Solver) -> Body:
    return solver.body
