"""A sole that has come down higher than the other one stands on something, not on the floor."""

from __future__ import annotations

import pytest

from benchmarks.rig import Rig
from robot.messages import Walk
from robot.reality.faults import Sill
from sim.faults import apply


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_sill_of_two_centimetres_does_not_draw_the_base_down(seed):
    rig = Rig(seed=seed, reality="ideal")
    assert rig.run(0.5)
    for step in range(20):
        if step == 4:
            apply(rig.plant, Sill(height_m=0.02))
        rig.send(Walk, forward_m_s=0.4, left_m_s=0.0, turn_rad_s=0.0, hold_s=0.6)
        assert rig.run(0.25)
        off_m = abs(rig.X_WB.p[2] - rig.loop.estimator.X_NB().p[2])
        assert off_m < 0.012
