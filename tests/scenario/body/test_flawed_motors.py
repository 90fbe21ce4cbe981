"""Motors that obey late and unequally, loose gears: it finds out how late, and walks straight."""

import math

import pytest

from benchmarks.rig import Rig
from robot.messages import Stand, Walk
from robot.reality.contract import IDEAL
from robot.reality.faults import Delay
from sim.faults import apply


def test_it_walks_in_a_harsh_reality():
    """Acting for the body as it was measured it fell after 8 s."""
    rig = Rig(seed=35, reality="harsh")
    assert rig.run(0.5)
    rig.send(Walk, forward_m_s=0.4, hold_s=60.0)
    assert rig.run(11.0)


def test_a_delay_that_begins_is_found():
    rig = Rig(seed=4, reality=IDEAL)
    assert rig.run(0.5)
    rig.send(Walk, forward_m_s=0.3, hold_s=60.0)
    assert rig.run(2.0)
    assert rig.loop.latency.delay_s == 0.0
    apply(rig.plant, Delay(delay_s=0.008))
    assert rig.run(6.0)
    assert rig.loop.latency.delay_s == pytest.approx(0.008)


def test_a_walk_keeps_its_heading_with_motors_of_unequal_strength():
    """Feet that land and twist askew turned it by half a degree a second."""
    rig = Rig(seed=82, reality="real")
    assert rig.run(0.5)
    before = rig.X_WS
    rig.send(Walk, forward_m_s=0.4, hold_s=60.0)
    assert rig.run(12.0)
    assert abs(math.degrees((before.inverse() @ rig.X_WS).yaw_rad)) < 3.0


@pytest.mark.rest
def test_it_comes_to_a_stand_with_loose_gears():
    """Its feet landed 2 cm or 2 degrees off, and it stepped on and on to put them right."""
    rig = Rig(seed=24, reality="real")
    assert rig.run(0.5)
    rig.send(Walk, forward_m_s=0.4, hold_s=60.0)
    assert rig.run(12.0)
    rig.send(Stand)
    assert rig.wait("legs", 2.5) == "done"
