"""A sensor of force under a foot that is off ends no step in the air."""

import pytest

from benchmarks.rig import STEPS, Rig
from robot.control.loop import BUS_PERIOD_S
from robot.messages import Walk

OFFSET_N = 14.0


@pytest.mark.parametrize("foot", [0, 1])
def test_a_step_lasts_as_long_on_either_foot(foot):
    """With an offset of 4 % of the weight steps of that foot ended at 0.6 of their time."""
    rig = Rig(seed=5)
    gait, lasted_s = None, {"left": [], "right": []}
    rig.run(0.5)
    rig.send(Walk, forward_m_s=0.3, hold_s=10.0)
    gait, before = rig.loop.legs.gait, ("stand", "left", 0.0)
    for _ in range(round(5.0 / BUS_PERIOD_S)):
        sample = rig.plant.read()
        sample.force.ankle_wrench[foot, 2] += OFFSET_N
        rig.plant.write(rig.loop.tick(sample))
        rig.plant.step(STEPS)
        phase, side, past_s = before
        if phase == "single" and gait.phase != "single":
            lasted_s[side].append(past_s)
        before = (gait.phase, gait.support, gait.phase_s)
    nominal_s = rig.robot.walking.single_support_s
    for steps in lasted_s.values():
        assert len(steps) >= 3
        assert all(abs(step_s - nominal_s) < 0.15 * nominal_s for step_s in steps)
