"""Faults happen through physics, and only to what is there."""

import math

import msgspec
import numpy as np
import pytest

from robot.drivers.motor_bus import MotorCommand
from robot.errors import ConfigError, DescriptionError
from robot.reality import faults
from robot.se3 import SE3
from sim import world
from sim.faults import apply
from sim.plant import Plant


@pytest.fixture
def plant(robot, kitchen):
    return Plant(kitchen, robot, seed=0)


def test_a_pushed_object_slides(plant):
    plant.step(300)
    before = plant.oracle.X_WO("red_cup")
    apply(plant, faults.Push(target="red_cup", impulse_n_s=(0.0, 0.2, 0.0)))
    plant.step(500)
    after = plant.oracle.X_WO("red_cup")
    assert after.p[1] - before.p[1] > 0.01
    assert after.p[2] == pytest.approx(before.p[2], abs=0.002)


def test_a_moved_chair_stands_where_it_was_put(plant):
    apply(plant, faults.Move(target="chair", X_WO=SE3.from_xy_yaw(1.0, -1.2, 0.3)))
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
    apply(plant, faults.Move(target="anna", X_WO=SE3.from_xy_yaw(0.0, 1.0, 0.0)))
    plant.step(1)
    assert plant.oracle.X_WO("anna").p[:2] == (0.0, 1.0)


def test_what_stands_fast_cannot_be_moved(plant):
    with pytest.raises(ConfigError, match="stands fast"):
        apply(plant, faults.Move(target="table", X_WO=SE3()))


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
        apply(plant, fault)


def test_a_motor_that_is_off_damps_whatever_it_is_told(plant, hold, robot):
    knee = robot.motor_names.index("left_knee")
    apply(plant, faults.MotorOff(motor="left_knee"))
    plant.write(hold(0.0))
    assert plant.model.actuator_biasprm[knee, 1] == 0.0
    assert plant.data.ctrl[knee] == 0.0
    apply(plant, faults.MotorOff(motor="left_knee", off=False))
    plant.write(hold(0.0))
    assert plant.model.actuator_biasprm[knee, 1] < 0.0


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


@pytest.mark.parametrize("towards_deg", [0.0, 90.0, -135.0])
@pytest.mark.parametrize("target", ["red_cup", "bottle", "box"])
def test_what_is_knocked_over_lies_on_its_side(plant, target, towards_deg):
    plant.step(300)
    apply(plant, faults.KnockOver(target=target, towards_deg=towards_deg))
    plant.step(700)
    assert abs(plant.oracle.X_WO(target).rotation()[2, 2]) < 0.3


def test_a_person_in_the_way_goes_away_again(plant):
    before = plant.oracle.X_WO("anna").p
    apply(plant, faults.StandInWay(target="anna", ahead_m=0.8, duration_s=0.5))
    plant.step(100)
    X_BO = plant.oracle.X_WB().flat().inverse() @ plant.oracle.X_WO("anna")
    assert X_BO.p[:2] == pytest.approx((0.8, 0.0), abs=0.02)
    plant.step(500)
    assert plant.oracle.X_WO("anna").p == before


def test_an_occupied_place_holds_the_other_object(plant):
    plant.step(100)
    apply(plant, faults.Occupy(place="shelf_middle", target="box", at_m=(0.05, 0.1)))
    plant.step(500)
    X_PO = plant.places()["shelf_middle"].X_WP.inverse() @ plant.oracle.X_WO("box")
    assert X_PO.p == pytest.approx((0.05, 0.1, 0.05), abs=0.005)


def test_fixes_mislead_for_a_while(plant):
    apply(plant, faults.Mislead(by_m=(0.5, 0.0), by_deg=10.0, duration_s=1.0))
    true = plant.oracle.X_WB()
    false = plant.oracle.fix(0.5).X_WB
    assert false.p[0] - true.p[0] == pytest.approx(0.5, abs=0.02)
    assert false.yaw_rad - true.yaw_rad == pytest.approx(math.radians(10.0), abs=0.02)
    assert plant.oracle.fix(1.1).X_WB.p[0] == pytest.approx(true.p[0], abs=0.02)


def test_an_imu_that_is_off_says_so_in_its_own_axes(plant):
    plant.step(100)
    still = plant.read().imu
    offset = faults.OffsetImu(gyro_deg_s=(0.0, 0.0, 20.0), accel_m_s2=(1.0, 0, 0))
    apply(plant, offset)
    off = plant.read().imu
    assert off.gyro_rad_s[2] - still.gyro_rad_s[2] == pytest.approx(math.radians(20), abs=0.05)
    assert off.accel_m_s2[0] - still.accel_m_s2[0] == pytest.approx(1.0, abs=0.5)
    askew = SE3.from_rpy(0.0, math.radians(30.0), 0.0, (0.0, 0.0, 0.0)).rotation()
    apply(plant, faults.OffsetImu(askew_deg=(0.0, 30.0, 0.0)))
    assert plant.read().imu.accel_m_s2 == pytest.approx(askew.T @ still.accel_m_s2, abs=0.5)
    apply(plant, faults.OffsetImu())
    assert plant.read().imu.accel_m_s2 == pytest.approx(still.accel_m_s2, abs=0.5)


def test_a_hot_motor_and_an_empty_battery(plant, robot):
    apply(plant, faults.Heat(motor="left_knee", temperature_c=90.0))
    assert plant.motors.temperature_c[robot.motor_names.index("left_knee")] == 90.0
    apply(plant, faults.Discharge(charge=0.1))
    before = plant.battery.charge
    plant.step(1000)
    assert 0.0 < before - plant.battery.charge < 0.001
    with pytest.raises(ConfigError, match="from 0 to 1"):
        faults.parse({"fault": "discharge", "charge": 1.5})


def test_a_sill_lies_across_the_way_and_goes_again(plant):
    X_WB = plant.oracle.X_WB()
    apply(plant, faults.Sill(height_m=0.03, ahead_m=0.8))
    sill = plant.where("sill")
    assert (X_WB.flat().inverse() @ sill).p[0] == pytest.approx(0.8)
    assert sill.yaw_rad == pytest.approx(X_WB.yaw_rad)
    top_m = sill.p[2] + plant.model.geom_size[plant.model.body("sill").geomadr[0]][2]
    assert top_m == pytest.approx(0.03)
    plant.put("object/red_cup", SE3((sill.p[0], sill.p[1], 0.12)))
    plant.step(600)
    assert plant.oracle.X_WO("red_cup").p[2] == pytest.approx(0.03 + 0.05, abs=0.02)
    apply(plant, faults.Sill(height_m=0.0))
    assert plant.where("sill").p[2] < -0.5


def test_a_slope_leans_gravity_away_from_where_it_rises(plant):
    yaw = plant.oracle.X_WB().yaw_rad + math.pi / 2
    apply(plant, faults.Slope(rise_deg=5.0, towards_deg=90.0))
    plant.step(500)
    g = plant.model.opt.gravity
    assert np.linalg.norm(g) == pytest.approx(9.81, abs=0.01)
    assert -(g[0] * math.cos(yaw) + g[1] * math.sin(yaw)) == pytest.approx(
        9.81 * math.sin(math.radians(5.0)), abs=0.01
    )


def test_the_gyro_feels_a_floor_that_turns(robot, kitchen):
    plant = Plant(kitchen, robot, seed=0, noisy=False)
    site = plant.data.site(robot.sensors.imu.site)
    apply(plant, faults.Slope(rise_deg=3.0, towards_deg=30.0))
    towards_rad = plant.oracle.X_WB().yaw_rad + math.radians(30.0)
    up, turned = np.array([math.cos(towards_rad), math.sin(towards_rad), 0.0]), np.zeros(3)
    for _ in range(600):
        plant.step(1)
        felt = plant.read().imu.gyro_rad_s
        own = plant.data.sensor(robot.sensors.imu.gyro).data
        turned += 0.001 * site.xmat.reshape(3, 3) @ (felt - own)
    assert turned == pytest.approx(math.radians(3.0) * np.cross(up, (0.0, 0.0, 1.0)), abs=2e-3)


def test_a_load_weighs_on_the_torso(plant):
    before = float(plant.model.body_mass.sum())
    apply(plant, faults.Load(mass_kg=3.0))
    assert float(plant.model.body_mass.sum()) == pytest.approx(before + 3.0)


def test_a_delay_begins_and_ends(plant):
    zero = np.zeros(plant.motors.count)

    def told(torque):
        plant.write(MotorCommand(plant.time_s, zero, zero, zero + torque, zero, zero))

    apply(plant, faults.Delay(delay_s=0.01))
    told(1.0)
    plant.step(8)
    assert not plant.data.ctrl.any()
    plant.step(4)
    assert plant.data.ctrl == pytest.approx(1.0)
    apply(plant, faults.Delay(delay_s=0.0))
    told(2.0)
    assert plant.data.ctrl == pytest.approx(2.0)
