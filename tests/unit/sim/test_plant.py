"""The plant: it stands, it repeats, and nobody makes it do what motors cannot."""

import mujoco
import numpy as np
import pytest

from robot.errors import DriverError
from robot.physics import GRAVITY_M_S2
from robot.se3 import SE3
from sim import world
from sim.plant import Plant
from sim.ray_sensors import developed


def test_starts_on_its_soles_where_the_world_says(robot, kitchen):
    plant = Plant(kitchen, robot, seed=0)
    soles = [plant.data.site(foot.sole_site) for foot in robot.feet.values()]
    middle = np.mean([sole.xpos for sole in soles], axis=0)
    assert middle[:2] == pytest.approx(kitchen.start.at_m, abs=1e-9)
    assert [sole.xpos[2] for sole in soles] == pytest.approx([0.0, 0.0], abs=1e-9)
    assert plant.oracle.X_WB().yaw_rad == pytest.approx(np.radians(kitchen.start.yaw_deg))


def test_mimic_fingers_start_with_their_leaders(plant):
    q = {name: plant.data.joint(name).qpos[0] for name in ("left_gripper", "left_gripper_mimic")}
    assert q["left_gripper"] > 0.0
    assert q["left_gripper_mimic"] == q["left_gripper"]


def test_pd_holds_the_posture_standing(plant, run, robot):
    run(plant, 1.0)
    error = plant.read().motors.q - np.array(robot.posture("nominal"))
    assert np.abs(error).max() < 0.06
    assert plant.oracle.X_WB().p[2] == pytest.approx(robot.walking.base_height_m, abs=0.02)


def test_it_falls_as_fast_as_controllers_think(plant):
    assert tuple(plant.model.opt.gravity) == (0.0, 0.0, -GRAVITY_M_S2)


def test_standing_the_feet_push_the_legs_up_with_the_weight(plant, run):
    run(plant, 1.0)
    sample = plant.read()
    weight_n = plant.model.body_subtreemass[0] * GRAVITY_M_S2
    feet_n = 2 * 0.8 * GRAVITY_M_S2  # below the ankles' sensors
    assert sample.force.ankle_wrench[:, 2].sum() == pytest.approx(weight_n - feet_n, rel=0.05)
    assert np.linalg.norm(sample.imu.accel_m_s2) == pytest.approx(GRAVITY_M_S2, rel=0.05)


def test_hanging_hands_pull_the_arms_down(plant, run):
    run(plant, 1.0)
    for side, wrench in zip(("left", "right"), plant.read().force.wrist_wrench, strict=True):
        force_W = plant.data.site(f"{side}_wrist_ft").xmat.reshape(3, 3) @ wrench[:3]
        assert force_W[2] < -3.0


def test_without_commands_motors_damp_after_the_watchdog_time(plant, hold):
    assert plant.read().motors.watchdog  # nothing came yet
    plant.write(hold(plant.time_s))
    plant.step(19)
    assert not plant.read().motors.watchdog
    plant.step(1)
    assert plant.read().motors.watchdog
    plant.step(1000)
    height_m = plant.oracle.X_WB().p[2]
    assert height_m < 0.45  # it sank: damping does not carry
    assert np.abs(plant.read().motors.qd).max() < 15.0


def test_a_late_command_ends_the_watchdog(plant, hold):
    plant.step(50)
    plant.write(hold(plant.time_s))
    plant.step(1)
    state = plant.read().motors
    assert not state.watchdog
    assert state.command_stamp_s == pytest.approx(0.05)


@pytest.mark.parametrize("field", ["q_des", "qd_des", "tau_ff", "kp", "kd"])
@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_what_is_no_number_is_refused_and_changes_nothing(plant, hold, field, value):
    plant.write(hold(0.0))
    before = plant.data.ctrl.copy()
    command = hold(0.001)
    getattr(command, field)[3] = value
    with pytest.raises(DriverError, match=rf"{field}\[3\]"):
        plant.write(command)
    assert np.array_equal(plant.data.ctrl, before)
    assert plant.read().motors.command_stamp_s == 0.0


def test_a_command_sent_again_is_in_force_again(plant, hold):
    command = hold(0.0)
    plant.write(command)
    driven = plant.data.ctrl.copy()
    assert driven.any()
    plant.motors.damp()
    assert not plant.data.ctrl.any()
    command.stamp_s = 0.002
    assert plant.write(command).stamp_s == 0.002
    np.testing.assert_array_equal(plant.data.ctrl, driven)
    assert not plant.read().motors.watchdog


def test_a_motor_that_is_off_damps_a_command_sent_again(plant, hold):
    command = hold(0.0)
    plant.write(command)
    plant.motors.set_off(3, off=True)
    plant.write(command)
    assert plant.model.actuator_biasprm[3, 1] == 0.0
    plant.motors.set_off(3, off=False)
    plant.write(command)
    assert plant.model.actuator_biasprm[3, 1] == -command.kp[3]


def test_a_wrong_shape_is_refused(plant, hold):
    command = hold(0.0)
    command.kp = command.kp[:-1]
    with pytest.raises(DriverError, match="shape"):
        plant.write(command)


def test_torque_never_passes_the_limit(plant, hold, robot):
    limits = np.array([motor.torque_limit_nm for motor in robot.motors.values()])
    command = hold(0.0)
    command.tau_ff[:] = 1e6
    sent = plant.write(command)
    assert np.array_equal(sent.tau_ff, limits)
    rng = np.random.default_rng(0)
    for _ in range(100):
        command = hold(plant.time_s)
        command.q_des += rng.normal(0.0, 3.0, len(limits))
        command.kp *= 10.0
        plant.write(command)
        plant.step(2)
        assert (np.abs(plant.read().motors.tau) <= limits + 1e-9).all()


def test_same_seed_same_states_bit_for_bit(robot, hold):
    def states(seed: int) -> tuple[bytes, ...]:
        plant = Plant(world.load("kitchen"), robot, seed=seed)
        found: list[bytes] = []
        for _ in range(60):
            plant.write(hold(plant.time_s))
            plant.step(5)
            sensed = [developed(message) for _, message in plant.sense()]
            found += [plant.read().motors.q.tobytes(), repr(sensed).encode()]
        return (*found, plant.data.qpos.tobytes())

    first = states(7)
    assert states(7) == first
    assert states(8) != first


def test_steps_may_be_taken_one_by_one_or_together(robot, hold):
    def end(chunks: list[int]) -> bytes:
        plant = Plant(world.empty(), robot, seed=0)
        plant.write(hold(0.0))
        plant.push(5.0, 0.3, duration_s=0.03)
        for chunk in chunks:
            plant.step(chunk)
        return plant.data.qpos.tobytes()

    assert end([60]) == end([1] * 60) == end([7, 19, 34])


def test_a_push_gives_its_impulse(plant):
    plant.model.opt.gravity[:] = 0.0
    plant.stand(SE3((0.0, 0.0, 0.0)))
    plant.data.qpos[2] += 1.0  # off the floor
    plant.push(7.0, np.pi / 2, duration_s=0.05)
    plant.step(200)
    mujoco.mj_subtreeVel(plant.model, plant.data)
    root = plant.model.body(plant.robot.base_body).id
    momentum = plant.data.subtree_linvel[root] * plant.model.body_subtreemass[root]
    assert momentum == pytest.approx([0.0, 7.0, 0.0], abs=0.05)


def test_a_loaded_motor_gets_warm(plant, run):
    run(plant, 2.0)
    temperature = dict(zip(plant.robot.motor_names, plant.read().motors.temperature_c, strict=True))
    assert temperature["left_knee"] > temperature["head_yaw"] >= 25.0
    assert temperature["left_knee"] < 60.0


def test_noise_is_small_centred_and_off_on_request(robot, plant):
    noisy = Plant(world.empty(), robot, seed=3)
    truth = plant.read().motors
    samples = np.array([noisy.read().motors.q - truth.q for _ in range(400)])
    legs = robot.indices("left_leg")
    sigma = robot.sensors.encoder_noise_rad
    assert samples[:, legs].std() == pytest.approx(sigma, rel=0.1)
    assert np.abs(samples[:, legs].mean(axis=0)).max() < 0.25 * sigma
    assert np.array_equal(plant.read().motors.q, truth.q)


def test_physics_that_diverges_is_an_error(plant):
    plant.data.qvel[0] = np.nan
    with pytest.raises(DriverError, match="diverged"):
        plant.step(1)


def test_steps_are_multiples_of_the_physics_time_step(robot):
    plant = Plant(world.empty(), robot, seed=0, physics_ms=2)
    plant.step(20)
    assert plant.time_s == 0.02
    assert plant.data.time == pytest.approx(0.02)
    with pytest.raises(ValueError, match="multiple"):
        plant.step(3)
