"""Realities: what they spoil, by whose seed, and that the ideal one is left alone."""

import math

import mujoco
import numpy as np
import pytest

from robot.drivers.motor_bus import MotorCommand
from robot.errors import ConfigError
from robot.model import description
from robot.se3 import quat_to_matrix
from sim import flaws, realities
from sim.plant import Plant
from sim.simulation import Simulation
from sim.world import empty


@pytest.fixture(scope="module")
def juno():
    return description.load("juno")


def plant(juno, reality="ideal", *, seed=0, noisy=False):
    return Plant(empty(), juno, seed=seed, noisy=noisy, reality=reality)


def drawn(juno, name, seed):
    there = plant(juno)
    rng = np.random.default_rng(seed)
    return flaws.draw(realities.profile(name), there.model, juno, rng)


def test_there_are_an_ideal_a_real_and_a_harsh_one():
    assert list(realities.profiles()) == ["ideal", "real", "harsh"]
    bare = realities.Profile(summary=realities.profile("ideal").summary)
    assert realities.profile("ideal") == bare


def test_juno_plans_its_steps_for_the_most_slippery_floor(juno):
    floors = [realities.profile(name).body.floor_friction for name in realities.profiles()]
    assert juno.balance.friction < min(floor[0] for floor in floors if floor is not None)


def test_an_unknown_one_is_refused_with_the_nearest_name():
    with pytest.raises(ConfigError, match="did you mean 'harsh'"):
        Simulation().under("harch")


def test_a_world_says_of_which_it_is_and_keeps_it():
    world = Simulation().under("real").world("empty")
    assert world.profile == "real"
    assert world.nudged(3).profile == "real"
    assert Simulation().world("empty").profile == "real", "the default of all that says nothing"


@pytest.mark.parametrize("name", ["real", "harsh"])
@pytest.mark.parametrize("seed", range(5))
def test_what_is_drawn_is_within_what_the_reality_says(juno, name, seed):
    profile, found = realities.profile(name), drawn(juno, name, seed)
    imu, joints = profile.imu, profile.joints
    assert np.linalg.norm(found.imu.gyro_rad_s) <= math.radians(imu.gyro_offset_deg_s)
    assert np.linalg.norm(found.imu.accel_m_s2) <= imu.accel_offset_m_s2
    turn = math.acos(min(1.0, (np.trace(quat_to_matrix(found.imu.askew)) - 1.0) / 2.0))
    assert turn <= 2.0 * math.radians(imu.askew_deg)
    peak = np.array([motor.torque_limit_nm for motor in juno.motors.values()])
    low, high = joints.friction_share
    assert np.all(
        (found.joints.friction_nm >= low * peak) & (found.joints.friction_nm <= high * peak)
    )
    assert joints.delay_ms[0] <= 1000.0 * found.joints.delay_s <= joints.delay_ms[1]


def test_the_same_seed_draws_the_same_robot_and_another_another(juno):
    first, again, other = (plant(juno, "real", seed=seed, noisy=True) for seed in (1, 1, 2))
    a, b, c = (one.read() for one in (first, again, other))
    assert np.array_equal(a.motors.q, b.motors.q)
    assert np.array_equal(a.imu.accel_m_s2, b.imu.accel_m_s2)
    assert not np.array_equal(a.imu.accel_m_s2, c.imu.accel_m_s2)
    assert np.array_equal(first.model.body_mass, again.model.body_mass)
    assert not np.array_equal(first.model.body_mass, other.model.body_mass)


def test_noise_is_the_same_in_every_reality(juno):
    """What is wrong is drawn from seeds of its own, so that a run can be compared."""
    ideal, real = (plant(juno, name, noisy=True) for name in ("ideal", "real"))
    quiet_ideal, quiet_real = (plant(juno, name) for name in ("ideal", "real"))
    noise = ideal.read().motors.tau - quiet_ideal.read().motors.tau
    assert real.read().motors.tau - quiet_real.read().motors.tau == pytest.approx(noise)


def test_encoders_step_and_are_off(juno):
    there = plant(juno, "real")
    measured, truth = there.read().motors.q, there.data.qpos[there.motors.q_index]
    slides = flaws.slides(there.model, juno)
    steps = measured[~slides] / (2.0 * math.pi / 2**14)
    assert steps == pytest.approx(np.round(steps), abs=1e-6)
    assert 0.0 < np.abs(measured - truth).max() < 0.03


def test_a_command_takes_effect_after_the_delay_and_not_before(juno):
    there = plant(juno, "harsh")
    delay_ms = round(1000.0 * drawn_delay_s(there))
    n = there.motors.count
    zero, torque = np.zeros(n), np.full(n, 3.0)
    there.write(MotorCommand(0.0, zero, zero, torque, zero, zero))
    there.step(delay_ms - 1)
    assert not there.data.ctrl.any()
    there.step(2)
    assert there.data.ctrl == pytest.approx(3.0, rel=0.11)


def drawn_delay_s(there):
    """When the first thing is due that a plant has to do later."""
    zero = np.zeros(there.motors.count)
    there.write(MotorCommand(0.0, zero, zero, zero + 1.0, zero, zero))
    due_s = there._later[0][0] / 1000.0
    there.motors.damp()
    there.step(20)
    return due_s


def test_what_was_on_its_way_when_the_watchdog_struck_is_dropped(juno):
    there = plant(juno, "harsh")
    n = there.motors.count
    zero = np.zeros(n)
    there.write(MotorCommand(0.0, zero, zero, zero + 3.0, zero, zero))
    there.motors.damp()
    there.step(40)
    assert not there.data.ctrl.any()


def test_a_fast_motor_pushes_less_and_brakes_as_ever(juno):
    there = plant(juno, "real")
    motors, name = there.motors, "left_knee"
    index = list(juno.motors).index(name)
    limit = juno.motors[name].torque_limit_nm
    speed = juno.motors[name].velocity_limit_rad_s
    there.data.qvel[motors.qd_index[index]] = 1.25 * speed
    motors.tire()
    low, high = there.model.actuator_forcerange[index]
    assert high == pytest.approx(0.5 * limit)
    assert low == pytest.approx(-limit)


def test_links_weigh_other_than_described_and_their_model_is_consistent(juno):
    ideal, real = plant(juno), plant(juno, "real")
    ratio = real.model.body_mass[1:] / np.maximum(1e-9, ideal.model.body_mass[1:])
    heavy = ideal.model.body_mass[1:] > 0.0
    assert np.ptp(ratio[heavy]) > 0.02
    assert real.model.body_subtreemass[0] == pytest.approx(real.model.body_mass.sum())


def test_a_lidar_drops_beams_and_sees_nothing_too_near(juno):
    world = Simulation().under("harsh").world("kitchen")
    there = world.plant(juno, seed=0)
    mujoco.mj_kinematics(there.model, there.data)
    lidar = there.sending.lidar
    ideal = Simulation().under("ideal").world("kitchen").plant(juno, seed=0)
    mujoco.mj_kinematics(ideal.model, ideal.data)
    seen = np.isfinite(lidar.scan(0.0).ranges_m)
    all_seen = np.isfinite(ideal.sending.lidar.scan(0.0).ranges_m)
    dropped = np.count_nonzero(all_seen & ~seen)
    assert 0.005 < dropped / np.count_nonzero(all_seen) < 0.08
