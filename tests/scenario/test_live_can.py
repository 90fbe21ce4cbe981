"""Live runs whose motors are emulated: real frames, datagrams and transfers between processes."""

from pathlib import Path

import pytest

from robot.bringup.live import LiveRuntime
from robot.messages import WalkTo
from sim.simulation import Simulation
from tests.fakes.waiting import eventually

pytestmark = pytest.mark.live


@pytest.mark.parametrize(
    ("driver", "said", "emulated", "who"),
    [
        ("can", "33 joints", "CAN", "owner"),
        ("ethernet", "33 joints on 5 boards", "Ethernet", "owner"),
        ("pwm", "PWM: 2 joints", "CAN and PWM", "controller"),
    ],
)
def test_it_walks_by_frames_and_says_how_the_buses_did(
    tmp_path: Path, driver: str, said: str, emulated: str, who: str
):
    world = Simulation().world("empty")
    with LiveRuntime(world, folder=tmp_path, motors=driver) as runtime:
        assert runtime.failure() is None, runtime.failure()
        link = runtime.link
        link.send(WalkTo(stamp_s=link.now_s(), id=link.next_id(), x_m=1.0, y_m=0.0, yaw_rad=0.0))

        def walked() -> bool:
            runtime.advance(0.05)
            assert runtime.failure() is None, runtime.failure()
            return link.body().X_NB.p[0] > 0.2

        assert eventually(walked)  # a busy machine takes its time
    assert said in (tmp_path / "logs" / f"{who}.log").read_text()
    assert f"emulated {emulated}: all commands" in (tmp_path / "logs" / "plant.log").read_text()
