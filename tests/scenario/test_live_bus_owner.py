"""Live runs whose motors a process owns: real frames on emulated buses, and processes that die."""

import os
import signal
from pathlib import Path

import pytest

from robot.bringup import failsafe
from robot.bringup.live import LiveRuntime
from robot.clock import WallClock
from robot.owner.reactions import AT_MOST_S, HOLDS_S
from sim.simulation import Simulation
from tests.fakes.waiting import eventually

pytestmark = pytest.mark.live

RUNGS = {
    "kill": ["HOLD", "SIT", "DAMP", "OFF"],
    "stop": ["HOLD", "SIT", "DAMP", "OFF"],
    "press": ["OFF"],
}


@pytest.mark.parametrize(
    "how",
    ["kill", pytest.param("stop", marks=pytest.mark.rest), "press"],
)
def test_the_owner_goes_down_the_ladder_alone_and_obeys_nobody_before_it_is_armed(how, tmp_path):
    player = failsafe.Player(
        Simulation().world("empty"), "juno", folder=tmp_path, driver="can", wall=WallClock(),
        tell=print,
    )  # fmt: skip
    trial = player.play(how)
    assert [step.level for step in trial.steps] == RUNGS[how]
    within_s = {step.level: step.after_s for step in trial.steps}
    if how == "press":
        assert within_s["OFF"] <= 0.004
    else:
        # A process that was killed has its claim until the system has taken it apart.
        least_s = {"kill": HOLDS_S, "stop": AT_MOST_S}[how]
        held_s = within_s["SIT"] - within_s["HOLD"]
        assert least_s - 1e-6 < held_s < AT_MOST_S + 1e-6
        assert within_s["DAMP"] < 3.1
        assert within_s["OFF"] < 5.2
    assert trial.most <= 1.0
    assert trial.refusals[0]
    assert trial.ignored


def test_a_run_whose_owner_is_killed_ends_and_says_so(tmp_path: Path):
    world = Simulation().world("empty")
    with LiveRuntime(world, folder=tmp_path, motors="can", owned=True) as runtime:
        assert runtime.failure() is None, runtime.failure()
        os.kill(runtime.supervisor.pid("owner"), signal.SIGKILL)

        def ended() -> bool:
            runtime.advance(0.05)
            return runtime.failure() is not None

        assert eventually(ended)
        assert runtime.failure().code == "motor_fault"
        assert "owner" in runtime.failure().cause
