"""The planner of `fast` runs: computes at once, answers a span of simulated time later."""

from __future__ import annotations

from robot.model.description import RobotDescription
from robot.planning.requests import PlanRequest, PlanResult
from robot.planning.solve import Solver

PLAN_SPAN_S = 0.2  # of simulated time, however long it took: the same seed, the same run


class InlinePlanner:
    """Computes at `submit`, bounded by iterations; hands the answer out `span_s` later."""

    def __init__(self, description: RobotDescription, *, span_s: float = PLAN_SPAN_S) -> None:
        """Compile the robot."""
        self._solver = Solver(description)
        self._span_s = span_s
        self._answers: dict[int, tuple[float, PlanResult]] = {}
        self._last = 0

    def submit(self, request: PlanRequest, *, now_s: float) -> int:
        """Compute the answer; it is due `span_s` from now."""
        self._last += 1
        self._answers[self._last] = (now_s + self._span_s, self._solver.solve(request))
        return self._last

    def poll(self, ticket: int, *, now_s: float) -> PlanResult | None:
        """The answer once it is due."""
        due_s, answer = self._answers[ticket]
        if now_s < due_s - 1e-9:
            return None
        del self._answers[ticket]
        return answer

    def cancel(self, ticket: int) -> None:
        """Forget the answer."""
        self._answers.pop(ticket, None)
