"""A planner that is closed starts nothing any more, whoever still asks something of it."""

from __future__ import annotations

from typing import Any, cast

from robot.planning import process, worker_process
from robot.planning.process import ProcessPlanner


class Worker:
    """Is ready at once, and says that it is dead when it was killed."""

    made = 0

    def __init__(self, _: Any) -> None:
        Worker.made += 1
        self._says: list[Any] = [worker_process.Ready()]

    def heard(self) -> Any:
        return self._says.pop(0) if self._says else None

    def send(self, ticket: int, request: Any) -> None:
        pass

    def kill(self) -> None:
        self._says.append(worker_process.Dead())

    def wait(self) -> None:
        pass


def test_a_request_that_is_forgotten_after_the_end_starts_no_process(monkeypatch):
    monkeypatch.setattr(process, "WorkerProcess", Worker)
    planner = ProcessPlanner(cast("Any", None))
    ticket = planner.submit(cast("Any", None), now_s=0.0)
    planner.kill_worker()
    assert planner.poll(ticket, now_s=0.0) is not None
    assert Worker.made == 2  # while it is open, the next one
    other = planner.submit(cast("Any", None), now_s=0.0)
    planner.close()
    planner.cancel(other)
    planner.cancel(ticket)
    assert Worker.made == 2
