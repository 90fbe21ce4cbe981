"""Real datagrams over emulated boards turn the joints of the simulated body."""

import msgspec
import numpy as np
import pytest

from robot.control.loop import ControlLoop
from robot.drivers.body_sample import BodySample
from robot.drivers.motors import motor_map
from robot.drivers.motors.ethernet import joint_map
from robot.drivers.motors.ethernet.driver import FAMILY
from robot.messages import Walk
from robot.model import description
from sim import world
from sim.plant import Plant
from tests.fakes.ankles import ANKLES
from tests.fakes.ethernet_lockstep import EthernetLockstep
from tests.unit.sim.devices.test_plant_buses import holding


@pytest.fixture(scope="module")
def robot():
    return description.load("juno").driven_by("ethernet")


@pytest.fixture
def rig(robot, tmp_path):
    """Juno's map, some of its motors mounted the other way round, behind belts, off by an angle."""
    found = FAMILY.beside(robot)
    other = {
        "left_elbow": {"sign": -1, "offset_rad": 0.4},
        "right_elbow": {"gear": 1.5, "offset_rad": -0.2},
        "head_yaw": {"sign": -1, "gear": 2.0},
    }
    joints = {
        name: msgspec.structs.replace(one, **other.get(name, {}))
        for name, one in found.joints.items()
    }
    plant = Plant(world.load("empty"), robot, seed=0, noisy=False)
    return EthernetLockstep(plant, msgspec.structs.replace(found, joints=joints), tmp_path)


def test_joints_are_told_and_obey_through_signs_gears_and_offsets(robot, rig):
    with rig.motors() as driver:
        for _ in range(100):
            driver.write(holding(robot, rig.now_s()))
            state = driver.read()
        truth = rig.plant.read().motors
        moved = 0.002 + 0.003 * np.abs(truth.qd)
        assert (np.abs(state.q - truth.q) <= moved).all()
        assert not state.alarms
        assert not state.watchdog
        assert (state.age_s < 0.0021).all()
        np.testing.assert_allclose(state.temperature_c, truth.temperature_c, atol=0.2)
        assert all(
            drive.is_on for cable in rig.buses.cables for drive in cable.board.drives.values()
        )
        assert driver.reception.lost == driver.reception.refused.total() == 0


def test_without_commands_boards_brake_by_their_own_watchdogs(robot, rig):
    with rig.motors() as driver:
        for _ in range(20):
            driver.write(holding(robot, rig.now_s()))
            driver.read()
        rig.sleep_until(rig.now_s() + 0.03)
        for cable in rig.buses.cables:
            assert cable.board.is_expired
            assert not cable.board.is_on
        driver._is_armed = False  # it was killed


def test_the_controller_stands_and_walks_by_datagrams_and_no_reply_is_late(robot, rig):
    loop = ControlLoop(robot)
    lines: list[str] = []
    with rig.motors(lines.append) as driver:
        for k in range(900):
            state, felt = driver.read(), rig.plant.sample
            driver.write(loop.tick(BodySample(state, felt.imu, felt.force)))
            if k == 150:
                loop.handle(Walk(stamp_s=rig.now_s(), id=1, forward_m_s=0.3, hold_s=9.0))
        assert loop.mode == "walk"
        assert not state.alarms
    assert rig.plant.where(robot.base_body).p[0] > 0.05
    (line,) = lines
    assert "33 joints on 5 boards, 899 periods at 500 Hz, 0 replies late (0.000%)" in line
    assert "0 datagrams refused, 0 not sent, 0 periods late" in line


def test_it_walks_over_a_network_that_loses_every_twentieth_exchange(robot, rig):
    loop = ControlLoop(robot)
    with rig.motors() as driver:
        for k in range(1200):
            if k == 100:
                for cable in rig.buses.cables:
                    cable.trouble.loses_share = 0.025  # of questions, and of answers
            state, felt = driver.read(), rig.plant.sample
            driver.write(loop.tick(BodySample(state, felt.imu, felt.force)))
            assert not {"SIT", "DAMP", "OFF"} & {alarm.level for alarm in state.alarms}
            if k == 150:
                loop.handle(Walk(stamp_s=rig.now_s(), id=1, forward_m_s=0.3, hold_s=9.0))
        assert 0.03 < driver.reception.lost / (1100 * 33) < 0.07
        assert loop.mode == "walk"
    assert rig.plant.where(robot.base_body).p[0] > 0.2


def test_it_walks_on_ankles_of_two_rods_and_a_waist_of_a_differential(robot, tmp_path):
    path = tmp_path / "ethernet.yaml"
    path.write_text(robot.path().with_name("ethernet.yaml").read_text() + ANKLES)
    boards = motor_map.of_robot(joint_map.load(path), robot.motor_names)
    plant = Plant(world.load("empty"), robot, seed=0, noisy=False)
    rig = EthernetLockstep(plant, boards, tmp_path)
    loop = ControlLoop(robot)
    lines: list[str] = []
    with rig.motors(lines.append) as driver:
        for k in range(900):
            state, felt = driver.read(), rig.plant.sample
            driver.write(loop.tick(BodySample(state, felt.imu, felt.force)))
            if k == 150:
                loop.handle(Walk(stamp_s=rig.now_s(), id=1, forward_m_s=0.3, hold_s=9.0))
        truth = rig.plant.read().motors
        assert (np.abs(state.q - truth.q) <= 0.002 + 0.003 * np.abs(truth.qd)).all()
        assert loop.mode == "walk"
        assert not state.alarms
    assert rig.plant.where(robot.base_body).p[0] > 0.05
    assert "0 replies late" in lines[0]
