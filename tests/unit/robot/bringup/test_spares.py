"""When a spare is loaded: late at the start, soon after a death."""

from pathlib import Path

import pytest

from robot.bringup.child import NEXT_SPARE_S, Child
from robot.bringup.processes import Process
from robot.clock import SimulatedClock

STUB = "tests.fakes.stub_process"
FIRST_S = 4.0
ROW = Process(
    "b", STUB, "always", death="controller_lost", restarts=2, spare_after_s=FIRST_S, stop_s=0.0
)


@pytest.fixture
def clock() -> SimulatedClock:
    return SimulatedClock()


@pytest.fixture
def child(tmp_path: Path, clock: SimulatedClock):
    file = tmp_path / "run"
    file.write_text("obey")
    one = Child(ROW, file, log=tmp_path / "log", clock=clock)
    one.start()
    yield one
    one.stop()


def after(child: Child, clock: SimulatedClock, span_s: float) -> bool:
    """Whether there is a spare when `span_s` have passed."""
    clock.set(clock.now_s() + span_s)
    child.prepare()
    return child.has_spare


def test_the_first_spare_waits_until_the_start_is_over(child: Child, clock: SimulatedClock) -> None:
    assert not after(child, clock, FIRST_S - 0.1)
    assert after(child, clock, 0.2)


def test_after_a_death_the_next_spare_comes_soon(child: Child, clock: SimulatedClock) -> None:
    child.stop()
    child.start()
    assert not after(child, clock, NEXT_SPARE_S - 0.1)
    assert after(child, clock, 0.2)


def test_none_is_loaded_that_could_not_be_used(child: Child, clock: SimulatedClock) -> None:
    for _ in range(ROW.restarts):
        child.stop()
        child.start()
    assert not after(child, clock, FIRST_S + 1.0)
