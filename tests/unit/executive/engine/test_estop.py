"""The emergency stop ends what is done, and keeps what comes from moving, until it is reset."""

import pytest

from executive.engine.estop import StillPressed
from executive.skills.navigate import NavigateParams
from executive.skills.stop import StopParams
from tests.fakes.rig import WAIT, WALK, Rig
from tests.fakes.scripted_skills import Script


def test_an_emergency_stop_ends_all_jobs_and_refuses_new_ones_until_it_is_reset():
    rig = Rig({NavigateParams: [Script(steps=10**9, stop_steps=3)], StopParams: [Script(steps=2)]})
    rig.begin(WALK).tick(5)
    rig.executive.press_estop("somebody shouted")
    verdict = rig.run()
    assert (verdict.code, verdict.cause) == ("emergency_stop", "somebody shouted")
    assert rig.troupe.names() == ["navigate", "stop"]

    assert rig.begin(WAIT).run().code == "emergency_stop"
    with pytest.raises(StillPressed):
        rig.executive.reset_estop()
    rig.executive.release_estop()
    assert rig.begin(WAIT).run().code == "emergency_stop"
    assert "wait" not in rig.troupe.names()

    rig.executive.reset_estop()
    rig.tick(5)
    assert rig.begin(WAIT).run() is True
