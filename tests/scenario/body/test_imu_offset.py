"""An IMU that is off: found out while it walks, known still after a fall or another start."""

import math

import numpy as np
import pytest

from benchmarks.rig import Rig
from robot.bringup.fast import FastRuntime
from robot.control.loop import BUS_PERIOD_S
from robot.messages import GetUp, Stand, Walk
from robot.reality.contract import IDEAL
from robot.reality.faults import Kill, OffsetImu
from sim.faults import apply
from sim.simulation import Simulation

AT_MOST_S = 90.0
OFF_RAD = math.radians(1.5)


def offset(*gyro_deg_s):
    """Off by that, askew by a degree, the accelerometer a little too."""
    return OffsetImu(
        gyro_deg_s=gyro_deg_s, accel_m_s2=(0.03, -0.02, 0.02), askew_deg=(0.7, -0.7, 0.2)
    )


def spoilt(*gyro_deg_s):
    rig = Rig(seed=3, reality=IDEAL)  # nothing else is off: what is learnt is compared with it
    apply(rig.plant, offset(*gyro_deg_s))
    assert rig.run(1.0)
    return rig


def off_rad(rig):
    """How far what it takes for up is from up."""
    up = rig.X_WB.rotation()[2]
    taken = (rig.X_WN @ rig.loop.state().X_NB).rotation()[2]
    return float(np.linalg.norm(np.cross(up, taken)))


@pytest.mark.parametrize(
    "gyro_deg_s",
    [
        pytest.param((1.0, 0.0, 0.0), marks=pytest.mark.rest),
        pytest.param((0.0, -1.0, 0.0), marks=pytest.mark.rest),
        (0.58, -0.58, 0.58),
    ],
)
def test_it_walks_on(gyro_deg_s):
    """With a filter that knows no bias it fell after 7.6 s."""
    rig = spoilt(*gyro_deg_s)
    rig.send(Walk, forward_m_s=0.4, hold_s=60.0)
    for _ in range(12):
        assert rig.run(1.0)
        assert off_rad(rig) < OFF_RAD
    known = rig.loop.state().imu
    assert np.degrees(known.gyro_rad_s) == pytest.approx(gyro_deg_s, abs=0.15)


@pytest.mark.rest
def test_it_gets_up_with_what_it_knew():
    truth = np.radians((0.6, -0.5, 0.6))
    rig = spoilt(*np.degrees(truth))
    rig.plant.push(30.0, math.radians(90.0))
    assert not rig.run(4.0)
    rig.pass_by(3.0)
    known = np.linalg.norm(rig.loop.state().imu.gyro_rad_s - truth)
    rig.send(GetUp)
    begun_s = rig.time_s
    while rig.loop.mode == "rising" and rig.time_s < begun_s + AT_MOST_S:
        rig.pass_by(BUS_PERIOD_S)
    assert rig.loop.mode == "stand"
    assert rig.upright
    assert off_rad(rig) < OFF_RAD
    assert np.linalg.norm(rig.loop.state().imu.gyro_rad_s - truth) < known + math.radians(0.1)


def test_the_next_controller_knows_it_too():
    with FastRuntime(Simulation().world("empty"), seed=1) as runtime:
        runtime.inject(offset(0.0, 0.8, -0.6))
        runtime.advance(3.0)
        before = runtime.link.body().imu
        runtime.inject(Kill(process="controller"))
        runtime.advance(0.06)
        after = runtime.link.body()
        assert after.since_s > 2.9
        assert after.imu.gyro_rad_s == pytest.approx(before.gyro_rad_s, abs=math.radians(0.1))
        assert max(after.imu.gyro_sigma_rad_s) < math.radians(0.2)


def test_its_place_is_steady_while_it_stands():
    """What standing tells of the gyro changes the past; it moved the place by centimetres."""
    rig = spoilt(0.0, 0.0, 1.0)
    rig.send(Walk, forward_m_s=0.4, hold_s=10.0)
    assert rig.run(10.0)
    rig.send(Stand)
    assert rig.wait("legs", 6.0) == "done"
    places = []
    for _ in range(40):
        assert rig.run(0.1)
        places.append(rig.X_NS.p[:2])
    assert float(np.ptp(places, axis=0).max()) < 0.005
