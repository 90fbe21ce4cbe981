"""A robot and plants that the tests of `sim` share."""

import numpy as np
import pytest

from robot.drivers.motor_bus import MotorCommand
from robot.model import description
from sim import world
from sim.plant import Plant


@pytest.fixture(scope="session")
def robot():
    return description.load("juno")


@pytest.fixture(scope="session")
def hold(robot):
    """A command that holds the nominal posture with three times the nominal stiffness."""
    motors = robot.motors.values()
    zero = np.zeros(len(motors))
    kp = 3.0 * np.array([motor.kp for motor in motors])
    kd = np.array([motor.kd for motor in motors])
    q = np.array(robot.posture("nominal"))

    def at(stamp_s: float) -> MotorCommand:
        return MotorCommand(stamp_s, q.copy(), zero.copy(), zero.copy(), kp.copy(), kd.copy())

    return at


@pytest.fixture
def plant(robot):
    return Plant(world.empty(), robot, seed=1, noisy=False)


@pytest.fixture(scope="session")
def kitchen():
    return world.load("kitchen")


@pytest.fixture
def run(hold):
    """Let a plant stand for a while under `hold`."""

    def run_for(plant: Plant, duration_s: float) -> None:
        for _ in range(round(duration_s / 0.01)):
            plant.write(hold(plant.time_s))
            plant.step(10)

    return run_for
