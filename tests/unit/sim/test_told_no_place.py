"""With `--localisation lidar` nothing that only the simulator knows of the robot's place leaves."""

import math

import msgspec
import pytest

from robot.bus import topics
from robot.model import description
from robot.reality import faults
from robot.se3 import SE3
from sim import world
from sim.simulation import SimulatedWorld


@pytest.fixture(scope="module")
def kitchen():
    return world.load("kitchen")


def plant(entries, localisation):
    return SimulatedWorld(entries, localisation=localisation).plant(
        description.load("juno"), seed=1
    )


def sent(entries, localisation):
    """What the plant sends at first, by topic."""
    return {topic.name: said for topic, said in plant(entries, localisation).sense(0.0)}


def test_no_fix_is_sent_and_the_map_does_not_say_where_it_began(kitchen):
    told, untold = sent(kitchen, "oracle"), sent(kitchen, "lidar")
    fix, plan = topics.ORACLE_FIX.name, topics.ORACLE_MAP.name
    assert fix in told and fix not in untold
    assert told[plan].start_X_WS != SE3() and untold[plan].start_X_WS == SE3()
    assert untold[plan] == msgspec.structs.replace(told[plan], start_X_WS=SE3())


def test_a_fault_may_still_silence_what_is_not_sent(kitchen):
    quiet = plant(kitchen, "lidar")
    quiet.suffer(faults.Silence(topic="localisation", duration_s=0.0))
    quiet.step(200)
    assert topics.ORACLE_FIX.name not in {topic.name for topic, _ in quiet.sense()}


def test_a_kidnapped_robot_is_elsewhere_and_stands_as_it_stood(kitchen):
    body = plant(kitchen, "oracle")
    before, joints = body.oracle.X_WB(), body.data.qpos[body.motors.q_index].copy()
    body.suffer(faults.Kidnap(at_m=(0.4, -1.0), turn_deg=90.0))
    after = body.oracle.X_WB()
    assert after.p == pytest.approx((0.4, -1.0, before.p[2]))
    assert after.yaw_rad - before.yaw_rad == pytest.approx(math.pi / 2)
    assert (body.data.qpos[body.motors.q_index] == joints).all()
    body.suffer(faults.Kidnap(by_m=(0.2, 0.0)))
    assert body.oracle.X_WB().p[0] == pytest.approx(0.6)
    with pytest.raises(ValueError, match="exactly one"):
        faults.Kidnap()


def test_a_covered_sector_of_the_lidar_comes_back_empty(kitchen):
    body = plant(kitchen, "oracle")
    lidar = body.sending.lidar
    hits = [math.isfinite(m) for m in lidar.scan(0.0).ranges_m]
    body.suffer(faults.CoverLidar(width_deg=120.0, towards_deg=180.0, duration_s=0.1))
    angles = [-180.0 + 2.0 * k for k in range(180)]
    covered = [math.isfinite(m) for m in lidar.scan(0.0).ranges_m]
    assert not any(hit for hit, angle in zip(covered, angles, strict=True) if abs(angle) > 121.0)
    inside = [(a, b) for a, b, angle in zip(covered, hits, angles, strict=True) if abs(angle) < 119]
    assert all(a == b for a, b in inside) and any(a for a, _ in inside)
    body.suffer(faults.CoverLidar())
    assert not any(math.isfinite(m) for m in lidar.scan(0.0).ranges_m)
    body.suffer(faults.CoverLidar(width_deg=0.0))
    assert any(math.isfinite(m) for m in lidar.scan(0.0).ranges_m)
