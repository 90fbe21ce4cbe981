"""The contact-aided filter on synthetic motion: biases found, errors as large as it says."""

import math

import numpy as np
import pytest

from robot.fusion.state_estimator.filter import (
    ACCEL_BIAS,
    GYRO_BIAS,
    ContactFilter,
    exponential,
    small_turn,
)
from robot.fusion.state_estimator.parameters import Parameters
from robot.se3 import rotation_vector
from tests.fakes.swaying import Sway

DEG = math.pi / 180.0
BOTH = (1.0, 1.0)


class Bench:
    """A swaying body, sensors with biases and noise, and a filter."""

    def __init__(
        self, *, gyro_bias=(0, 0, 0), accel_bias=(0, 0, 0), seed=None, sway=None, tilted=False
    ):
        self.sway = sway or Sway()
        self.k = Parameters()
        self.rng = None if seed is None else np.random.default_rng(seed)
        self.gyro_bias, self.accel_bias = np.array(gyro_bias, float), np.array(accel_bias, float)
        self.t_s = 0.0
        rotation, position = self.sway.pose(0.0)
        if self.rng is not None and tilted:
            tilt = self.k.tilt_rad * self.rng.standard_normal(2)
            rotation = exponential(tilt[0], tilt[1], 0.0) @ rotation
        self.filter = ContactFilter(self.k, rotation, position)

    def run(self, duration_s, load=BOTH, *, blind=False):
        sway, dt_s = self.sway, self.sway.dt_s
        for _ in range(round(duration_s / dt_s)):
            gyro, accel = sway.imu(self.t_s)
            self.t_s += dt_s
            places, turns = sway.legs(self.t_s)
            gyro, accel = gyro + self.gyro_bias, accel + self.accel_bias
            if self.rng is not None:
                draw, root = self.rng.standard_normal, math.sqrt(dt_s)
                gyro = gyro + self.k.gyro_rad_s_rthz / root * draw(3)
                accel = accel + self.k.accel_m_s2_rthz / root * draw(3)
                places = places + self.k.foot_m * draw((2, 3))
                shake = self.k.foot_rad * draw((2, 3))
                turns = np.stack([exponential(*s) @ R for s, R in zip(shake, turns, strict=True)])
            if blind:
                gyro, places = gyro * np.nan, places * np.nan
            self.filter.predict(dt_s, gyro, accel)
            self.filter.correct(dt_s, places, turns, load)

    def error_m(self):
        return float(np.linalg.norm(self.filter.p - self.sway.pose(self.t_s)[1]))

    def error_rad(self):
        turned = self.filter.rotation @ self.sway.pose(self.t_s)[0].T
        return float(np.linalg.norm(rotation_vector(turned)))


DIRECTIONS = [(1, 0, 0), (0, -1, 0), (0, 0, 1), (0.58, 0.58, -0.58), (-0.8, 0.0, 0.6)]


@pytest.mark.parametrize("direction", DIRECTIONS)
@pytest.mark.parametrize("bias_deg_s", [0.2, pytest.param(1.0, marks=pytest.mark.rest)])
def test_the_gyros_bias_is_found_in_every_direction(direction, bias_deg_s):
    bench = Bench(gyro_bias=np.array(direction) * bias_deg_s * DEG, seed=3)
    bench.run(15.0)
    off = bench.filter.gyro_bias - bench.gyro_bias
    assert np.abs(off).max() < 0.05 * DEG
    assert bench.error_rad() < 1.0 * DEG
    assert bench.error_m() < 0.01


def test_an_accelerometers_bias_is_found_along_the_vertical():
    bench = Bench(accel_bias=(0.0, 0.0, 0.2), seed=4)
    bench.run(15.0)
    assert abs(bench.filter.accel_bias[2] - 0.2) < 0.03


@pytest.mark.rest
def test_errors_are_as_large_as_the_covariance_says():
    """NEES of the biases and the tilt over 30 runs: a mean of about 8 for 8 degrees of freedom."""
    values = []
    for seed in range(30):
        rng = np.random.default_rng([seed, 5])
        k = Parameters()
        bench = Bench(
            gyro_bias=k.gyro_bias_rad_s * rng.standard_normal(3),
            accel_bias=k.accel_bias_m_s2 * rng.standard_normal(3),
            seed=seed,
            tilted=True,
        )
        bench.run(4.0)
        state, (rotation, _) = bench.filter, bench.sway.pose(bench.t_s)
        turn = rotation_vector(rotation @ state.rotation.T)[:2]
        gyro, accel = bench.gyro_bias - state.gyro_bias, bench.accel_bias - state.accel_bias
        error = np.concatenate([turn, gyro, accel])
        rows = np.r_[0:2, GYRO_BIAS, ACCEL_BIAS]
        values.append(error @ np.linalg.solve(state.covariance[np.ix_(rows, rows)], error))
    assert 8 / 2.5 < np.mean(values) < 8 * 1.5


def test_nobody_tells_the_heading():
    """Feet and gravity cannot: what it is unsure of at the start it stays unsure of."""
    bench = Bench(seed=6)
    bench.filter.covariance[2, 2] = 0.1**2
    bench.run(5.0)
    assert bench.filter.covariance[2, 2] > 0.0999**2


def test_what_is_no_number_changes_nothing_for_the_worse():
    bench = Bench(gyro_bias=(0.01, 0.0, 0.0), seed=7)
    bench.run(4.0)
    bench.run(0.05, blind=True)
    state = bench.filter
    assert np.isfinite(state.covariance).all()
    assert np.isfinite(state.p).all()
    bench.run(4.0)
    assert bench.error_m() < 0.01
    assert np.linalg.eigvalsh(state.covariance).min() > -1e-12


def test_a_foot_that_slips_is_noticed_and_not_believed():
    bench = Bench(seed=8)
    bench.run(4.0)
    for _ in range(20):  # 6 cm in a tenth of a second
        bench.sway.feet[1, 0] += 0.003
        bench.run(bench.sway.dt_s)
    bench.run(2.0)
    assert bench.filter.slips[1] >= 1
    assert bench.filter.slips[0] == 0
    assert bench.error_m() < 0.01


def test_a_foot_lifted_and_put_down_elsewhere_moves_nothing():
    bench = Bench(seed=9)
    bench.run(3.0)
    bench.sway.feet[0, 0] += 0.3
    bench.run(0.4, load=(0.0, 1.0))
    bench.sway.foot_yaw_rad[0] = 0.4
    bench.run(3.0)
    assert bench.filter.slips == [0, 0]
    assert bench.error_m() < 0.015
    assert np.abs(bench.filter.feet - bench.sway.feet).max() < 0.02


def test_a_foot_that_turns_while_it_stands_alone_is_no_bias():
    """On both feet it learnt what the gyro's bias is; one twisting foot does not unteach it."""
    bench = Bench(gyro_bias=(0.0, 0.0, 0.4 * DEG), seed=10)
    bench.run(4.0)
    for _ in range(200):
        bench.sway.foot_yaw_rad[0] += 0.8 * DEG * bench.sway.dt_s
        bench.run(bench.sway.dt_s, load=(1.0, 0.0))
    assert abs(bench.filter.gyro_bias[2] - 0.4 * DEG) < 0.05 * DEG


def test_without_feet_it_falls_freely_with_the_imu():
    bench = Bench(sway=Sway(size=0.0))
    bench.run(1.0, load=(0.0, 0.0))
    assert bench.error_m() < 1e-9
    assert bench.filter.standing == [False, False]


def test_place_keeps_what_is_known_of_the_imu():
    bench = Bench(gyro_bias=(0.01, -0.005, 0.002), seed=11)
    bench.run(8.0)
    known, sure = bench.filter.gyro_bias.copy(), bench.filter.covariance[GYRO_BIAS, GYRO_BIAS]
    sure = sure.copy()
    bench.filter.place(np.eye(3), np.array([0.0, 0.0, 0.6]))
    assert bench.filter.gyro_bias == pytest.approx(known)
    assert bench.filter.covariance[GYRO_BIAS, GYRO_BIAS] == pytest.approx(sure)
    assert bench.filter.covariance[GYRO_BIAS, :21] == pytest.approx(0.0)


@pytest.mark.parametrize("angle", [1e-9, 1e-4, 0.05, 0.3, 1.2])
def test_small_turns_are_the_logarithm(angle):
    vector = angle * np.array([0.36, -0.48, 0.8])
    assert small_turn(exponential(*vector)) == pytest.approx(vector, rel=2e-5)
