"""Down and up again, in physics: pushed over, lying with damped motors, then told to get up."""

import math

import pytest

from benchmarks.rig import Rig
from robot.control.loop import BUS_PERIOD_S
from robot.messages import Damp, GetUp, Stand, Walk, WalkTo

AT_MOST_S = 60.0


def lie(rig):
    """Let it come to rest on the floor."""
    for _ in range(round(3.0 / BUS_PERIOD_S)):
        rig.plant.write(rig.loop.tick(rig.plant.read()))
        rig.plant.step(2)
    assert rig.loop.mode == "fallen"
    assert not rig.upright


def fallen(towards_deg, *, walking):
    rig = Rig(seed=3)
    rig.run(0.5)
    if walking:
        rig.send(Walk, forward_m_s=0.3, hold_s=20.0)
        assert rig.run(2.0)
    rig.plant.push(30.0, math.radians(towards_deg))
    assert not rig.run(4.0)
    lie(rig)
    return rig


def get_up(rig):
    """Seconds until it stands tall or has given up."""
    rig.send(GetUp)
    begun_s = rig.time_s
    while rig.loop.mode == "rising" and rig.time_s < begun_s + AT_MOST_S:
        rig.plant.write(rig.loop.tick(rig.plant.read()))
        rig.plant.step(2)
    return rig.time_s - begun_s


@pytest.mark.parametrize(
    ("towards_deg", "walking"),
    [pytest.param(90.0, False, marks=pytest.mark.rest), (-125.0, True)],
)
def test_it_gets_up_stands_and_walks(towards_deg, walking):
    rig = fallen(towards_deg, walking=walking)
    get_up(rig)
    state = rig.loop.state()
    assert rig.loop.mode == "stand"
    assert state.activities["legs"].status == "done"
    assert state.failure is None
    latest_ms = rig.plant.profile.joints.delay_ms[1]
    assert 1000.0 * rig.loop.latency.delay_s <= latest_ms  # nor did the floor look like late motors
    assert rig.upright
    assert rig.run(1.0)
    X_NS = rig.X_NS
    goal = X_NS.p[0] + 0.3, X_NS.p[1], X_NS.yaw_rad
    rig.send(WalkTo, x_m=goal[0], y_m=goal[1], yaw_rad=goal[2])
    assert rig.wait("legs", 20.0) == "done"


@pytest.mark.parametrize("command", [Damp, Stand])
def test_on_the_way_up_it_lets_go_at_once_when_told_to(command):
    rig = fallen(90.0, walking=False)
    rig.send(GetUp)
    for _ in range(500):
        rig.plant.write(rig.loop.tick(rig.plant.read()))
        rig.plant.step(2)
    assert rig.loop.mode == "rising"
    rig.send(command)
    for _ in range(3):
        sent = rig.loop.tick(rig.plant.read())
    assert not sent.kp.any()
    assert rig.loop.mode in ("damping", "fallen")


def test_who_stands_is_not_told_to_get_up():
    rig = Rig(seed=3)
    rig.run(0.5)
    rig.send(GetUp)
    assert rig.loop.state().activities["legs"].status == "failed"
    assert rig.run(0.5)
    assert rig.loop.mode == "stand"


def test_motors_that_gave_up_let_it_down_and_it_gets_up():
    rig = Rig(seed=3)
    rig.run(0.5)
    rig.plant.push(25.0, math.radians(90.0))
    rig.run(0.3)
    rig.loop.trip("something broke")
    assert not rig.run(0.3)
    rig.send(Stand)  # on its way down: no
    assert rig.loop.mode == "damping"
    assert rig.loop.state().failure.code == "lost_balance"
    lie(rig)
    assert "something broke" in rig.loop.state().failure.cause
    get_up(rig)
    assert rig.loop.mode == "stand"
    assert rig.upright
