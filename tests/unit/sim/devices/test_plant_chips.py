"""A robot whose head goes by pulses, and whose legs by CAN: one body, one driver."""

import numpy as np
import pytest

from robot.control.loop import NEEDS, ControlLoop
from robot.drivers.body_sample import BodySample
from robot.drivers.motors import pwm_and_others
from robot.messages import Walk
from robot.model import description
from sim import world
from sim.plant import Plant
from tests.fakes.pwm_lockstep import PwmLockstep
from tests.unit.sim.devices.test_plant_buses import holding


@pytest.fixture(scope="module")
def robot():
    return description.load("juno").driven_by("pwm")


@pytest.fixture
def rig(robot, tmp_path):
    plant = Plant(world.load("empty"), robot, seed=0, noisy=False)
    return PwmLockstep(plant, pwm_and_others.maps(robot), tmp_path)


def test_what_is_measured_and_what_is_assumed_is_said_by_joint(robot, rig):
    head = [robot.motor_names.index(name) for name in ("head_yaw", "head_pitch")]
    rest = [index for index in range(len(robot.motors)) if index not in head]
    with rig.all_motors() as driver:
        assert driver.capabilities >= NEEDS
        for _ in range(100):
            driver.write(holding(robot, rig.now_s()))
            state = driver.read()
        assert np.isinf(state.age_s[head]).all()
        assert np.isnan(state.tau[head]).all()
        assert (state.age_s[rest] < 0.0021).all()
        assert np.isfinite(state.tau[rest]).all()
        truth = rig.plant.read().motors
        assert (np.abs(state.q - truth.q)[rest] <= (0.002 + 0.003 * np.abs(truth.qd))[rest]).all()
        assert (np.abs(state.q - truth.q)[head] < 0.1).all()
        assert all(servo.is_on for servo in rig.buses.pulsed.servos.values())
        assert not state.alarms
    rig.sleep_until(rig.now_s() + 0.2)
    assert not any(servo.is_on for servo in rig.buses.pulsed.servos.values())


def test_the_controller_walks_with_a_head_that_says_nothing(robot, rig):
    loop = ControlLoop(robot)
    with rig.all_motors() as driver:
        for k in range(900):
            state, felt = driver.read(), rig.plant.sample
            driver.write(loop.tick(BodySample(state, felt.imu, felt.force)))
            if k == 150:
                loop.handle(Walk(stamp_s=rig.now_s(), id=1, forward_m_s=0.3, hold_s=9.0))
        assert loop.mode == "walk"
        assert not state.alarms
        assert np.isfinite(loop.state().q_rad).all()
    assert rig.plant.where(robot.base_body).p[0] > 0.05


def test_how_late_the_motors_obey_is_found_though_some_measure_no_torque(robot, rig):
    """Torques of the head are no numbers: they must not hide what the legs tell."""
    loop = ControlLoop(robot)
    with rig.all_motors() as driver:
        for _ in range(300):
            state, felt = driver.read(), rig.plant.sample
            driver.write(loop.tick(BodySample(state, felt.imu, felt.force)))
    assert loop.latency._error is not None
    assert np.isfinite(loop.latency._error).all()
