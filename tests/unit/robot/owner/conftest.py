"""A body whose squat is known, for all of these tests."""

import pytest

from robot.model import description
from robot.model.body import BodyModel
from robot.owner.sit import Squat, plan


@pytest.fixture(scope="package")
def body() -> BodyModel:
    return BodyModel(description.load("juno"))


@pytest.fixture(scope="package")
def squat(body) -> Squat:
    return plan(body)
