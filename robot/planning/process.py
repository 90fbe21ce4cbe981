"""The planner of `live` runs: a process of its own, with a budget of the robot's time.

That is the wall's time, but in a simulation that is too slow for it: its time waits for a slow
machine, and so does this budget.

What runs over its budget, or is cancelled, is killed with its process; another is started. No call
waits for a process: not for its start, its answer, or its end.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from robot.closing import Closing
from robot.failures import failure
from robot.model.description import RobotDescription
from robot.planning.requests import PlanRequest, PlanResult
from robot.planning.worker_process import Answered, Ready, WorkerProcess

BUDGET_S = 5.0
STARTS = 3
"""Workers in a row that may die before they are ready, until whoever waits is told so."""


@dataclass(slots=True)
class _Waiting:
    """A request in line or in work; `deadline_s` is set when it is sent."""

    request: PlanRequest
    deadline_s: float | None = None


class ProcessPlanner(Closing):
    """One worker process, one request at a time, in the order they came. A context manager.

    The process is started at once (it takes about a second) and again after each kill.
    """

    def __init__(
        self,
        description: RobotDescription,
        *,
        budget_s: float = BUDGET_S,
    ) -> None:
        """Start the worker; `budget_s` of the robot's time a request, starting up not counted."""
        self._description = description
        self._budget_s = budget_s
        self._now_s = -math.inf
        self._waiting: dict[int, _Waiting] = {}
        self._answers: dict[int, PlanResult] = {}
        self._last = 0
        self._running: int | None = None
        self._ready = False
        self._stillborn = 0
        self._closed = False
        self._worker = WorkerProcess(description)

    def submit(self, request: PlanRequest, *, now_s: float) -> int:
        """Put a request in line."""
        self._now_s = now_s
        self._last += 1
        self._waiting[self._last] = _Waiting(request)
        self._advance()
        return self._last

    def poll(self, ticket: int, *, now_s: float) -> PlanResult | None:
        """The answer once the worker has sent it, or a `planner_timeout`."""
        self._now_s = now_s
        self._advance()
        if ticket in self._answers:
            return self._answers.pop(ticket)
        if ticket not in self._waiting:
            raise KeyError(ticket)
        return None

    def cancel(self, ticket: int) -> None:
        """Forget a request; if it is being worked on, the worker is killed and started anew."""
        self._answers.pop(ticket, None)
        self._waiting.pop(ticket, None)
        if ticket == self._running:
            self._restart()
        self._advance()

    def kill_worker(self) -> None:
        """End the process at once, whatever it does; the next poll notices."""
        self._worker.kill()

    def close(self) -> None:
        """End the worker; safe to call twice, and to forget requests after it."""
        self._closed, self._running = True, None
        self._waiting.clear()
        self._worker.kill()
        self._worker.wait()

    def _advance(self) -> None:
        """Take what the worker sent, stop what ran over, send what is next."""
        self._receive()
        running = self._running
        if running is not None:
            deadline_s = self._waiting[running].deadline_s
            if deadline_s is not None and self._now_s > deadline_s:
                self._finish(
                    running,
                    failure(
                        "planner_timeout",
                        f"planning took longer than {self._budget_s:.1f} s",
                        budget_s=self._budget_s,
                    ),
                )
                self._restart()
        if self._running is None and self._waiting and self._ready:
            ticket = min(self._waiting)
            self._running = ticket
            self._waiting[ticket].deadline_s = self._now_s + self._budget_s
            self._worker.send(ticket, self._waiting[ticket].request)

    def _receive(self) -> None:
        """Take what the worker said; it is replaced when it is gone."""
        while (message := self._worker.heard()) is not None:
            if isinstance(message, Ready):
                self._ready = True
            elif isinstance(message, Answered):
                if message.ticket == self._running:
                    self._finish(message.ticket, message.answer)
            else:
                if self._running is not None:
                    cause = "the planner's process died"
                    self._finish(self._running, failure("internal", cause))
                self._count_death()
                self._restart()
                return  # a new one, that has said nothing yet

    def _count_death(self) -> None:
        """Fail all that wait when one worker after the other dies as it starts."""
        self._stillborn = 0 if self._ready else self._stillborn + 1
        if self._stillborn >= STARTS:
            for ticket in list(self._waiting):
                self._finish(ticket, failure("internal", "the planner's process does not start"))

    def _finish(self, ticket: int, answer: PlanResult) -> None:
        self._waiting.pop(ticket, None)
        self._answers[ticket] = answer
        self._running = None

    def _restart(self) -> None:
        self._running, self._ready = None, False
        self._worker.kill()
        # What waits for a plan is cleared away as late as when the interpreter ends: a thread that
        # is started then never begins, and who starts it would wait for ever.
        if not self._closed:
            self._worker = WorkerProcess(self._description)
