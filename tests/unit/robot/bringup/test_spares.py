"""When a spare is loaded: late at the start, soon after a death."""

from dataclasses import replace
from pathlib import Path
from signal import SIGKILL

import pytest

from robot.bringup.child import NEXT_SPARE_S, Child
from robot.bringup.processes import RESTART_WINDOW_S, Process
from robot.clock import SimulatedClock
from tests.fakes.waiting import eventually

STUB, QUEUE = "tests.fakes.stub_process", "tests.fakes.queueing_process"
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
    return child.spares > 0


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


def test_as_many_are_kept_as_it_may_be_started_again(tmp_path, clock) -> None:
    file = tmp_path / "run"
    file.write_text("obey")
    child = Child(replace(ROW, spares=5), file, log=tmp_path / "log", clock=clock)
    child.start()
    kept = []
    for span_s in (FIRST_S - 0.1, 0.2, FIRST_S - 0.3, 0.3, 10 * FIRST_S):
        after(child, clock, span_s)
        kept.append(child.spares)
    assert kept == [0, 1, 1, ROW.restarts, ROW.restarts]
    pids = {child.pid}
    for left in (1, 0):
        child.signal(SIGKILL)
        child.start()
        after(child, clock, 1.0)
        assert child.spares == left and child.status is None
        pids.add(child.pid)
    assert len(pids) == 1 + ROW.restarts and not child.may_start_again
    after(child, clock, RESTART_WINDOW_S)
    assert child.spares == 1
    child.stop()


def test_those_behind_another_one_wait_until_it_is_gone(tmp_path, clock) -> None:
    file = tmp_path / "run"
    file.write_text("obey")
    child = Child(replace(ROW, module=QUEUE, spares=2), file, log=tmp_path / "log", clock=clock)
    child.start()
    for _ in range(2):
        after(child, clock, 3 * FIRST_S)
    turns = tmp_path / "turns"
    assert eventually(lambda: turns.exists() and turns.read_text().count("\n") == 2)
    second = child.pid
    child.signal(SIGKILL)
    child.start()
    assert child.pid != second
    assert eventually(lambda: turns.read_text().count("\n") == 3)
    child.stop()
