"""A live run whose motors are on emulated CAN buses: real frames between two processes."""

from pathlib import Path

import pytest

from robot.bringup.live import LiveRuntime
from robot.messages import WalkTo
from sim.simulation import Simulation
from tests.fakes.waiting import eventually

pytestmark = pytest.mark.live


def test_it_walks_by_frames_and_says_how_the_buses_did(tmp_path: Path):
    world = Simulation().world("empty")
    with LiveRuntime(world, folder=tmp_path, motors="can") as runtime:
        assert runtime.failure() is None, runtime.failure()
        link = runtime.link
        link.send(WalkTo(stamp_s=link.now_s(), id=link.next_id(), x_m=1.0, y_m=0.0, yaw_rad=0.0))

        def walked() -> bool:
            runtime.advance(0.05)
            assert runtime.failure() is None, runtime.failure()
            return link.body().X_NB.p[0] > 0.2

        assert eventually(walked)  # a busy machine takes its time
    assert "33 joints" in (tmp_path / "logs" / "controller.log").read_text()
    assert "emulated CAN: all commands" in (tmp_path / "logs" / "plant.log").read_text()
