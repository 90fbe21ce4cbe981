"""The base-state estimator: exact without noise, bounded with it, and calm about lifted feet."""

import math

import numpy as np
import pytest

from robot.fusion.base_state import BaseStateEstimator
from robot.kinematics.dynamics import Dynamics
from robot.model import description
from robot.model.body import BodyModel
from robot.physics import GRAVITY_M_S2
from robot.se3 import SE3

DT_S = 0.005
GRAVITY = np.array([0.0, 0.0, GRAVITY_M_S2])


@pytest.fixture(scope="module")
def body():
    return BodyModel(description.load())


class Bench:
    """A body that stands where it is told, and an estimator that is told what sensors would say."""

    def __init__(self, body, X_NB, *, start=None, noise=None):
        self.body, self.noise = body, noise
        self.X_NB = X_NB
        self.q = np.array(body.description.posture("nominal"))
        self.truth = Dynamics(body)
        self._place(self.truth, X_NB)
        # the floor is at z = 0, under the soles
        lowest = min(self.truth.data.site_xpos[body.sole_site[side]][2] for side in body.sole_site)
        x, y, z = X_NB.p
        self.X_NB = SE3((x, y, z - float(lowest)), X_NB.quat_wxyz)
        self._place(self.truth, self.X_NB)
        self.estimator = BaseStateEstimator(body, start or self.X_NB)
        self.seen = Dynamics(body)

    def _place(self, dynamics, X_NB):
        self.body.write_base(dynamics.data, X_NB)
        self.body.write_joints(dynamics.data, self.q)
        dynamics.kinematics()

    def tick(self, load=(0.5, 0.5), gyro_bias=(0.0, 0.0, 0.0)):
        estimator, body = self.estimator, self.body
        gyro, accel = np.array(gyro_bias), self.X_NB.rotation().T @ GRAVITY
        if self.noise is not None:
            imu = body.description.sensors.imu
            gyro = gyro + imu.gyro_noise_rad_s * self.noise.standard_normal(3)
            accel = accel + imu.accel_noise_m_s2 * self.noise.standard_normal(3)
        estimator.predict(DT_S, gyro, accel)
        data = self.seen.data
        data.qpos[:3], data.qpos[3:7] = estimator.p, estimator.quat_wxyz
        data.qvel[:] = 0.0
        data.qvel[:3], data.qvel[3:6] = estimator.v, estimator.w_B
        body.write_joints(data, self.q, np.zeros(body.count))
        self.seen.kinematics()
        weight = body.mass_kg * GRAVITY_M_S2
        force_n = weight * np.array(load)
        soles, turns = self.seen.sole_position, self.seen.sole_rotation
        self.shift_v = estimator.correct(DT_S, soles, turns, force_n)

    def error_m(self):
        return math.dist(self.estimator.X_NB().p, self.X_NB.p)

    def tilt_error_rad(self):
        up = self.estimator.X_NB().rotation()[2] @ self.X_NB.rotation()[2]
        return math.acos(min(1.0, up))


@pytest.mark.parametrize("yaw", [0.0, 1.0, -2.5])
def test_standing_without_noise_is_exact(body, yaw):
    bench = Bench(body, SE3.from_xy_yaw(0.3, -0.2, yaw, z_m=0.6))
    for _ in range(1000):
        bench.tick()
    assert bench.error_m() < 1e-9
    assert np.abs(bench.estimator.v).max() < 1e-9
    assert bench.tilt_error_rad() < 1e-7


def test_standing_with_noise_drifts_within_bounds(body):
    bench = Bench(body, SE3((0.0, 0.0, 0.6)), noise=np.random.default_rng(1))
    worst_m = worst_v = 0.0
    for _ in range(4000):
        bench.tick()
        worst_m = max(worst_m, bench.error_m())
        worst_v = max(worst_v, float(np.abs(bench.estimator.v).max()))
    assert worst_m < 0.01
    assert worst_v < 0.05
    assert bench.tilt_error_rad() < math.radians(0.5)


def test_a_wrong_height_comes_back_to_the_floor(body):
    bench = Bench(body, SE3((0.0, 0.0, 0.6)))
    high = SE3((0.0, 0.0, bench.X_NB.p[2] + 0.03))
    bench = Bench(body, SE3((0.0, 0.0, 0.6)), start=high)
    for _ in range(600):
        bench.tick()
    assert abs(bench.estimator.p[2] - bench.X_NB.p[2]) < 0.003


def test_a_wrong_velocity_dies_out(body):
    bench = Bench(body, SE3((0.0, 0.0, 0.6)))
    bench.tick()
    bench.estimator.v[:] = (0.3, -0.2, 0.1)
    for _ in range(100):
        bench.tick()
    assert np.abs(bench.estimator.v).max() < 1e-3


def test_a_wrong_tilt_turns_towards_gravity(body):
    tilted = SE3.from_rpy(0.05, -0.04, 0.0, (0.0, 0.0, 0.6))
    bench = Bench(body, SE3((0.0, 0.0, 0.6)), start=tilted)
    before = bench.tilt_error_rad()
    for _ in range(4000):
        bench.tick()
    assert bench.tilt_error_rad() < 0.45 * before  # 20 s at a gain of 0.05 1/s: exp(-1) = 0.37


def test_loads_are_shares_of_the_weight(body):
    bench = Bench(body, SE3((0.0, 0.0, 0.6)))
    bench.tick(load=(0.8, 0.2))
    assert bench.estimator.load == pytest.approx([0.8, 0.2])


def test_in_the_air_it_falls_freely_with_the_accelerometer(body):
    """No foot on the floor: nothing but the IMU is used; at rest it reads gravity and stays."""
    bench = Bench(body, SE3((0.0, 0.0, 0.6)))
    for _ in range(200):
        bench.tick(load=(0.0, 0.0))
    assert bench.error_m() < 1e-9


def test_a_foot_put_down_elsewhere_becomes_a_new_anchor_without_a_jump(body):
    bench = Bench(body, SE3((0.0, 0.0, 0.6)))
    for _ in range(1000):
        bench.tick()
    hips = body.description.indices("left_leg")
    before = bench.estimator.p.copy()
    for k in range(100):  # the left foot lifts, the leg swings ahead
        bench.q[hips[2]] -= 0.002
        bench.tick(load=(0.0, 1.0))
        assert np.abs(bench.estimator.p - before).max() < 1e-6, k
    for _ in range(100):
        bench.tick(load=(0.5, 0.5))
    assert np.abs(bench.estimator.p[:2] - before[:2]).max() < 0.01


def test_lying_it_turns_with_gyro_and_gravity_and_stays_where_it_is(body):
    """Its gyro's bias, learnt on its feet, stays known, and is taken off."""
    bench = Bench(body, SE3((0.0, 0.0, 0.6)))
    bias = (0.004, -0.006, 0.005)
    for _ in range(2000):
        bench.tick(gyro_bias=bias)
    known = bench.estimator.imu_bias
    assert known.gyro_rad_s == pytest.approx(bias, abs=1e-3)
    bench.estimator.lying = True
    for _ in range(2000):
        bench.tick(load=(0.0, 0.0), gyro_bias=bias)
    assert bench.tilt_error_rad() < math.radians(1.0)
    assert bench.estimator.imu_bias == known
    assert np.abs(bench.estimator.v).max() < 0.02
    assert bench.error_m() < 0.02


def test_the_next_one_begins_with_what_is_known(body):
    bench = Bench(body, SE3((0.0, 0.0, 0.6)))
    for _ in range(1000):
        bench.tick(gyro_bias=(0.0, 0.01, 0.0))
    known = bench.estimator.imu_bias
    after = BaseStateEstimator(body, bench.X_NB, known=known)
    assert after.imu_bias.gyro_rad_s == pytest.approx(known.gyro_rad_s)
    assert after.imu_bias.gyro_sigma_rad_s == pytest.approx(known.gyro_sigma_rad_s)
    fresh = BaseStateEstimator(body, bench.X_NB)
    assert max(known.gyro_sigma_rad_s) < 0.5 * max(fresh.imu_bias.gyro_sigma_rad_s)


def test_what_a_twisting_foot_tells_of_the_past_moves_no_robot_that_walks(body):
    """Far from where N began, a heading that is put right would put the feet elsewhere."""
    bench = Bench(body, SE3((8.0, 0.0, 0.6)))
    for _ in range(100):
        bench.tick(load=(1.0, 0.0))
    state = bench.estimator._filter
    state.covariance[2, 2] = math.radians(2.0) ** 2  # unsure of the heading since the origin
    foot, place = state.feet[0].copy(), bench.estimator.p.copy()
    yaw = SE3.from_xy_yaw(0.0, 0.0, math.radians(3.0)).rotation()
    state.turns[0] = yaw @ state.turns[0]
    for _ in range(20):
        bench.tick(load=(1.0, 0.0))
    assert abs(state.turns[0][1, 0]) > math.radians(0.5)
    assert math.dist(state.feet[0][:2], foot[:2]) < 0.01
    assert math.dist(bench.estimator.p[:2], place[:2]) < 0.01
