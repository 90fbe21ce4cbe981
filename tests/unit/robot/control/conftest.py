"""The robot's model, compiled once, and fresh pieces of control around it."""

import numpy as np
import pytest

from robot.kinematics.dynamics import Dynamics
from robot.model import description
from robot.model.body import BodyModel
from robot.se3 import SE3


@pytest.fixture(scope="session")
def juno():
    return description.load()


@pytest.fixture(scope="session")
def body(juno):
    return BodyModel(juno)


@pytest.fixture
def dynamics(body, juno):
    """Standing still in the nominal posture."""
    made = Dynamics(body)
    body.write_base(made.data, SE3((0.0, 0.0, juno.walking.base_height_m)))
    body.write_joints(made.data, np.array(juno.posture("nominal")))
    made.kinematics()
    made.dynamics()
    return made
