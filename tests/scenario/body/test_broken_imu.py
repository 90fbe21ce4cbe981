"""The IMU breaks: the robot comes down on its feet by its legs alone, says why, and stays down."""

import math

import numpy as np
import pytest

from benchmarks.rig import Rig
from robot.messages import GetUp, Stand, Walk
from robot.reality.faults import BreakImu
from sim.faults import apply

LOOKS_S = 0.002
ROUGH = [
    pytest.param(how, reality, 0.1 * moment, marks=pytest.mark.rest)
    for how in ("silent", "frozen", "no_numbers")
    for reality in ("ideal", "real", "harsh")
    for moment in range(0, 12, 2)
]


def broken(how, reality="real", *, seed=2, walks_s=None):
    """A robot that stands, or has walked for so long, whose IMU breaks now."""
    rig = Rig(seed=seed, reality=reality)
    assert rig.run(0.5)
    if walks_s is not None:
        rig.send(Walk, forward_m_s=0.3, left_m_s=0.0, turn_rad_s=0.0, hold_s=20.0)
        assert rig.run(walks_s)
    apply(rig.plant, BreakImu(how=how))
    return rig


def lowered(rig):
    """Whether it is down on its feet after a while, and stays so; its torques stay in limits."""
    limit_nm, most = rig.loop.body.torque_limit_nm, 0.0
    for _ in range(round(6.0 / 0.01)):
        if not rig.run(0.01):
            return False, most
        most = max(most, float((np.abs(rig.plant.data.actuator_force) / limit_nm).max()))
    up = float(rig.X_WB.rotation()[2, 2])
    low_m = 0.8 * rig.robot.walking.base_height_m
    return up > math.cos(math.radians(12.0)) and rig.X_WB.p[2] < low_m and rig.upright, most


@pytest.mark.parametrize(
    ("how", "within_s"), [("silent", 0.012), ("frozen", 0.054), ("no_numbers", 0.006)]
)
def test_it_is_told_in_time_by_name_and_orders_to_the_legs_are_refused(how, within_s):
    rig = broken(how)
    begun_s = rig.time_s
    while not rig.loop.state().alarms and rig.time_s < begun_s + 0.2:
        assert rig.run(LOOKS_S)
    assert rig.time_s - begun_s <= within_s + 1e-6
    state = rig.loop.state()
    assert (state.failure.code, state.alarms[0].code) == ("imu_fault", f"imu_{how}")
    assert "IMU" in state.failure.cause
    for kind, fields in ((Walk, {"forward_m_s": 0.3, "hold_s": 9.0}), (Stand, {}), (GetUp, {})):
        rig.send(kind, **fields)
        legs = rig.loop.state().activities["legs"]
        assert legs.status == "failed"
        assert "IMU" in legs.detail


@pytest.mark.parametrize("how", ["silent", "frozen"])
def test_standing_it_squats_on_its_feet(how):
    """Going on by the last reading it fell within 2 s, 4 of 4."""
    down, most = lowered(broken(how))
    assert down
    assert most <= 1.0


@pytest.mark.parametrize(
    ("how", "reality", "phase_s"),
    [("silent", "real", 0.0), ("frozen", "harsh", 0.5), ("no_numbers", "real", 0.8), *ROUGH],
)
def test_walking_it_ends_its_step_and_squats_on_its_feet(how, reality, phase_s):
    """Going on by the last reading it fell within 2 s, 8 of 8."""
    down, most = lowered(broken(how, reality, seed=3, walks_s=2.0 + phase_s))
    assert down
    assert most <= 1.0


def test_a_short_silence_is_bridged_and_it_walks_on():
    rig = Rig(seed=4)
    assert rig.run(0.5)
    rig.send(Walk, forward_m_s=0.3, left_m_s=0.0, turn_rad_s=0.0, hold_s=20.0)
    for _ in range(20):
        apply(rig.plant, BreakImu(how="silent", duration_s=0.010))
        assert rig.run(0.2)
    assert rig.loop.mode == "walk"
    assert rig.loop.state().alarms == ()


def test_where_no_foot_bears_it_and_no_imu_is_left_it_damps():
    rig = broken("silent")
    assert rig.run(0.1)
    rig.plant.model.opt.gravity[:] = 0.0, 0.0, 0.3  # it is lifted off
    assert not rig.run(2.0)
    assert rig.loop.mode in ("damping", "fallen")
    assert "no foot bears" in rig.loop.state().failure.cause
