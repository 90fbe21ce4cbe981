"""A live robot that does not come up says what it lacks."""

from pathlib import Path
from types import SimpleNamespace

import pytest

from robot.bringup.live import START_S, LiveRuntime
from sim.simulation import Simulation


class Wall:
    """A clock that goes on as fast as somebody waits for it."""

    def __init__(self) -> None:
        self.s = 0.0

    def now_s(self) -> float:
        return self.s

    def sleep_until(self, time_s: float) -> None:
        self.s = max(self.s + 0.01, time_s)


@pytest.mark.parametrize(
    ("localisation", "body", "code", "cure"),
    [
        ("lidar", "a body", "localisation_lost", "--localisation oracle"),
        ("lidar", None, "controller_lost", "logs"),
        ("oracle", "a body", "controller_lost", "logs"),
    ],
)
def test_it_says_whether_it_does_not_know_where_it_is(tmp_path, localisation, body, code, cure):
    wall = Wall()
    world = Simulation(localisation=localisation).world("kitchen")
    runtime = LiveRuntime(world, folder=tmp_path, wall=wall, lidar_map=Path("its.map.npz"))
    runtime.run = runtime._plan
    runtime._crew = SimpleNamespace(check=lambda: None)
    runtime.link = SimpleNamespace(body=lambda: body, map=lambda: "a map", world=lambda: None)
    runtime._wait_for_body()
    failure = runtime.failure()
    assert failure.code == code
    assert cure in failure.suggestion
    assert wall.s == pytest.approx(START_S, abs=1.0)
