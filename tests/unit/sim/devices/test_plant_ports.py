"""Real bytes over emulated serial ports turn the joints of the simulated body."""

import numpy as np
import pytest

from robot.control.loop import ControlLoop
from robot.drivers.body_sample import BodySample
from robot.drivers.motors import servos_and_others
from robot.messages import Walk
from robot.model import description
from sim import world
from sim.plant import Plant
from tests.fakes.servo_lockstep import ServoLockstep
from tests.unit.sim.devices.test_plant_buses import holding


@pytest.fixture(scope="module")
def robot():
    return description.load("juno").driven_by("dynamixel")


@pytest.fixture
def rig(robot, tmp_path):
    plant = Plant(world.load("empty"), robot, seed=0, noisy=False)
    return ServoLockstep(plant, servos_and_others.maps(robot), tmp_path)


def test_joints_on_servos_and_on_can_are_told_and_obey_as_one_robot(robot, rig):
    with rig.all_motors() as driver:
        for _ in range(100):
            driver.write(holding(robot, rig.now_s()))
            state = driver.read()
        truth = rig.plant.read().motors
        moved = 0.006 + 0.004 * np.abs(truth.qd)
        assert (np.abs(state.q - truth.q) <= moved).all()
        assert not state.alarms
        assert not state.watchdog
        assert (state.age_s < 0.0021).all()
        assert np.isfinite(state.temperature_c).all()
        assert all(servo.is_on for servo in rig.buses.servos)
        assert {motor.status for motor in rig.buses.motors} == {1}
        assert driver.servos.reception.lost == 0


def test_without_commands_servos_stop_by_their_own_watchdogs(robot, rig):
    with rig.all_motors() as driver:
        for _ in range(20):
            driver.write(holding(robot, rig.now_s()))
            driver.read()
        rig.sleep_until(rig.now_s() + 0.05)
        assert {servo.memory.get(98, 1, signed=True) for servo in rig.buses.servos} == {-1}
        assert not any(servo.tau_nm for servo in rig.buses.servos)
        driver.others._is_armed = driver.servos._is_armed = False  # it was killed


def test_the_controller_walks_with_its_arms_on_servos(robot, rig):
    loop = ControlLoop(robot)
    lines: list[str] = []
    with rig.all_motors(lines.append) as driver:
        for k in range(900):
            state, felt = driver.read(), rig.plant.sample
            driver.write(loop.tick(BodySample(state, felt.imu, felt.force)))
            if k == 150:
                loop.handle(Walk(stamp_s=rig.now_s(), id=1, forward_m_s=0.3, hold_s=9.0))
        assert loop.mode == "walk"
        assert not state.alarms
    assert rig.plant.where(robot.base_body).p[0] > 0.05
    assert "15 joints, 899 periods at 500 Hz, 0 replies late" in lines[0]
    assert "Dynamixel: 18 joints, 899 periods at 500 Hz, 0 answers missed" in lines[1]
    assert "0 packets spoilt" in lines[1]
