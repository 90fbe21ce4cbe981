"""Both planners keep the same promises: tickets, answers once, cancelling, equal answers."""

import os
import threading
import time
from collections.abc import Iterator
from multiprocessing.context import SpawnProcess

import pytest

from robot.failures import Failure
from robot.model.description import load
from robot.planning import worker_process
from robot.planning.inline import PLAN_SPAN_S, InlinePlanner
from robot.planning.process import ProcessPlanner
from robot.planning.requests import BasePath, BasePathRequest, PickPlan, PickRequest, PlanRequest
from robot.planning.worker import Planner
from tests.fakes.planning_room import START, on_table, surroundings
from tests.fakes.waiting import HANG_S

PATH = BasePathRequest(start=START, goal=(2.95, -1.2, 0.0), around=surroundings())
PICK = PickRequest(object_id="cup", around=surroundings(on_table(0.1, 0.1)), start=START, seed=3)
ROBOT = load("juno")
PATIENCE_S = HANG_S


@pytest.fixture(scope="module", params=["inline", "process"])
def planner(request: pytest.FixtureRequest) -> Iterator[Planner]:
    if request.param == "inline":
        yield InlinePlanner(ROBOT)
        return
    with ProcessPlanner(ROBOT, budget_s=PATIENCE_S) as planner:
        yield planner


def answer_of(planner: Planner, ticket: int) -> object:
    """Wait on the wall clock, as a live run would; an inline planner needs its span only."""
    end = time.monotonic() + PATIENCE_S
    while (answer := planner.poll(ticket, now_s=PLAN_SPAN_S)) is None:
        assert time.monotonic() < end
        time.sleep(0.01)
    return answer


def ask(planner: Planner, request: PlanRequest) -> object:
    return answer_of(planner, planner.submit(request, now_s=0.0))


def test_a_request_is_answered_once(planner: Planner) -> None:
    ticket = planner.submit(PATH, now_s=0.0)
    assert isinstance(answer_of(planner, ticket), BasePath)
    with pytest.raises(KeyError):
        planner.poll(ticket, now_s=1.0)


def test_tickets_grow_and_answers_find_their_request(planner: Planner) -> None:
    path, pick = planner.submit(PATH, now_s=0.0), planner.submit(PICK, now_s=0.0)
    assert pick > path
    assert isinstance(answer_of(planner, pick), PickPlan)
    assert isinstance(answer_of(planner, path), BasePath)


def test_the_same_request_gives_the_same_answer(planner: Planner) -> None:
    first = ask(planner, PICK)
    ask(planner, PATH)
    assert ask(planner, PICK) == first


def test_both_planners_agree(planner: Planner) -> None:
    assert ask(planner, PICK) == ask(InlinePlanner(ROBOT), PICK)


def test_a_cancelled_request_is_forgotten(planner: Planner) -> None:
    ticket = planner.submit(PATH, now_s=0.0)
    planner.cancel(ticket)
    planner.cancel(ticket)
    with pytest.raises(KeyError):
        planner.poll(ticket, now_s=1.0)
    assert isinstance(ask(planner, PATH), BasePath)


def test_a_failure_is_an_answer(planner: Planner) -> None:
    answer = ask(planner, PickRequest(object_id="ghost", around=surroundings(), start=START))
    assert isinstance(answer, Failure)
    assert answer.code == "object_not_seen"


def test_inline_hands_out_after_its_span() -> None:
    planner = InlinePlanner(ROBOT, span_s=0.3)
    ticket = planner.submit(PATH, now_s=10.0)
    assert planner.poll(ticket, now_s=10.29) is None
    assert isinstance(planner.poll(ticket, now_s=10.3), BasePath)


def test_while_the_robots_time_stands_still_a_plan_may_take_as_long_as_it_takes() -> None:
    with ProcessPlanner(ROBOT, budget_s=1e-6) as planner:
        ticket = planner.submit(PATH, now_s=5.0)
        end = time.monotonic() + PATIENCE_S
        answer: object = None
        while answer is None and time.monotonic() < end:
            answer = planner.poll(ticket, now_s=5.0)
        assert isinstance(answer, BasePath)


def test_what_runs_over_its_budget_times_out_and_the_next_is_answered() -> None:
    now_s = 0.0
    with ProcessPlanner(ROBOT, budget_s=2.0) as planner:
        late = planner.submit(PICK, now_s=now_s)
        end = time.monotonic() + PATIENCE_S
        answer: object = None
        while answer is None and time.monotonic() < end:
            now_s += 10.0  # a period of the tick takes ten seconds of the robot's time
            answer = planner.poll(late, now_s=now_s)
        assert isinstance(answer, Failure)
        assert (answer.code, answer.evidence["budget_s"]) == ("planner_timeout", 2.0)
        assert isinstance(ask(planner, PATH), BasePath)


def test_a_dead_worker_fails_its_request_and_is_replaced() -> None:
    with ProcessPlanner(ROBOT, budget_s=PATIENCE_S) as planner:
        assert isinstance(ask(planner, PATH), BasePath)
        ticket = planner.submit(PICK, now_s=0.0)
        planner.kill_worker()
        answer = answer_of(planner, ticket)
        assert isinstance(answer, Failure)
        assert answer.code == "internal"
        assert isinstance(ask(planner, PATH), BasePath)


def die_at_once(*_: object) -> None:
    os._exit(1)


def test_a_worker_that_does_not_start_is_an_answer_and_not_waited_for(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(worker_process, "_work", die_at_once)
    with ProcessPlanner(ROBOT, budget_s=PATIENCE_S) as planner:
        for _ in range(2):
            answer = ask(planner, PATH)
            assert isinstance(answer, Failure)
            assert (answer.code, answer.cause) == (
                "internal", "the planner's process does not start",
            )  # fmt: skip


def test_who_ticks_waits_neither_for_the_start_nor_for_the_end_of_a_process(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A machine that has no time for a new process: nothing is answered, and every call returns."""
    begin, caller = threading.Event(), threading.get_ident()
    waited: list[int] = []
    start, join = SpawnProcess.start, SpawnProcess.join

    def slow_start(one: SpawnProcess) -> None:
        waited.append(threading.get_ident())
        assert begin.wait(PATIENCE_S)
        start(one)

    def slow_join(one: SpawnProcess, timeout: float | None = None) -> None:
        waited.append(threading.get_ident())
        join(one, timeout)

    monkeypatch.setattr(SpawnProcess, "start", slow_start)
    monkeypatch.setattr(SpawnProcess, "join", slow_join)
    now_s = 0.0
    with ProcessPlanner(ROBOT, budget_s=2.0) as planner:
        ticket = planner.submit(PICK, now_s=0.0)
        assert planner.poll(ticket, now_s=0.0) is None
        planner.cancel(ticket)
        begin.set()
        late = planner.submit(PICK, now_s=0.0)
        while planner.poll(late, now_s=now_s) is None:
            now_s += 10.0  # over its budget as soon as it is sent: killed, and another one
            time.sleep(0.01)
    assert len(waited) >= 3
    assert caller not in waited
