"""Faults happen through physics, and only to what is there."""

import math

import msgspec
import numpy as np
import pytest

from robot.errors import ConfigError, DescriptionError
from robot.se3 import SE3
from sim import faults, world
from sim.plant import Plant


@pytest.fixture
def plant(robot, kitchen):
    return Plant(kitchen, robot, seed=0)


def test_a_pushed_object_slides(plant):
    plant.step(300)
    before = plant.oracle.X_WO("red_cup")
    faults.apply(plant, faults.Push(target="red_cup", impulse_n_s=(0.0, 0.2, 0.0)))
    plant.step(500)
    after = plant.oracle.X_WO("red_cup")
    assert after.p[1] - before.p[1] > 0.01
    assert after.p[2] == pytest.approx(before.p[2], abs=0.002)


def test_a_moved_chair_stands_where_it_was_put(plant):
    faults.apply(plant, faults.Move(target="chair", X_WO=SE3.from_xy_yaw(1.0, -1.2, 0.3)))
    plant.step(500)
    index = plant.model.body("furniture/chair").id
    assert plant.data.xpos[index] == pytest.approx([1.0, -1.2, 0.0], abs=0.01)


def test_what_sleeps_wakes_when_its_support_goes(plant):
    plant.step(2000)
    assert plant.data.ntree_awake <= 1  # all but the robot rest
    plant.put("object/red_cup", SE3((1.15, 0.15, 1.1)))
    plant.step(600)
    assert plant.oracle.X_WO("red_cup").p[2] == pytest.approx(0.76, abs=0.01)


def test_a_person_may_move(plant):
    faults.apply(plant, faults.Move(target="anna", X_WO=SE3.from_xy_yaw(0.0, 1.0, 0.0)))
    plant.step(1)
    assert plant.oracle.X_WO("anna").p[:2] == (0.0, 1.0)


def test_what_stands_fast_cannot_be_moved(plant):
    with pytest.raises(ConfigError, match="stands fast"):
        faults.apply(plant, faults.Move(target="table", X_WO=SE3()))


@pytest.mark.parametrize(
    ("fault", "message"),
    [
        (faults.Remove(target="red_cop"), "did you mean 'red_cup'"),
        (faults.Silence(topic="sensors/dept"), "did you mean 'sensors/depth'"),
        (faults.MotorOff(motor="left_kne"), "did you mean 'left_knee'"),
    ],
)
def test_a_fault_that_names_nothing_is_an_error(plant, fault, message):
    with pytest.raises(ConfigError, match=message):
        faults.apply(plant, fault)


def test_a_motor_that_is_off_damps_whatever_it_is_told(plant, hold, robot):
    knee = robot.motor_names.index("left_knee")
    faults.apply(plant, faults.MotorOff(motor="left_knee"))
    plant.write(hold(0.0))
    assert plant.model.actuator_biasprm[knee, 1] == 0.0
    assert plant.data.ctrl[knee] == 0.0
    faults.apply(plant, faults.MotorOff(motor="left_knee", off=False))
    plant.write(hold(0.0))
    assert plant.model.actuator_biasprm[knee, 1] < 0.0


def test_faults_travel_as_messages():
    for fault in (
        faults.Push(impulse_n_s=(1.0, 2.0, 0.0)),
        faults.Move(target="chair", X_WO=SE3()),
        faults.Silence(topic="sensors/lidar", duration_s=2.0),
    ):
        packed = msgspec.msgpack.encode(fault)
        assert msgspec.msgpack.decode(packed, type=faults.Fault) == fault


def test_a_robot_with_a_missing_joint_is_refused_by_name(robot):
    motors = dict(robot.motors)
    motors["left_knee"] = msgspec.structs.replace(motors["left_knee"], joint="left_kneee")
    with pytest.raises(DescriptionError, match=r"left_kneee.*did you mean 'left_knee'"):
        Plant(world.empty(), msgspec.structs.replace(robot, motors=motors), seed=0)


def test_objects_rest_where_the_world_puts_them(plant, kitchen):
    plant.step(1000)
    for item in kitchen.objects:
        X_WO = plant.oracle.X_WO(item.id)
        tilt = math.acos(min(1.0, float(X_WO.rotation()[2, 2])))
        assert tilt < math.radians(0.5), item.id
    speed = np.abs(plant.data.qvel[-6 * len(kitchen.objects) :]).max()
    assert speed < 0.01
