"""How late motors obey is found from what they give, whatever their strength and noise."""

import numpy as np
import pytest

from robot.control.latency import LONGEST_PERIODS, Latency
from robot.drivers.motor_bus import MotorCommand, MotorState

PERIOD_S = 0.002
COUNT = 12
LIMIT_NM = np.full(COUNT, 80.0)
ZERO = np.zeros(COUNT)


def state(tau, stamp_s):
    return MotorState(stamp_s, ZERO, ZERO, tau, ZERO, ZERO, False, stamp_s)


def walked(latency, late_periods, *, seconds=2.0, seed=0, noise=0.005):
    """Torques that change as in steps, given `late_periods` after they were told."""
    rng = np.random.default_rng(seed)
    strength = rng.uniform(0.9, 1.1, COUNT)
    sent = [ZERO] * (LONGEST_PERIODS + 2)
    command = MotorCommand(0.0, ZERO, ZERO, ZERO, ZERO, ZERO)
    for k in range(round(seconds / PERIOD_S)):
        tau = strength * sent[-1 - late_periods] + noise * LIMIT_NM * rng.standard_normal(COUNT)
        now = state(tau, k * PERIOD_S)
        latency.felt(now)
        if k % 5 in (0, 2):
            torque = command.tau_ff + 2.0 * rng.standard_normal(COUNT)
            command = MotorCommand(now.stamp_s, ZERO, ZERO, torque, ZERO, ZERO)
        latency.told(command)
        sent.append(command.tau_ff)


@pytest.mark.parametrize("late_periods", [0, 1, 3, 6, 10])
@pytest.mark.parametrize("seed", [0, 1])
def test_it_is_found(late_periods, seed):
    latency = Latency(LIMIT_NM, PERIOD_S)
    walked(latency, late_periods, seed=seed)
    assert latency.delay_s == pytest.approx(late_periods * PERIOD_S)


def test_one_that_changes_is_found_anew():
    latency = Latency(LIMIT_NM, PERIOD_S)
    walked(latency, 5)
    walked(latency, 0, seed=1, seconds=5.0)
    assert latency.delay_s == 0.0


@pytest.mark.parametrize("late_periods", [0, 4])
def test_joints_that_turn_fast_and_motors_at_their_limits_mislead_nobody(late_periods):
    """As in getting up: stiff joints are told far away, lag, and are held by what they can give."""
    latency = Latency(LIMIT_NM, PERIOD_S)
    stiff, damped = np.full(COUNT, 300.0), np.full(COUNT, 5.0)
    commands = [MotorCommand(0.0, ZERO, ZERO, ZERO, ZERO, damped)] * (LONGEST_PERIODS + 2)
    phase, q, qd, tau = np.linspace(0.0, 2.0, COUNT), ZERO, ZERO, ZERO
    for k in range(2500):
        now = MotorState(k * PERIOD_S, q, qd, tau, ZERO, ZERO, False, k * PERIOD_S)
        latency.felt(now)
        goal = np.sin(6.0 * now.stamp_s + phase) + 0.3 * np.sign(np.sin(9.0 * now.stamp_s + phase))
        commands.append(MotorCommand(now.stamp_s, goal, ZERO, ZERO, stiff, damped))
        latency.told(commands[-1])
        force = commands[-1 - late_periods]
        tau = np.clip(force.kp * (force.q_des - q) - force.kd * qd, -LIMIT_NM, LIMIT_NM)
        qd = qd + PERIOD_S * tau / 0.4
        q = q + PERIOD_S * qd
    assert latency.delay_s == pytest.approx(late_periods * PERIOD_S)


def test_noise_alone_is_no_delay():
    latency = Latency(LIMIT_NM, PERIOD_S)
    rng = np.random.default_rng(3)
    command = MotorCommand(0.0, ZERO, ZERO, ZERO, ZERO, ZERO)
    for k in range(5000):
        now = state(0.005 * LIMIT_NM * rng.standard_normal(COUNT), k * PERIOD_S)
        latency.felt(now)
        latency.told(command)
    assert latency.delay_s == 0.0


def test_motors_that_measure_no_torque_tell_nothing():
    latency = Latency(LIMIT_NM, PERIOD_S)
    for k in range(100):
        now = state(np.full(COUNT, np.nan), k * PERIOD_S)
        latency.felt(now)
        latency.told(MotorCommand(0.0, ZERO, ZERO, ZERO + k, ZERO, ZERO))
    assert latency.delay_s == 0.0
