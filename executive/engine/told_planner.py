"""A planner whose answers somebody hears of, as they are handed out."""

from __future__ import annotations

from collections.abc import Callable

from robot.planning.requests import PlanRequest, PlanResult
from robot.planning.worker import Planner

Heard = Callable[[PlanRequest, PlanResult], None]


class ToldPlanner:
    """Passes everything on; `heard` is told of each answer that is polled."""

    def __init__(self, planner: Planner, heard: Heard) -> None:
        """Pass on to `planner`."""
        self._planner = planner
        self._heard = heard
        self._asked: dict[int, PlanRequest] = {}

    def submit(self, request: PlanRequest, *, now_s: float) -> int:
        """Pass on."""
        ticket = self._planner.submit(request, now_s=now_s)
        self._asked[ticket] = request
        return ticket

    def poll(self, ticket: int, *, now_s: float) -> PlanResult | None:
        """Pass on, and tell what the answer is."""
        result = self._planner.poll(ticket, now_s=now_s)
        if result is not None and (request := self._asked.pop(ticket, None)) is not None:
            self._heard(request, result)
        return result

    def cancel(self, ticket: int) -> None:
        """Pass on."""
        self._asked.pop(ticket, None)
        self._planner.cancel(ticket)
